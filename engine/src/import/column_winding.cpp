// SPDX-License-Identifier: GPL-3.0-or-later
#include "import/column_winding.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include <tbb/parallel_for.h>

namespace argil {
namespace {

constexpr std::size_t kListedPerTask = 4096;

}  // namespace

ColumnWinding::ColumnWinding(const std::vector<Vec3>& positions, std::vector<Triangle> triangles,
                             const Vec3& center_mm, double voxel_mm)
    : triangles_(std::move(triangles)),
      center_mm_(center_mm),
      voxel_mm_(voxel_mm),
      quanta_(quanta_for(positions, triangles_, voxel_mm)) {
  assert(voxel_mm > 0.0);
  vertices_.reserve(positions.size());
  for (const Vec3& p : positions) vertices_.push_back(quantized_place(p));
  const std::size_t tasks = (triangles_.size() + kListedPerTask - 1) / kListedPerTask;
  std::vector<std::vector<Lists::Found>> found(tasks);
  tbb::parallel_for(std::size_t{0}, tasks, [&](std::size_t task) {
    const std::size_t end = std::min(triangles_.size(), (task + 1) * kListedPerTask);
    for (std::size_t n = task * kListedPerTask; n < end; ++n) {
      add_triangle(static_cast<std::uint32_t>(n), found[task]);
    }
  });
  columns_.fill(
      found,
      [](const Entry& a, const Entry& b) {
        return a.y != b.y ? a.y < b.y : a.triangle < b.triangle;
      },
      [](const auto&) {});
}

void ColumnWinding::add_triangle(std::uint32_t triangle, std::vector<Lists::Found>& found) const {
  const QuantizedTriangle flat = quantized_triangle(triangle);
  if (flat.is_upright()) return;
  const WholeRange x = flat.x();
  const std::int64_t last = floor_div(x.last, quanta_);
  for (std::int64_t column = floor_div(x.first, quanta_); column <= last; ++column) {
    const WholeRange y = flat.y_between(column * quanta_, (column + 1) * quanta_ - 1);
    const std::int64_t last_row = floor_div(y.last, quanta_);
    for (std::int64_t row = floor_div(y.first, quanta_); row <= last_row; ++row) {
      found.push_back(
          {static_cast<std::int32_t>(column), {static_cast<std::int32_t>(row), triangle}});
    }
  }
}

int ColumnWinding::at(const Vec3& place_mm) const noexcept {
  assert(is_finite(place_mm));
  const auto [x, y, z] = quantized_place(place_mm);
  const auto entries = columns_.at(static_cast<int>(floor_div(x, quanta_)));
  const auto row = static_cast<std::int32_t>(floor_div(y, quanta_));
  auto entry = std::lower_bound(entries.begin(), entries.end(), row,
                                [](const Entry& e, std::int32_t wanted) { return e.y < wanted; });
  int number = 0;
  for (; entry != entries.end() && entry->y == row; ++entry) {
    const QuantizedTriangle flat = quantized_triangle(entry->triangle);
    if (flat.lowest() >= z) continue;
    const auto crossing = flat.crossing(x, y);
    if (crossing && *crossing < z) number += flat.change();
  }
  return number;
}

}  // namespace argil
