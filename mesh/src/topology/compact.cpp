// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/mesh/compact.h"

#include <cassert>
#include <cstdint>
#include <vector>

#include "argil/mesh/point_welder.h"

namespace argil::mesh {
namespace {

TriangleMesh renumbered(std::vector<Vec3> positions, const std::vector<std::uint32_t>& number,
                        const std::vector<Triangle>& triangles) {
  assert(positions.size() <= number.size());
  TriangleMesh out;
  out.positions = std::move(positions);
  out.triangles.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles) {
    out.triangles.push_back({number[a], number[b], number[c]});
  }
  return out;
}

}  // namespace

Box3 used_bounds(const TriangleMesh& mesh) noexcept {
  Box3 box;
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) {
      assert(v < mesh.positions.size());
      box.include(mesh.positions[v]);
    }
  }
  return box;
}

TriangleMesh compacted(const TriangleMesh& mesh) {
  std::vector<bool> is_used(mesh.positions.size(), false);
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) {
      assert(v < is_used.size());
      is_used[v] = true;
    }
  }
  std::vector<Vec3> positions;
  std::vector<std::uint32_t> number(mesh.positions.size());
  for (std::size_t v = 0; v < number.size(); ++v) {
    number[v] = static_cast<std::uint32_t>(positions.size());
    if (is_used[v]) positions.push_back(mesh.positions[v]);
  }
  return renumbered(std::move(positions), number, mesh.triangles);
}

TriangleMesh welded(const TriangleMesh& mesh) {
  std::vector<Vec3> positions;
  PointWelder welder(positions);
  std::vector<std::uint32_t> number;
  number.reserve(mesh.positions.size());
  for (const Vec3& p : mesh.positions) number.push_back(welder.add(p));
  return renumbered(std::move(positions), number, mesh.triangles);
}

}  // namespace argil::mesh
