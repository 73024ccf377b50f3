// SPDX-License-Identifier: GPL-3.0-or-later
#include "repair/winding_rays.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace argil::mesh {
namespace {

using SeenPoint = Exact::Point_2;

SeenPoint seen_along(std::size_t axis, const ExactPoint& p) {
  return {p[static_cast<int>((axis + 1) % 3)], p[static_cast<int>((axis + 2) % 3)]};
}

/// Which way a triangle is passed by a ray along the axis, seen from where the ray comes from: 1
/// where it leaves the inside, -1 where it enters, 0 where it passes beside or before the start.
/// Nothing where it meets an edge.
std::optional<std::int32_t> passage(const std::array<ExactPoint, 3>& corners,
                                    const ExactPoint& from, std::size_t axis) {
  std::array<SeenPoint, 3> seen;
  for (std::size_t k = 0; k < 3; ++k) seen[k] = seen_along(axis, corners[k]);
  const CGAL::Orientation turn = CGAL::orientation(seen[0], seen[1], seen[2]);
  if (turn == CGAL::COLLINEAR) return 0;
  const SeenPoint at = seen_along(axis, from);
  bool is_on_edge = false;
  for (std::size_t k = 0; k < 3; ++k) {
    const CGAL::Orientation side = CGAL::orientation(seen[k], seen[(k + 1) % 3], at);
    if (side == -turn) return 0;
    is_on_edge = is_on_edge || side == CGAL::COLLINEAR;
  }
  const bool faces_along = turn == CGAL::LEFT_TURN;
  const CGAL::Orientation side = CGAL::orientation(corners[0], corners[1], corners[2], from);
  if (side == CGAL::COPLANAR || (side == CGAL::NEGATIVE) != faces_along) return 0;
  if (is_on_edge) return std::nullopt;
  return faces_along ? 1 : -1;
}

}  // namespace

std::size_t WindingRays::Grid::cell(std::size_t side, double at) const noexcept {
  const double place = (at - low[side]) * per_mm[side];
  return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(cells - 1)));
}

const WindingRays::Grid& WindingRays::grid_along(std::size_t axis) {
  Grid& grid = grids_[axis];
  if (grid.cells > 0) return grid;
  grid.cells = static_cast<std::size_t>(
      std::clamp(std::sqrt(static_cast<double>(mesh_.triangles.size())), 1.0, 1024.0));
  const std::array<std::size_t, 2> sides{(axis + 1) % 3, (axis + 2) % 3};
  for (std::size_t s = 0; s < 2; ++s) {
    grid.low[s] = box_.min[sides[s]];
    const double size = box_.size()[sides[s]];
    grid.per_mm[s] = size > 0.0 ? static_cast<double>(grid.cells) / size : 0.0;
  }
  const auto for_cells = [&](const Triangle& t, const auto& use) {
    Box3 of;
    for (const std::uint32_t v : t) of.include(mesh_.positions[v]);
    const auto range = [&](std::size_t s) {
      return std::pair{grid.cell(s, of.min[sides[s]] - slack_mm_),
                       grid.cell(s, of.max[sides[s]] + slack_mm_)};
    };
    const auto [first_u, last_u] = range(0);
    const auto [first_v, last_v] = range(1);
    for (std::size_t u = first_u; u <= last_u; ++u) {
      for (std::size_t v = first_v; v <= last_v; ++v) use(u * grid.cells + v);
    }
  };
  grid.begin.assign(grid.cells * grid.cells + 1, 0);
  for (const Triangle& t : mesh_.triangles) {
    for_cells(t, [&](std::size_t cell) { ++grid.begin[cell + 1]; });
  }
  std::partial_sum(grid.begin.begin(), grid.begin.end(), grid.begin.begin());
  grid.triangles.resize(grid.begin.back());
  std::vector<std::uint32_t> next(grid.begin.begin(), grid.begin.end() - 1);
  for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
    for_cells(mesh_.triangles[t], [&](std::size_t cell) { grid.triangles[next[cell]++] = t; });
  }
  return grid;
}

std::optional<std::int32_t> WindingRays::beyond(const ExactPoint& from, std::size_t axis) {
  const Grid& grid = grid_along(axis);
  const Vec3 at = nearest_doubles(from);
  const std::size_t cell =
      grid.cell(0, at[(axis + 1) % 3]) * grid.cells + grid.cell(1, at[(axis + 2) % 3]);
  std::int32_t winding = 0;
  for (std::uint32_t n = grid.begin[cell]; n < grid.begin[cell + 1]; ++n) {
    const auto& [a, b, c] = mesh_.triangles[grid.triangles[n]];
    const std::array<const Vec3*, 3> p{&mesh_.positions[a], &mesh_.positions[b],
                                       &mesh_.positions[c]};
    const double top = std::max({(*p[0])[axis], (*p[1])[axis], (*p[2])[axis]});
    if (top < at[axis] - slack_mm_) continue;
    const auto passed =
        passage({exact_point_of(*p[0]), exact_point_of(*p[1]), exact_point_of(*p[2])}, from, axis);
    if (!passed) return std::nullopt;
    winding += *passed;
  }
  return winding;
}

}  // namespace argil::mesh
