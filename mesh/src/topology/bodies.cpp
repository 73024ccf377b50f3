// SPDX-License-Identifier: GPL-3.0-or-later
// Which parts of a mesh form one body: an outward shell with the cavities inside it.
#include "argil/mesh/bodies.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <numeric>

#include "argil/core/winding_number.h"
#include "argil/mesh/edges.h"

namespace argil::mesh {
namespace {

/// A part of the mesh that hangs together.
struct Part {
  double volume = 0.0;
  Box3 box;
  Vec3 vertex;  ///< any of its own
};

bool contains_box(const Box3& outer, const Box3& inner) noexcept {
  for (std::size_t a = 0; a < 3; ++a) {
    if (inner.min[a] < outer.min[a] || inner.max[a] > outer.max[a]) return false;
  }
  return true;
}

class Bodies {
 public:
  explicit Bodies(const TriangleMesh& mesh)
      : mesh_(mesh), parts_(mesh_parts(mesh, EdgeTable(mesh), false)), part_(parts_.count) {
    const std::vector<double> volumes = part_volumes(mesh, parts_);
    for (std::size_t p = 0; p < part_.size(); ++p) part_[p].volume = volumes[p];
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      assert(parts_.of_triangle[t] != kNoPart);
      Part& part = part_[parts_.of_triangle[t]];
      for (const std::uint32_t v : mesh.triangles[t]) part.box.include(mesh.positions[v]);
      part.vertex = mesh.positions[mesh.triangles[t][0]];
    }
  }

  MeshBodies run();

 private:
  bool is_inside(std::uint32_t part, std::uint32_t shell);
  std::uint32_t shell_around(std::uint32_t cavity);

  const TriangleMesh& mesh_;
  MeshParts parts_;
  std::vector<Part> part_;
  std::vector<std::uint32_t> shells_;               ///< parts that face outward, largest first
  std::map<std::uint32_t, WindingNumber> winding_;  ///< of shells, as far as one was asked for
};

bool Bodies::is_inside(std::uint32_t part, std::uint32_t shell) {
  auto known = winding_.find(shell);
  if (known == winding_.end()) {
    std::vector<Triangle> own;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (parts_.of_triangle[t] == shell) own.push_back(mesh_.triangles[t]);
    }
    known = winding_.emplace(shell, WindingNumber(mesh_.positions, own)).first;
  }
  assert(is_finite(part_[part].vertex));
  // 1 inside and 0 outside, but for the error of the tree.
  return known->second.at(part_[part].vertex) > 0.5;
}

/// The smallest shell around it; itself where there is none, as for a part that is inside out.
std::uint32_t Bodies::shell_around(std::uint32_t cavity) {
  std::vector<std::uint32_t> around;
  for (const std::uint32_t shell : shells_) {
    if (contains_box(part_[shell].box, part_[cavity].box)) around.push_back(shell);
  }
  // From the smallest: the first that holds the cavity is the one around it.
  while (!around.empty() && !is_inside(cavity, around.back())) around.pop_back();
  return around.empty() ? cavity : around.back();
}

MeshBodies Bodies::run() {
  std::vector<std::uint32_t> by_volume(part_.size());
  std::iota(by_volume.begin(), by_volume.end(), 0U);
  std::stable_sort(by_volume.begin(), by_volume.end(), [&](std::uint32_t a, std::uint32_t b) {
    return part_[a].volume > part_[b].volume;
  });
  for (const std::uint32_t p : by_volume) {
    if (part_[p].volume > 0.0) shells_.push_back(p);
  }
  MeshBodies bodies;
  std::vector<std::uint32_t> body(part_.size());
  for (const std::uint32_t p : by_volume) {  // shells come first
    const std::uint32_t shell = part_[p].volume > 0.0 ? p : shell_around(p);
    body[p] = shell == p ? bodies.count++ : body[shell];
  }
  bodies.of_triangle.reserve(mesh_.triangles.size());
  for (const std::uint32_t p : parts_.of_triangle) bodies.of_triangle.push_back(body[p]);
  assert(bodies.count > 0 || part_.empty());
  return bodies;
}

}  // namespace

MeshBodies mesh_bodies(const TriangleMesh& mesh) { return Bodies(mesh).run(); }

std::vector<TriangleMesh> split_mesh(const TriangleMesh& mesh,
                                     std::span<const std::uint32_t> of_triangle) {
  assert(of_triangle.size() == mesh.triangles.size());
  struct Copy {
    std::uint32_t part = kNoPart;
    std::uint32_t number = 0;
  };
  std::vector<Copy> last(mesh.positions.size());  // a vertex where two parts touch is in both
  std::vector<TriangleMesh> parts;
  std::vector<std::uint32_t> order(mesh.triangles.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return of_triangle[a] < of_triangle[b];
  });
  for (const std::uint32_t t : order) {
    if (of_triangle[t] >= parts.size()) parts.resize(of_triangle[t] + std::size_t{1});
    TriangleMesh& part = parts[of_triangle[t]];
    Triangle triangle = mesh.triangles[t];
    for (std::uint32_t& v : triangle) {
      Copy& copy = last[v];
      if (copy.part != of_triangle[t]) {
        copy = {of_triangle[t], static_cast<std::uint32_t>(part.positions.size())};
        part.positions.push_back(mesh.positions[v]);
      }
      v = copy.number;
    }
    part.triangles.push_back(triangle);
  }
  return parts;
}

}  // namespace argil::mesh
