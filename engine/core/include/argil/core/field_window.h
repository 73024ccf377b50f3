// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "argil/core/vec3.h"

namespace argil {

/// A dense block of signed distance around a tool: all that a force query ever reads.
///
/// Node (i, j, k), 0 <= i < nodes[0] and so on, lies at origin_mm + voxel_mm * (i, j, k) and holds
/// distance_mm[(i * nodes[1] + j) * nodes[2] + k]: z runs fastest, as in an OpenVDB leaf.
/// Distance is negative inside, extended on both sides as far as the block reaches.
/// A view: it owns nothing and is valid as long as the memory behind it. Trivially copyable
/// (FieldWindowView.IsTriviallyCopyableForTheServo).
///
/// Units        mm in the clay's frame.
/// Threads      any while nobody writes the memory; `index` and `at` are Realtime.
struct FieldWindowView {
  /// Where node (0, 0, 0) lies.
  Vec3 origin_mm;
  /// Spacing of the nodes along each axis; > 0.
  double voxel_mm = 0.0;
  /// Nodes along x, y and z; each >= 2, so that there is a cell to interpolate in.
  std::array<int, 3> nodes{};
  /// nodes[0] * nodes[1] * nodes[2] values.
  std::span<const float> distance_mm;
  /// Level of the clay that it was read from, the finer one where two are blended.
  int level = 0;

  /// How far the values are from the distance to the finest surface: root mean square near it,
  /// where a force query that knows its window's error wants to say so; 0: taken as exact.
  double distance_error_mm = 0.0;

  /// Place of a node in `distance_mm`; also right beyond 2^31 values
  /// (FieldWindowView.IndexesBlocksBeyondTwoToTheThirtyOne).
  std::size_t index(int i, int j, int k) const noexcept {
    return (static_cast<std::size_t>(i) * static_cast<std::size_t>(nodes[1]) +
            static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(nodes[2]) +
           static_cast<std::size_t>(k);
  }
  /// The distance at a node, which must lie in the block: nothing is checked.
  float at(int i, int j, int k) const noexcept { return distance_mm[index(i, j, k)]; }
};

}  // namespace argil
