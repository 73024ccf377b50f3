// SPDX-License-Identifier: GPL-3.0-or-later
// Notation: E is twice the area that an edge spans with a line's place, positive to the left of the
// edge. A line on an edge counts as to the left of it if it runs down, or along and to the right,
// so that of two triangles that share an edge exactly one has the line, or both or none where they
// overlap.
#include "import/quantized_triangle.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace argil {
namespace {

bool is_left_of_edge(std::int64_t e, std::int64_t dx, std::int64_t dy) noexcept {
  if (e != 0) return e > 0;
  return dy != 0 ? dy < 0 : dx > 0;
}

}  // namespace

std::int64_t floor_div(std::int64_t value, std::int64_t by) noexcept {
  return value >= 0 ? value / by : -((by - 1 - value) / by);
}

std::int64_t quanta_for(const std::vector<Vec3>& positions, const std::vector<Triangle>& triangles,
                        double voxel_mm) {
  // A difference of coordinates below 2^30 quanta.
  constexpr std::int64_t kFineQuanta = 1 << 14;
  constexpr double kMostQuanta = 1 << 30;
  constexpr std::int64_t kCoarseQuanta = 1 << 11;  // for 2^19 voxels, as many as there are
  Box3 box;
  for (const Triangle& t : triangles) {
    for (const std::uint32_t v : t) box.include(positions[v]);
  }
  const double longest = std::max(box.size().x, box.size().y) / voxel_mm;
  const bool fits = (longest + 1.0) * static_cast<double>(kFineQuanta) < kMostQuanta;
  return fits ? kFineQuanta : kCoarseQuanta;
}

QuantizedPlace quantized(const Vec3& voxels, std::int64_t quanta) noexcept {
  const auto scale = static_cast<double>(quanta);
  return {std::llround(voxels.x * scale), std::llround(voxels.y * scale), voxels.z};
}

QuantizedTriangle::QuantizedTriangle(const QuantizedPlace& a, const QuantizedPlace& b,
                                     const QuantizedPlace& c) noexcept
    : at_{a, b, c}, area_((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) {}

WholeRange QuantizedTriangle::x() const noexcept {
  const auto [low, high] = std::minmax({at_[0].x, at_[1].x, at_[2].x});
  return {low, high};
}

WholeRange QuantizedTriangle::y() const noexcept {
  const auto [low, high] = std::minmax({at_[0].y, at_[1].y, at_[2].y});
  return {low, high};
}

/// The y of each edge's part there, and one more on both sides.
WholeRange QuantizedTriangle::y_between(std::int64_t low, std::int64_t high) const noexcept {
  assert(low <= high);
  double least = 1e300;
  double most = -1e300;
  for (std::size_t i = 0; i < 3; ++i) {
    const QuantizedPlace& a = at_[i];
    const QuantizedPlace& b = at_[(i + 1) % 3];
    if (std::min(a.x, b.x) > high || std::max(a.x, b.x) < low) continue;
    const auto y_at = [&](std::int64_t x) {
      const double along = static_cast<double>(x - a.x) / static_cast<double>(b.x - a.x);
      return static_cast<double>(a.y) +
             std::clamp(along, 0.0, 1.0) * static_cast<double>(b.y - a.y);
    };
    const bool is_along_y = a.x == b.x;
    const double from = is_along_y ? static_cast<double>(a.y) : y_at(low);
    const double to = is_along_y ? static_cast<double>(b.y) : y_at(high);
    least = std::min({least, from, to});
    most = std::max({most, from, to});
  }
  return {static_cast<std::int64_t>(std::floor(least)) - 1,
          static_cast<std::int64_t>(std::ceil(most)) + 1};
}

std::optional<double> QuantizedTriangle::crossing(std::int64_t x, std::int64_t y) const noexcept {
  assert(!is_upright());
  std::array<std::int64_t, 3> e;
  for (std::size_t i = 0; i < 3; ++i) {
    const QuantizedPlace& from = at_[i];
    const QuantizedPlace& to = at_[(i + 1) % 3];
    const std::int64_t dx = to.x - from.x;
    const std::int64_t dy = to.y - from.y;
    e[i] = dx * (y - from.y) - dy * (x - from.x);
    if (is_left_of_edge(e[i], dx, dy) != (area_ > 0)) return std::nullopt;
  }
  const double z = (static_cast<double>(e[1]) * at_[0].z + static_cast<double>(e[2]) * at_[1].z +
                    static_cast<double>(e[0]) * at_[2].z) /
                   static_cast<double>(area_);
  const auto [low, high] = std::minmax({at_[0].z, at_[1].z, at_[2].z});
  return std::clamp(z, low, high);
}

}  // namespace argil
