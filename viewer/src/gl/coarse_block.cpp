// SPDX-License-Identifier: GPL-3.0-or-later
#include "gl/coarse_block.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>

namespace argil::viewer {
namespace {

constexpr std::size_t kCellsAlong = 3;
constexpr std::size_t kCells = kCellsAlong * kCellsAlong * kCellsAlong;
/// Marching cubes has at most five triangles in each of a leaf's 512 cells.
constexpr std::size_t kMostTriangles = 2560;

/// Which vertices lie on an edge that does not have a triangle on both sides.
std::vector<bool> open_vertices(const BlockMesh& block) {
  std::vector<std::uint64_t> edges;
  edges.reserve(3 * block.triangles.size());
  for (const Triangle& triangle : block.triangles) {
    for (std::size_t n = 0; n < 3; ++n) {
      const auto [low, high] = std::minmax(triangle[n], triangle[(n + 1) % 3]);
      edges.push_back((std::uint64_t{low} << 32U) | high);
    }
  }
  std::sort(edges.begin(), edges.end());
  std::vector<bool> is_open(block.vertices.size(), false);
  for (auto edge = edges.begin(); edge != edges.end();) {
    const auto next = std::upper_bound(edge, edges.end(), *edge);
    if (next - edge != 2) is_open[*edge >> 32U] = is_open[*edge & 0xFFFFFFFFU] = true;
    edge = next;
  }
  return is_open;
}

std::size_t cell_of(const Box3& bounds, const std::array<float, 3>& position) {
  const Vec3 size = bounds.size();
  std::size_t cell = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double fraction =
        size[a] > 0.0 ? (static_cast<double>(position[a]) - bounds.min[a]) / size[a] : 0.0;
    const double at = std::clamp(kCellsAlong * fraction, 0.0, kCellsAlong - 1.0);
    cell = kCellsAlong * cell + static_cast<std::size_t>(at);
  }
  return cell;
}

/// The vertices of a cell and the one that stands for them.
struct Cell {
  std::array<double, 3> sum{};
  double count = 0.0;
  std::uint32_t chosen = 0;
  double nearest = std::numeric_limits<double>::infinity();
};

/// For each vertex the one that stands for it.
std::vector<std::uint32_t> standing_for(const BlockMesh& block) {
  constexpr std::size_t kNone = kCells;
  const std::vector<bool> is_open = open_vertices(block);
  std::vector<std::size_t> cell_at(block.vertices.size(), kNone);
  std::array<Cell, kCells> cells;
  for (std::size_t n = 0; n < block.vertices.size(); ++n) {
    if (is_open[n]) continue;
    const auto& p = block.vertices[n].position_mm;
    cell_at[n] = cell_of(block.bounds_mm, p);
    Cell& cell = cells[cell_at[n]];
    for (std::size_t a = 0; a < 3; ++a) cell.sum[a] += static_cast<double>(p[a]);
    cell.count += 1.0;
  }
  const auto each_inside = [&](const auto& what) {
    for (std::uint32_t n = 0; n < block.vertices.size(); ++n) {
      if (cell_at[n] != kNone) what(n, cells[cell_at[n]]);
    }
  };
  each_inside([&](std::uint32_t n, Cell& cell) {
    double away = 0.0;
    for (std::size_t a = 0; a < 3; ++a) {
      const double d =
          static_cast<double>(block.vertices[n].position_mm[a]) - cell.sum[a] / cell.count;
      away += d * d;
    }
    if (away < cell.nearest) {
      cell.nearest = away;
      cell.chosen = n;
    }
  });
  std::vector<std::uint32_t> stands(block.vertices.size());
  for (std::uint32_t n = 0; n < block.vertices.size(); ++n) stands[n] = n;
  each_inside([&](std::uint32_t n, const Cell& cell) { stands[n] = cell.chosen; });
  return stands;
}

}  // namespace

std::vector<Triangle> coarse_triangles(const BlockMesh& block) {
  if (block.triangles.size() > kMostTriangles) return block.triangles;
  const std::vector<std::uint32_t> stands = standing_for(block);
  std::vector<Triangle> coarse;
  for (const Triangle& triangle : block.triangles) {
    const Triangle moved{stands[triangle[0]], stands[triangle[1]], stands[triangle[2]]};
    const bool has_area = moved[0] != moved[1] && moved[1] != moved[2] && moved[2] != moved[0];
    if (has_area) coarse.push_back(moved);
  }
  // All of it lies in one cell: a speck, which is as quickly drawn as it is.
  return coarse.empty() ? block.triangles : coarse;
}

}  // namespace argil::viewer
