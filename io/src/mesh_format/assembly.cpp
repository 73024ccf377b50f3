// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/assembly.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "argil/mesh/compact.h"

namespace argil::io {
namespace {

/// Adds what a placement makes of a mesh.
void append_placed(const TriangleMesh& mesh, const Affine& to_mm, TriangleMesh& whole) {
  const auto base = static_cast<std::uint32_t>(whole.positions.size());
  const bool stays = to_mm.is_identity();  // with its bits
  for (const Vec3& p : mesh.positions) whole.positions.push_back(stays ? p : to_mm.applied(p));
  const bool is_mirrored = to_mm.mirrors();  // it would face inward
  for (const auto& [a, b, c] : mesh.triangles) {
    whole.triangles.push_back(
        {base + a, base + (is_mirrored ? c : b), base + (is_mirrored ? b : c)});
  }
}

/// A name that no other has.
class DistinctNames {
 public:
  std::string distinct(const std::string& name) {
    if (used_.insert(name).second) return name;
    std::size_t& count = counts_.try_emplace(name, 1).first->second;
    for (;;) {
      std::string numbered = name + " (" + std::to_string(++count) + ")";
      if (used_.insert(numbered).second) return numbered;
    }
  }

 private:
  std::set<std::string> used_;
  std::map<std::string, std::size_t> counts_;
};

}  // namespace

bool Affine::keeps_lengths() const noexcept {
  constexpr double kRounding = 1e-6;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i; j < 3; ++j) {
      if (std::abs(dot(rows[i], rows[j]) - (i == j ? 1.0 : 0.0)) > kRounding) return false;
    }
  }
  return true;
}

std::vector<PlacedPart> placed_parts(const Assembly& assembly) {
  std::vector<PlacedPart> parts;
  DistinctNames names;
  for (const AssemblyItem& item : assembly.items) {
    for (const PlacedObject& placed : item.placements) {
      assert(placed.object < assembly.objects.size());
      std::string name = assembly.objects[placed.object].name;
      if (name.empty()) name = item.name;
      if (name.empty()) name = "part " + std::to_string(parts.size() + 1);
      parts.push_back({names.distinct(name), placed.object, placed.to_mm});
    }
  }
  return parts;
}

Box3 placed_bounds(const TriangleMesh& mesh, const Affine& to_mm) {
  if (to_mm.is_identity()) return mesh::used_bounds(mesh);
  Box3 box;
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) box.include(to_mm.applied(mesh.positions[v]));
  }
  return box;
}

TriangleMesh placed_mesh(const TriangleMesh& mesh, const Affine& to_mm) {
  TriangleMesh placed;
  placed.positions.reserve(mesh.positions.size());
  placed.triangles.reserve(mesh.triangles.size());
  append_placed(mesh, to_mm, placed);
  return placed;
}

Assembly with_true_sizes(Assembly assembly) {
  Assembly sized;
  sized.items = std::move(assembly.items);
  std::vector<std::optional<std::size_t>> kept(assembly.objects.size());
  for (AssemblyItem& item : sized.items) {
    for (PlacedObject& placed : item.placements) {
      const std::size_t from = placed.object;
      const AssemblyObject& object = assembly.objects[from];
      const bool stays = placed.to_mm.keeps_lengths();
      if (stays && kept[from]) {
        placed.object = *kept[from];
        continue;
      }
      placed.object = sized.objects.size();
      sized.objects.push_back({object.name, object.color, {}});
      if (stays) {
        kept[from] = placed.object;
        sized.objects.back().mesh = object.mesh;
      } else {
        Affine shape = placed.to_mm;
        shape.rows[3] = {};
        sized.objects.back().mesh = placed_mesh(object.mesh, shape);
        placed.to_mm = {{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, placed.to_mm.rows[3]}};
      }
    }
  }
  return sized;
}

TriangleMesh joined(Assembly assembly) {
  std::vector<std::size_t> uses(assembly.objects.size());
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::vector<PlacedObject> placements;
  for (const AssemblyItem& item : assembly.items) {
    placements.insert(placements.end(), item.placements.begin(), item.placements.end());
  }
  for (const PlacedObject& placed : placements) {
    ++uses[placed.object];
    vertices += assembly.objects[placed.object].mesh.positions.size();
    triangles += assembly.objects[placed.object].mesh.triangles.size();
  }
  if (placements.size() == 1 && placements[0].to_mm.is_identity()) {
    return std::move(assembly.objects[placements[0].object].mesh);
  }
  TriangleMesh whole;
  whole.positions.reserve(vertices);
  whole.triangles.reserve(triangles);
  for (const PlacedObject& placed : placements) {
    TriangleMesh& mesh = assembly.objects[placed.object].mesh;
    append_placed(mesh, placed.to_mm, whole);
    if (--uses[placed.object] == 0) mesh = {};
  }
  return whole;
}

}  // namespace argil::io
