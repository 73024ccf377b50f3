// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "argil/core/vec3.h"

#include "field/level_stack.h"

namespace argil {

/// Whether a direction has unit length but for rounding: for asserts.
inline bool is_unit(const Vec3& direction) noexcept {
  return std::abs(dot(direction, direction) - 1.0) < 1e-6;
}

// Notation: lengths along a ray are in voxels of level 0, and so are points; "cell" without a level
// is one of level 0.

/// A box of cells of level 0.
struct CellBox {
  Coord low;
  Coord high;  ///< exclusive

  static CellBox cube(const Coord& low, int side) noexcept { return {low, low.offsetBy(side)}; }
  bool contains(const Coord& cell) const noexcept {
    for (int axis = 0; axis < 3; ++axis) {
      if (cell[axis] < low[axis] || cell[axis] >= high[axis]) return false;
    }
    return true;
  }
};

/// One ray on its path from cell to cell. `cell` is the cell of level 0 it is in; its coordinates
/// only ever change in the ray's direction, which is why it ends however the arithmetic rounds.
class RayWalk {
 public:
  /// `direction` of unit length.
  RayWalk(const Vec3& origin, const Vec3& direction) noexcept : origin_(origin), step_(direction) {
    for (std::size_t a = 0; a < 3; ++a) {
      if (std::abs(step_[a]) < kNoDirection) step_[a] = 0.0;
      inverse_[a] = step_[a] != 0.0 ? 1.0 / step_[a] : 0.0;
    }
  }

  double along() const noexcept { return along_; }
  const Coord& cell() const noexcept { return cell_; }
  const Vec3& step() const noexcept { return step_; }
  Vec3 point() const noexcept { return origin_ + along_ * step_; }

  /// Goes to where the ray enters the box; false when it never does.
  bool enter(const CellBox& box) noexcept {
    double first = 0.0;
    double last = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      if (step_[a] == 0.0) {
        if (!(origin_[a] >= box.low[axis] && origin_[a] < box.high[axis])) return false;
        continue;
      }
      const double to_low = (box.low[axis] - origin_[a]) * inverse_[a];
      const double to_high = (box.high[axis] - origin_[a]) * inverse_[a];
      first = std::max(first, std::min(to_low, to_high));
      last = std::min(last, std::max(to_low, to_high));
    }
    if (first > last) return false;
    along_ = first;
    const Vec3 p = point();
    for (int axis = 0; axis < 3; ++axis) {
      const double floor = std::floor(p[static_cast<std::size_t>(axis)]);
      cell_[axis] = static_cast<int>(std::clamp(floor, box.low[axis] + 0.0, box.high[axis] - 1.0));
    }
    return true;
  }

  struct Exit {
    double along = std::numeric_limits<double>::infinity();
    int axis = 0;
  };

  /// Where the ray leaves a box that its cell is in.
  Exit exit_of(const CellBox& box) const noexcept {
    assert(box.contains(cell_));
    Exit exit;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      if (step_[a] == 0.0) continue;
      const int face = step_[a] > 0.0 ? box.high[axis] : box.low[axis];
      const double there = (face - origin_[a]) * inverse_[a];
      if (there < exit.along) exit = {there, axis};
    }
    exit.along = std::max(exit.along, along_);
    return exit;
  }

  /// Goes there: into the first cell beyond the box.
  void leave(const CellBox& box, const Exit& exit) noexcept {
    assert(exit.along >= along_ && exit.axis >= 0 && exit.axis < 3);
    along_ = exit.along;
    const Vec3 p = point();
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const bool up = step_[a] > 0.0;
      if (axis == exit.axis) {
        cell_[axis] = up ? box.high[axis] : box.low[axis] - 1;
      } else if (step_[a] != 0.0) {
        const int width = box.high[axis] - box.low[axis];
        const double in = std::clamp(p[a] - box.low[axis], 0.0, width - 1.0);
        const int there = box.low[axis] + static_cast<int>(in);
        cell_[axis] = up ? std::max(there, cell_[axis]) : std::min(there, cell_[axis]);
      }
    }
  }

 private:
  /// A component this small moves a ray by nothing that counts over any clay's extent, and its
  /// inverse could overflow.
  static constexpr double kNoDirection = 1e-18;

  Vec3 origin_;
  Vec3 step_;
  Vec3 inverse_;
  double along_ = 0.0;
  Coord cell_;
};

}  // namespace argil
