// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "argil/core/vec3.h"

namespace argil::mesh {

/// Gives points whose coordinates have equal bits one index; -0 counts as 0 and is stored as such.
/// Nothing is welded that is merely near: rims that nearly meet are for close_mesh.
///
/// Shapes       finite points: one with a NaN equals none, not even itself.
/// Determinism  indices go by the first time a point is added, whatever the table does.
/// Threads      one; allocates, and may throw std::bad_alloc.
/// Cost         a hash table with open addressing, from a third to two thirds full: 6 to 12 bytes a
///              point beside the point itself; constant time a point on average.
class PointWelder {
 public:
  /// `positions` must be empty, outlive this and change through it alone.
  explicit PointWelder(std::vector<Vec3>& positions) : positions_(positions) {}

  /// The index of `point` in the positions, appended when it is new. At most 2^32 - 1 points.
  std::uint32_t add(const Vec3& point);

 private:
  void grow();
  std::vector<Vec3>& positions_;
  std::vector<std::uint32_t> slots_;  ///< open addressing; kFree or an index
};

}  // namespace argil::mesh
