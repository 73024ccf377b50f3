// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <vector>

#include "argil/core/vec3.h"

#include "field/vdb.h"

namespace argil {

// A leaf is a cube of 8^3 nodes, named by its origin: its lowest node, every coordinate of which is
// a multiple of 8, whether a level stores that leaf or not.

inline constexpr int kLeafSide = 8;
inline constexpr int kLeafNodes = 512;

/// Index of a node within its leaf: x slowest, z fastest, as in OpenVDB.
inline int leaf_offset(const Coord& node) noexcept {
  return ((node.x() & 7) << 6) | ((node.y() & 7) << 3) | (node.z() & 7);
}
/// The origin of the leaf that a node belongs to, present or not.
inline Coord leaf_origin(const Coord& node) noexcept { return node & ~7; }
/// Whether a node is the origin of a leaf.
inline bool is_leaf_origin(const Coord& node) noexcept { return leaf_origin(node) == node; }
/// Where a node lies.
inline Vec3 node_mm(const Coord& node, double voxel_mm) noexcept {
  return {voxel_mm * node.x(), voxel_mm * node.y(), voxel_mm * node.z()};
}
/// The node with an offset in the leaf at `origin`.
inline Coord node_of(const Coord& origin, std::size_t offset) noexcept {
  const auto n = static_cast<int>(offset);
  return origin.offsetBy(n >> 6, n >> 3 & 7, n & 7);
}
/// The node of the next coarser level at or below (floor of half), also for negative coordinates.
inline Coord coarser(const Coord& node) noexcept { return node >> 1; }

/// The origin of one of the 8 leaves of the next finer level that a leaf covers; of `octant`, bit 2
/// is the place along x, bit 0 along z.
inline Coord octant_origin(const Coord& origin, int octant) noexcept {
  const auto place = [octant](int bit) { return (octant >> bit & 1) * kLeafSide; };
  return (origin << 1).offsetBy(place(2), place(1), place(0));
}

/// Whether leaf origins are sorted and without repeats. Linear: for asserts.
inline bool are_sorted_origins(const std::vector<Coord>& origins) {
  return std::all_of(origins.begin(), origins.end(), is_leaf_origin) &&
         std::adjacent_find(origins.begin(), origins.end(), [](const Coord& a, const Coord& b) {
           return !(a < b);
         }) == origins.end();
}

/// The values of a leaf's nodes, by leaf_offset().
using LeafValues = std::array<float, kLeafNodes>;

/// Those of a leaf of the tree. VdbLeaf's own data() is a call for each leaf, since it might still
/// have to be read from a file; ours never do.
inline const float* values_of(const VdbLeaf& leaf) noexcept {
  const float* const values = &leaf.getFirstValue();
  assert(values == leaf.buffer().data());
  return values;
}

/// Calls `visit(origin)` for every leaf, stored or not, that meets the node box, in order.
template <class Visit>
void for_each_leaf_origin(const openvdb::CoordBBox& nodes, Visit&& visit) {
  const Coord lo = leaf_origin(nodes.min());
  const Coord hi = leaf_origin(nodes.max());
  for (int x = lo.x(); x <= hi.x(); x += kLeafSide) {
    for (int y = lo.y(); y <= hi.y(); y += kLeafSide) {
      for (int z = lo.z(); z <= hi.z(); z += kLeafSide) visit(Coord(x, y, z));
    }
  }
}

}  // namespace argil
