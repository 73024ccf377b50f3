// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "argil/core/triangle_mesh.h"
#include "argil/core/vec3.h"

namespace argil {

/// The whole numbers from first to last.
struct WholeRange {
  std::int64_t first;
  std::int64_t last;
};

std::int64_t floor_div(std::int64_t value, std::int64_t by) noexcept;

/// How finely x and y are rounded: a power of two of a voxel, so that products of differences fit
/// into 64 bits. 2^14; 2^11 for a mesh of more than 2^16 voxels.
std::int64_t quanta_for(const std::vector<Vec3>& positions, const std::vector<Triangle>& triangles,
                        double voxel_mm);

/// A place in voxels, x and y in quanta.
struct QuantizedPlace {
  std::int64_t x;
  std::int64_t y;
  double z;
};
QuantizedPlace quantized(const Vec3& voxels, std::int64_t quanta) noexcept;

/// A triangle with the x and y of its corners in quanta. Which vertical lines pass it is decided in
/// integers, with one rule for ties: of a closed mesh each line crosses as much upward as downward.
class QuantizedTriangle {
 public:
  QuantizedTriangle(const QuantizedPlace& a, const QuantizedPlace& b,
                    const QuantizedPlace& c) noexcept;

  WholeRange x() const noexcept;  ///< in quanta
  WholeRange y() const noexcept;
  /// Where the triangle has places with an x from `low` to `high`, in quanta, none missed.
  WholeRange y_between(std::int64_t low, std::int64_t high) const noexcept;

  double lowest() const noexcept { return std::min({at_[0].z, at_[1].z, at_[2].z}); }  ///< voxels

  /// Seen from its edge no line crosses it: its neighbours tell what there is to tell.
  bool is_upright() const noexcept { return area_ == 0; }
  /// By what the winding number is greater above it.
  int change() const noexcept { return area_ > 0 ? -1 : 1; }
  /// Where the line at x and y, in quanta, crosses it, in voxels. Not for upright ones.
  std::optional<double> crossing(std::int64_t x, std::int64_t y) const noexcept;

 private:
  std::array<QuantizedPlace, 3> at_;
  std::int64_t area_;  ///< twice, positive where it is seen counterclockwise from above
};

}  // namespace argil
