// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "argil/core/vec3.h"

#include "field/leaf.h"

namespace argil {

/// The nodes `low` to `high` (inclusive) of one level.
struct NodeBox {
  Coord low;
  Coord high;

  std::array<int, 3> sides() const noexcept {
    return {high.x() - low.x() + 1, high.y() - low.y() + 1, high.z() - low.z() + 1};
  }
  /// Of a box that is not empty.
  std::size_t count() const noexcept {
    const std::array<int, 3> n = sides();
    return static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1]) *
           static_cast<std::size_t>(n[2]);
  }
  NodeBox grown(int nodes) const noexcept { return {low.offsetBy(-nodes), high.offsetBy(nodes)}; }
  bool has(const Coord& at) const noexcept {
    for (int axis = 0; axis < 3; ++axis) {
      if (at[axis] < low[axis] || at[axis] > high[axis]) return false;
    }
    return true;
  }
  bool meets(const NodeBox& other) const noexcept {
    for (int axis = 0; axis < 3; ++axis) {
      if (high[axis] < other.low[axis] || other.high[axis] < low[axis]) return false;
    }
    return true;
  }
};

/// The smallest box of nodes of spacing `voxel_mm` that covers the box of half side `reach_mm`.
NodeBox covering_nodes(const Vec3& center_mm, double reach_mm, double voxel_mm);

/// Calls visit(Coord) for every node of the box, x slowest.
template <class Visit>
void for_each_node(const NodeBox& box, const Visit& visit) {
  for (int x = box.low.x(); x <= box.high.x(); ++x) {
    for (int y = box.low.y(); y <= box.high.y(); ++y) {
      for (int z = box.low.z(); z <= box.high.z(); ++z) visit(Coord(x, y, z));
    }
  }
}

/// The nodes of a leaf that lie within the box.
NodeBox part_of(const NodeBox& box, const Coord& origin);

}  // namespace argil
