// SPDX-License-Identifier: GPL-3.0-or-later
// Works in the slice's own coordinates: columns and rows, in which it is bilinear between values.
#include "picture/slice_chord.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace argil::viewer {
namespace {

constexpr int kDirections = 60;
constexpr double kStep = 0.5;  // of the values' spacing

struct SlicePoint {
  double column = 0.0;
  double row = 0.0;
};

bool is_within(const SlicePicture& slice, const SlicePoint& p) {
  return p.column >= 0.0 && p.row >= 0.0 && p.column <= slice.columns - 1.0 &&
         p.row <= slice.rows - 1.0;
}

double distance_at(const SlicePicture& slice, const SlicePoint& p) {
  assert(is_within(slice, p));
  const int column = std::min(static_cast<int>(p.column), slice.columns - 2);
  const int row = std::min(static_cast<int>(p.row), slice.rows - 2);
  const auto value = [&](int c, int r) {
    return static_cast<double>(
        slice.distance_mm[static_cast<std::size_t>(r) * static_cast<std::size_t>(slice.columns) +
                          static_cast<std::size_t>(c)]);
  };
  const double u = p.column - column;
  const double v = p.row - row;
  return (1.0 - v) * ((1.0 - u) * value(column, row) + u * value(column + 1, row)) +
         v * ((1.0 - u) * value(column, row + 1) + u * value(column + 1, row + 1));
}

/// Where a line from inside meets the surface; nothing where it leaves the slice before.
std::optional<SlicePoint> surface_along(const SlicePicture& slice, const SlicePoint& from,
                                        double column_step, double row_step) {
  SlicePoint at = from;
  double former = distance_at(slice, at);
  for (;;) {
    const SlicePoint next{at.column + column_step, at.row + row_step};
    if (!is_within(slice, next)) return std::nullopt;
    const double distance = distance_at(slice, next);
    if (distance >= 0.0) {
      const double fraction = former / (former - distance);
      return SlicePoint{at.column + fraction * column_step, at.row + fraction * row_step};
    }
    at = next;
    former = distance;
  }
}

}  // namespace

std::optional<Chord> shortest_chord(const SlicePicture& slice, const Ray& ray) {
  if (slice.columns < 2 || slice.rows < 2) return std::nullopt;
  const Vec3 normal = cross(slice.along_mm, slice.down_mm);
  const double slope = dot(ray.direction, normal);
  if (slope == 0.0) return std::nullopt;
  const double t = dot(slice.corner_mm - ray.origin_mm, normal) / slope;
  if (!(t > 0.0)) return std::nullopt;
  const Vec3 beside = ray.origin_mm + t * ray.direction - slice.corner_mm;
  // Values an mm, along a row and down a column.
  const double wide = length(slice.along_mm);
  const double high = length(slice.down_mm);
  const double across = (slice.columns - 1) / wide;
  const double down = (slice.rows - 1) / high;
  const SlicePoint middle{dot(beside, slice.along_mm) / wide * across,
                          dot(beside, slice.down_mm) / high * down};
  if (!is_within(slice, middle) || !(distance_at(slice, middle) < 0.0)) return std::nullopt;
  const double step_mm = kStep / std::max(across, down);
  const auto place = [&](const SlicePoint& p) {
    return slice.corner_mm + (p.column / (slice.columns - 1)) * slice.along_mm +
           (p.row / (slice.rows - 1)) * slice.down_mm;
  };
  std::optional<Chord> best;
  for (int n = 0; n < kDirections; ++n) {
    const double angle = std::numbers::pi * n / kDirections;
    const double c = step_mm * across * std::cos(angle);
    const double r = step_mm * down * std::sin(angle);
    const auto one = surface_along(slice, middle, c, r);
    const auto other = surface_along(slice, middle, -c, -r);
    if (!one || !other) continue;
    const Chord chord{place(*one), place(*other)};
    const double shortest = best ? length(best->to_mm - best->from_mm) : HUGE_VAL;
    if (length(chord.to_mm - chord.from_mm) < shortest) best = chord;
  }
  return best;
}

}  // namespace argil::viewer
