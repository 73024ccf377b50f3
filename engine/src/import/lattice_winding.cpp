// SPDX-License-Identifier: GPL-3.0-or-later
// Scan conversion. Notation: x and y of a triangle's corners are whole numbers of quanta, E is
// twice the area that an edge spans with a line's place, positive to the left of the edge. A line
// on an edge counts as to the left of it if it runs down, or along and to the right, so that of two
// triangles that share an edge exactly one has the line, or both or none where they overlap.
#include "import/lattice_winding.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <tbb/parallel_for.h>

namespace argil {
namespace {

constexpr std::size_t kTrianglesPerTask = 4096;
// A difference of coordinates below 2^30 quanta, so that E fits into 64 bits.
constexpr double kFineQuanta = 1 << 14;  // of a voxel, where the mesh is short enough
constexpr double kMostQuanta = 1 << 30;
constexpr double kCoarseQuanta = 1 << 11;  // for 2^19 voxels, as many as there are

struct QuantizedCorner {
  std::int64_t x;
  std::int64_t y;
};

bool is_left_of_edge(std::int64_t e, std::int64_t dx, std::int64_t dy) noexcept {
  if (e != 0) return e > 0;
  return dy != 0 ? dy < 0 : dx > 0;
}

std::int64_t floor_div(std::int64_t value, std::int64_t by) noexcept {
  return value >= 0 ? value / by : -((by - 1 - value) / by);
}

/// The whole numbers of a range.
struct LineRange {
  std::int64_t first;
  std::int64_t last;
};
LineRange multiples_within(std::int64_t low, std::int64_t high, std::int64_t quanta) noexcept {
  return {floor_div(low + quanta - 1, quanta), floor_div(high, quanta)};
}

/// Lines with this x that a triangle may have, none missed: where its edges pass there, and one
/// more on both sides.
LineRange lines_at(const std::array<QuantizedCorner, 3>& corner, std::int64_t x,
                   std::int64_t quanta) {
  double low = 1e300;
  double high = -1e300;
  for (std::size_t i = 0; i < 3; ++i) {
    const QuantizedCorner& a = corner[i];
    const QuantizedCorner& b = corner[(i + 1) % 3];
    if (std::min(a.x, b.x) > x || std::max(a.x, b.x) < x) continue;
    double from = static_cast<double>(a.y);
    double to = static_cast<double>(b.y);
    if (a.x != b.x) {
      const double along = static_cast<double>(x - a.x) / static_cast<double>(b.x - a.x);
      from = to = from + along * (to - from);
    }
    low = std::min({low, from, to});
    high = std::max({high, from, to});
  }
  const auto voxel = static_cast<double>(quanta);
  return {static_cast<std::int64_t>(std::floor(low / voxel)),
          static_cast<std::int64_t>(std::ceil(high / voxel))};
}

}  // namespace

struct LatticeWinding::Found {
  std::int32_t x;
  Crossing crossing;
};

LatticeWinding::LatticeWinding(const std::vector<Vec3>& positions,
                               const std::vector<Triangle>& triangles, const Vec3& center_mm,
                               double voxel_mm) {
  assert(voxel_mm > 0.0);
  Box3 box;
  for (const Triangle& t : triangles) {
    for (const std::uint32_t v : t) box.include(positions[v]);
  }
  if (triangles.empty()) return;
  const double longest = std::max(box.size().x, box.size().y) / voxel_mm;
  const double quanta = (longest + 1.0) * kFineQuanta < kMostQuanta ? kFineQuanta : kCoarseQuanta;
  const std::size_t tasks = (triangles.size() + kTrianglesPerTask - 1) / kTrianglesPerTask;
  std::vector<std::vector<Found>> found(tasks);
  tbb::parallel_for(std::size_t{0}, tasks, [&](std::size_t task) {
    const std::size_t end = std::min(triangles.size(), (task + 1) * kTrianglesPerTask);
    for (std::size_t n = task * kTrianglesPerTask; n < end; ++n) {
      std::array<Vec3, 3> corners;
      for (std::size_t i = 0; i < 3; ++i) {
        corners[i] = (positions[triangles[n][i]] + center_mm) / voxel_mm;
      }
      add_triangle(corners, quanta, found[task]);
    }
  });
  sort_into_lines(found);
}

void LatticeWinding::add_triangle(const std::array<Vec3, 3>& corners, double quanta,
                                  std::vector<Found>& found) const {
  std::array<QuantizedCorner, 3> at;
  for (std::size_t i = 0; i < 3; ++i) {
    at[i] = {std::llround(corners[i].x * quanta), std::llround(corners[i].y * quanta)};
  }
  const auto step = static_cast<std::int64_t>(quanta);
  const auto [x0, x1] = std::minmax({at[0].x, at[1].x, at[2].x});
  const auto [y0, y1] = std::minmax({at[0].y, at[1].y, at[2].y});
  const LineRange columns = multiples_within(x0, x1, step);
  const LineRange rows = multiples_within(y0, y1, step);
  if (columns.first > columns.last || rows.first > rows.last) return;
  const std::int64_t area =
      (at[1].x - at[0].x) * (at[2].y - at[0].y) - (at[1].y - at[0].y) * (at[2].x - at[0].x);
  if (area == 0) return;  // seen from its edge: its neighbours tell what there is to tell
  const auto [low_z, high_z] = std::minmax({corners[0].z, corners[1].z, corners[2].z});
  for (std::int64_t column = columns.first; column <= columns.last; ++column) {
    const std::int64_t x = column * step;
    const LineRange near = lines_at(at, x, step);
    for (std::int64_t row = std::max(rows.first, near.first); row <= std::min(rows.last, near.last);
         ++row) {
      const std::int64_t y = row * step;
      std::array<std::int64_t, 3> e;
      bool is_within = true;
      for (std::size_t i = 0; i < 3; ++i) {
        const QuantizedCorner& from = at[i];
        const QuantizedCorner& to = at[(i + 1) % 3];
        const std::int64_t dx = to.x - from.x;
        const std::int64_t dy = to.y - from.y;
        e[i] = dx * (y - from.y) - dy * (x - from.x);
        is_within &= is_left_of_edge(e[i], dx, dy) == (area > 0);
      }
      if (!is_within) continue;
      const double z =
          (static_cast<double>(e[1]) * corners[0].z + static_cast<double>(e[2]) * corners[1].z +
           static_cast<double>(e[0]) * corners[2].z) /
          static_cast<double>(area);
      found.push_back(
          {static_cast<std::int32_t>(column),
           {std::clamp(z, low_z, high_z), static_cast<std::int32_t>(row), area > 0 ? -1 : 1}});
    }
  }
}

void LatticeWinding::sort_into_lines(const std::vector<std::vector<Found>>& found) {
  int low = std::numeric_limits<int>::max();
  int high = std::numeric_limits<int>::min();
  std::size_t count = 0;
  for (const auto& list : found) {
    count += list.size();
    for (const Found& each : list) {
      low = std::min(low, each.x);
      high = std::max(high, each.x);
    }
  }
  if (count == 0) return;
  low_x_ = low;
  first_.assign(static_cast<std::size_t>(high - low) + 2, 0);
  for (const auto& list : found) {
    for (const Found& each : list) ++first_[static_cast<std::size_t>(each.x - low) + 1];
  }
  for (std::size_t x = 1; x < first_.size(); ++x) first_[x] += first_[x - 1];
  crossings_.resize(count);
  std::vector<std::uint64_t> next(first_.begin(), first_.end() - 1);
  for (const auto& list : found) {
    for (const Found& each : list) {
      crossings_[next[static_cast<std::size_t>(each.x - low)]++] = each.crossing;
    }
  }
  tbb::parallel_for(std::size_t{0}, next.size(), [&](std::size_t x) {
    const auto begin = crossings_.begin() + static_cast<std::ptrdiff_t>(first_[x]);
    const auto end = crossings_.begin() + static_cast<std::ptrdiff_t>(first_[x + 1]);
    std::sort(begin, end, [](const Crossing& a, const Crossing& b) {
      if (a.y != b.y) return a.y < b.y;
      return a.z != b.z ? a.z < b.z : a.above < b.above;
    });
    for (auto at = begin; at != end; ++at) {
      if (at != begin && (at - 1)->y == at->y) at->above += (at - 1)->above;
    }
  });
}

LatticeWinding::Line LatticeWinding::line_from(int x, int y) const noexcept {
  const auto column = static_cast<std::size_t>(x - low_x_);
  if (x < low_x_ || column + 1 >= first_.size()) return {nullptr, nullptr};
  const Crossing* begin = crossings_.data() + first_[column];
  const Crossing* end = crossings_.data() + first_[column + 1];
  return {std::lower_bound(begin, end, y, [](const Crossing& c, int row) { return c.y < row; }),
          end};
}

int LatticeWinding::at(const Coord& node) const noexcept {
  const auto [first, last] = line_from(node.x(), node.y());
  int number = 0;
  for (const Crossing* c = first; c != last && c->y == node.y() && c->z < node.z(); ++c) {
    number = c->above;
  }
  return number;
}

void LatticeWinding::sides_around(const Coord& origin, SidesAround& out) const noexcept {
  constexpr int kSide = SidesAround::kSide;
  assert(is_leaf_origin(origin));
  out.inside.fill(0);
  const int low_z = origin.z() - 1;
  for (int i = 0; i < kSide; ++i) {
    auto [c, last] = line_from(origin.x() - 1 + i, origin.y() - 1);
    while (c != last && c->y < origin.y() - 1 + kSide) {
      const int y = c->y;
      unsigned bits = 0;
      for (; c != last && c->y == y; ++c) {
        // The first node above; from there on all are as the crossing says, until the next.
        const double above = std::floor(c->z) + 1.0 - low_z;
        if (above >= kSide) continue;
        const int node = above > 0.0 ? static_cast<int>(above) : 0;
        const unsigned rest = (1U << kSide) - (1U << node);
        bits = c->above > 0 ? bits | rest : bits & ~rest;
      }
      out.inside[static_cast<std::size_t>(kSide * i + y - origin.y() + 1)] =
          static_cast<std::uint16_t>(bits);
    }
  }
}

void LatticeWinding::numbers(const Coord& origin,
                             std::array<std::int32_t, kLeafNodes>& out) const noexcept {
  assert(is_leaf_origin(origin));
  for (int row = 0; row < kLeafSide * kLeafSide; ++row) {
    const int y = origin.y() + row % kLeafSide;
    auto [c, last] = line_from(origin.x() + row / kLeafSide, y);
    std::int32_t number = 0;
    for (int k = 0; k < kLeafSide; ++k) {
      for (; c != last && c->y == y && c->z < origin.z() + k; ++c) number = c->above;
      out[static_cast<std::size_t>(kLeafSide * row + k)] = number;
    }
  }
}

}  // namespace argil
