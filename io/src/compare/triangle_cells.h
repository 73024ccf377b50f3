// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>

#include "argil/core/vec3.h"
#include "argil/mesh/triangle_geometry.h"

namespace argil::io {

/// A cell of a lattice, by its low corner in sides of cells.
using CellIndex = std::array<int, 3>;

/// The cells of a lattice that a triangle passes through: columns of cells along the axis that its
/// normal is nearest to, and of each the cells between the least and the greatest height of its
/// plane.
///
/// Shapes       corners in cells, of any area and none, less than 2^20 from 0.
/// Accuracy     no cell with a point of the triangle is left out, faces and rounding included; some
///              beside it may be among them, within a cell of its sides.
/// Determinism  one order of the cells for a triangle.
class TriangleCells {
 public:
  explicit TriangleCells(const mesh::Corners& corners);

  /// Calls `use(cell)` for each until it says no; whether it never did.
  template <class Use>
  bool for_each(const Use& use) const {
    for (int i = floor_of(low_[0] - kMargin); i <= floor_of(high_[0] + kMargin); ++i) {
      const Range along = range_in_slab(i);
      for (int j = floor_of(along.low); j <= floor_of(along.high); ++j) {
        const Range heights = heights_over(i, j);
        for (int k = floor_of(heights.low); k <= floor_of(heights.high); ++k) {
          CellIndex cell{};
          cell[axes_[0]] = i;
          cell[axes_[1]] = j;
          cell[axes_[2]] = k;
          if (!use(cell)) return false;
        }
      }
    }
    return true;
  }

 private:
  /// Rounding takes no number of cells as far as this.
  static constexpr double kMargin = 1e-9;
  using Place = std::array<double, 3>;  ///< along the axes in the order of axes_
  struct Range {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
    void include(double x) noexcept {
      low = std::min(low, x);
      high = std::max(high, x);
    }
  };

  static int floor_of(double x) noexcept { return static_cast<int>(std::floor(x)); }

  /// How far the triangle reaches along the second axis in the i-th slab across the first one.
  Range range_in_slab(int i) const noexcept {
    Range range;
    for (std::size_t k = 0; k < 3; ++k) {
      const Place& a = corners_[k];
      const Place& b = corners_[(k + 1) % 3];
      const Place& left = a[0] <= b[0] ? a : b;
      const Place& right = a[0] <= b[0] ? b : a;
      const double from = std::max(left[0], i - kMargin);
      const double to = std::min(right[0], i + 1 + kMargin);
      if (from > to) continue;
      const double width = right[0] - left[0];
      const double slope = width > 0.0 ? (right[1] - left[1]) / width : 0.0;
      range.include(from == left[0] ? left[1] : left[1] + (from - left[0]) * slope);
      range.include(to == right[0] ? right[1] : left[1] + (to - left[0]) * slope);
    }
    return {std::max(range.low, low_[1]) - kMargin, std::min(range.high, high_[1]) + kMargin};
  }

  /// Heights of the plane over a square of the first two axes that the triangle has.
  Range heights_over(int i, int j) const noexcept {
    const double middle = corners_[0][2] + slopes_[0] * (i + 0.5 - corners_[0][0]) +
                          slopes_[1] * (j + 0.5 - corners_[0][1]);
    return {std::max(middle - spread_, low_[2] - kMargin),
            std::min(middle + spread_, high_[2] + kMargin)};
  }

  std::array<std::size_t, 3> axes_{};  ///< the last one is that of the heights
  std::array<Place, 3> corners_{};
  Place low_{};
  Place high_{};
  std::array<double, 2> slopes_{};  ///< of the plane, along the first two axes
  double spread_ = 0.0;             ///< of heights over a square, to each side of the middle
};

inline TriangleCells::TriangleCells(const mesh::Corners& corners) {
  const Vec3 normal = mesh::area_normal(corners);
  std::size_t highest = 0;
  for (std::size_t axis = 1; axis < 3; ++axis) {
    if (std::abs(normal[axis]) > std::abs(normal[highest])) highest = axis;
  }
  axes_ = {(highest + 1) % 3, (highest + 2) % 3, highest};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Range range;
    for (std::size_t k = 0; k < 3; ++k) {
      corners_[k][axis] = corners[k][axes_[axis]];
      range.include(corners_[k][axis]);
    }
    low_[axis] = range.low;
    high_[axis] = range.high;
    assert(std::max(std::abs(range.low), std::abs(range.high)) < 1 << 20);
  }
  // Without area there is no plane: then all heights of its box count.
  const double height = normal[highest];
  spread_ = high_[2] - low_[2] + 1.0;
  if (height == 0.0) return;
  slopes_ = {-normal[axes_[0]] / height, -normal[axes_[1]] / height};
  // How far rounding takes the plane from the corners: much only where there is nearly no area.
  double off = 0.0;
  for (const Place& corner : corners_) {
    const double plane = corners_[0][2] + slopes_[0] * (corner[0] - corners_[0][0]) +
                         slopes_[1] * (corner[1] - corners_[0][1]);
    off = std::max(off, std::abs(plane - corner[2]));
  }
  spread_ = 0.5 * (std::abs(slopes_[0]) + std::abs(slopes_[1])) + off + kMargin;
}

}  // namespace argil::io
