// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "argil/core/vec3.h"

namespace argil::mesh {

/// Gives points whose coordinates have equal bits one index; -0 counts as 0.
///
/// Cost         a hash table with open addressing: 12 to 24 bytes a point.
class PointWelder {
 public:
  /// `positions` must outlive this and change through it alone.
  explicit PointWelder(std::vector<Vec3>& positions) : positions_(positions) {}

  /// The index of `point` in the positions, appended when it is new. At most 2^32 - 1 points.
  std::uint32_t add(const Vec3& point);

 private:
  void grow();
  std::vector<Vec3>& positions_;
  std::vector<std::uint32_t> slots_;  ///< open addressing; kFree or an index
};

}  // namespace argil::mesh
