// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/assembly.h"

#include <algorithm>
#include <cassert>
#include <map>
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

std::vector<PlacedPart> placed_parts(const Assembly& assembly) {
  std::vector<PlacedPart> parts;
  DistinctNames names;
  for (const AssemblyItem& item : assembly.items) {
    for (const Placement& placed : item.placements) {
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

TriangleMesh joined(Assembly assembly) {
  std::vector<std::size_t> uses(assembly.objects.size());
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::vector<Placement> placements;
  for (const AssemblyItem& item : assembly.items) {
    placements.insert(placements.end(), item.placements.begin(), item.placements.end());
  }
  for (const Placement& placed : placements) {
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
  for (const Placement& placed : placements) {
    TriangleMesh& mesh = assembly.objects[placed.object].mesh;
    append_placed(mesh, placed.to_mm, whole);
    if (--uses[placed.object] == 0) mesh = {};
  }
  return whole;
}

}  // namespace argil::io
