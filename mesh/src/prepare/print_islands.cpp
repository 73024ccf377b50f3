// SPDX-License-Identifier: GPL-3.0-or-later
// Islands are branches of the merge tree of the height on the surface: each begins at a minimum and
// ends where it meets a branch that began lower.
#include "argil/mesh/print_islands.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>

#include "argil/mesh/compact.h"
#include "argil/mesh/edges.h"
#include "argil/mesh/print_orientation.h"
#include "argil/mesh/triangle_geometry.h"

#include "prepare/section.h"
#include "topology/corners_around.h"

namespace argil::mesh {
namespace {

class Islands {
 public:
  Islands(const TriangleMesh& mesh, double layer_mm)
      : mesh_(mesh), layer_(layer_mm), around_(mesh), bed_(used_bounds(mesh).min.z + kOnBedMm) {}

  std::vector<PrintIsland> find() {
    sort_vertices();
    DisjointSets branches(order_.size());
    for (std::uint32_t rank = 0; rank < order_.size(); ++rank) grow(rank, branches);
    for (std::uint32_t rank = 0; rank < order_.size(); ++rank) {
      const bool is_on_mesh = !around_.of(order_[rank]).empty();
      if (!is_on_mesh || branches.find(rank) != rank) continue;
      add(rank, std::numeric_limits<double>::infinity());
    }
    std::stable_sort(found_.begin(), found_.end(), [](const PrintIsland& a, const PrintIsland& b) {
      return a.at_mm.z < b.at_mm.z;
    });
    return std::move(found_);
  }

 private:
  const Vec3& at(std::uint32_t rank) const { return mesh_.positions[order_[rank]]; }

  void sort_vertices() {
    order_.resize(mesh_.positions.size());
    std::iota(order_.begin(), order_.end(), 0U);
    std::stable_sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
      return mesh_.positions[a].z < mesh_.positions[b].z;
    });
    rank_.resize(order_.size());
    for (std::uint32_t rank = 0; rank < order_.size(); ++rank) rank_[order_[rank]] = rank;
  }

  /// The vertex joins the branches of its lower neighbours; all but the lowest of them end here. A
  /// branch is named by the rank of its minimum.
  void grow(std::uint32_t rank, DisjointSets& branches) {
    for (const std::uint32_t corner : around_.of(order_[rank])) {
      for (const std::uint32_t v : mesh_.triangles[corner / 3]) {
        if (rank_[v] >= rank) continue;
        const std::uint32_t one = branches.find(rank);
        const std::uint32_t other = branches.find(rank_[v]);
        const std::uint32_t younger = std::max(one, other);
        // The vertex itself is no branch of its own.
        if (one != other && younger != rank) add(younger, at(rank).z - at(younger).z);
        branches.unite(one, other);
      }
    }
  }

  void add(std::uint32_t minimum, double free_mm) {
    const Vec3& lowest = at(minimum);
    if (lowest.z <= bed_ || free_mm < layer_) return;
    const double area = section_around(order_[minimum], lowest.z + layer_);
    if (area > 0.0) found_.push_back({lowest, area, free_mm});
  }

  /// The area of the section of what hangs together with a vertex below a height: negative where it
  /// encloses air.
  double section_around(std::uint32_t vertex, double z) {
    std::vector<std::uint32_t> open{vertex};
    std::vector<std::uint32_t> triangles;
    reached_.resize(mesh_.positions.size(), false);
    reached_[vertex] = true;
    for (std::size_t next = 0; next < open.size(); ++next) {
      for (const std::uint32_t corner : around_.of(open[next])) {
        triangles.push_back(corner / 3);
        for (const std::uint32_t v : mesh_.triangles[corner / 3]) {
          if (reached_[v] || !(mesh_.positions[v].z < z)) continue;
          reached_[v] = true;
          open.push_back(v);
        }
      }
    }
    for (const std::uint32_t v : open) reached_[v] = false;
    std::sort(triangles.begin(), triangles.end());
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    double twice = 0.0;
    const Vec3& about = mesh_.positions[vertex];
    for (const std::uint32_t t : triangles) {
      const auto segment = section_of(corners_of(mesh_, t), z);
      if (segment) twice += cross(segment->from - about, segment->to - about).z;
    }
    return 0.5 * twice;
  }

  const TriangleMesh& mesh_;
  double layer_;
  CornersAround around_;
  double bed_;
  std::vector<std::uint32_t> order_;  ///< vertices from below
  std::vector<std::uint32_t> rank_;   ///< of each vertex in it
  std::vector<bool> reached_;
  std::vector<PrintIsland> found_;
};

}  // namespace

std::vector<PrintIsland> print_islands(const TriangleMesh& mesh, double layer_mm) {
  assert(layer_mm > 0.0);
  if (mesh.triangles.empty()) return {};
  return Islands(mesh, layer_mm).find();
}

}  // namespace argil::mesh
