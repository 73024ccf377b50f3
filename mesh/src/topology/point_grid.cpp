// SPDX-License-Identifier: GPL-3.0-or-later
#include "topology/point_grid.h"

#include <algorithm>
#include <cassert>

namespace argil::mesh {
namespace {

/// Three of them fit into the 64 bits of a key.
constexpr int kAxisBits = 21;
constexpr std::uint64_t kMostCells = std::uint64_t{1} << kAxisBits;

}  // namespace

PointGrid::PointGrid(const TriangleMesh& mesh, const std::vector<std::uint32_t>& vertices,
                     double side_mm)
    : side_mm_(side_mm) {
  assert(side_mm >= 0.0);
  Box3 box;
  for (const std::uint32_t v : vertices) box.include(mesh.positions[v]);
  if (vertices.empty()) return;
  low_ = box.min;
  const Vec3 size = box.size();
  const double longest = std::max({size.x, size.y, size.z});
  side_mm_ = std::max(side_mm_, longest / static_cast<double>(kMostCells - 1));
  if (!(side_mm_ > 0.0)) side_mm_ = 1.0;  // all in one point
  entries_.reserve(vertices.size());
  for (const std::uint32_t v : vertices)
    entries_.push_back({key_of(cell_of(mesh.positions[v])), v});
  std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
    return a.key != b.key ? a.key < b.key : a.vertex < b.vertex;
  });
}

std::uint64_t PointGrid::key_of(const Cell& cell) noexcept {
  assert(cell.x < kMostCells && cell.y < kMostCells && cell.z < kMostCells);
  return (cell.x << (2 * kAxisBits)) | (cell.y << kAxisBits) | cell.z;
}

PointGrid::Cell PointGrid::cell_of(const Vec3& p) const noexcept {
  const auto along = [this](double x, double low) {
    const double cell = std::clamp((x - low) / side_mm_, 0.0, static_cast<double>(kMostCells - 1));
    return static_cast<std::uint64_t>(cell);
  };
  assert(side_mm_ > 0.0);
  return {along(p.x, low_.x), along(p.y, low_.y), along(p.z, low_.z)};
}

std::vector<PointGrid::Entry>::const_iterator PointGrid::lower_bound(
    std::uint64_t key) const noexcept {
  return std::lower_bound(entries_.begin(), entries_.end(), key,
                          [](const Entry& entry, std::uint64_t k) { return entry.key < k; });
}

}  // namespace argil::mesh
