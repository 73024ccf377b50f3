// SPDX-License-Identifier: GPL-3.0-or-later
// Scan conversion.
#include "import/lattice_winding.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <tbb/parallel_for.h>

namespace argil {
namespace {

constexpr std::size_t kTrianglesPerTask = 4096;

WholeRange multiples_within(const WholeRange& range, std::int64_t quanta) noexcept {
  return {floor_div(range.first + quanta - 1, quanta), floor_div(range.last, quanta)};
}

}  // namespace

LatticeWinding::LatticeWinding(const std::vector<Vec3>& positions,
                               const std::vector<Triangle>& triangles, const Vec3& center_mm,
                               double voxel_mm) {
  assert(voxel_mm > 0.0);
  const std::int64_t quanta = quanta_for(positions, triangles, voxel_mm);
  const std::size_t tasks = (triangles.size() + kTrianglesPerTask - 1) / kTrianglesPerTask;
  std::vector<std::vector<Columns::Found>> found(tasks);
  tbb::parallel_for(std::size_t{0}, tasks, [&](std::size_t task) {
    const std::size_t end = std::min(triangles.size(), (task + 1) * kTrianglesPerTask);
    for (std::size_t n = task * kTrianglesPerTask; n < end; ++n) {
      const auto corner = [&](std::size_t i) {
        return quantized((positions[triangles[n][i]] + center_mm) / voxel_mm, quanta);
      };
      add_triangle({corner(0), corner(1), corner(2)}, quanta, found[task]);
    }
  });
  columns_.fill(
      found,
      [](const Crossing& a, const Crossing& b) {
        if (a.y != b.y) return a.y < b.y;
        return a.z != b.z ? a.z < b.z : a.above < b.above;
      },
      [](std::span<Crossing> column) {
        for (std::size_t n = 1; n < column.size(); ++n) {
          if (column[n - 1].y == column[n].y) column[n].above += column[n - 1].above;
        }
      });
}

void LatticeWinding::add_triangle(const QuantizedTriangle& triangle, std::int64_t quanta,
                                  std::vector<Columns::Found>& found) {
  const WholeRange columns = multiples_within(triangle.x(), quanta);
  const WholeRange rows = multiples_within(triangle.y(), quanta);
  if (columns.first > columns.last || rows.first > rows.last || triangle.is_upright()) return;
  for (std::int64_t column = columns.first; column <= columns.last; ++column) {
    const std::int64_t x = column * quanta;
    const WholeRange near = multiples_within(triangle.y_between(x, x), quanta);
    for (std::int64_t row = near.first; row <= near.last; ++row) {
      if (const auto z = triangle.crossing(x, row * quanta)) {
        found.push_back({static_cast<std::int32_t>(column),
                         {*z, static_cast<std::int32_t>(row), triangle.change()}});
      }
    }
  }
}

LatticeWinding::Line LatticeWinding::line_from(int x, int y) const noexcept {
  const std::span<const Crossing> column = columns_.at(x);
  const Crossing* end = column.data() + column.size();
  return {
      std::lower_bound(column.data(), end, y, [](const Crossing& c, int row) { return c.y < row; }),
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
