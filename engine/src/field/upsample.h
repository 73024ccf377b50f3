// SPDX-License-Identifier: GPL-3.0-or-later
// A leaf's nodes between those of the next coarser level that span it, whatever holds them.
#pragma once

#include <array>
#include <vector>

#include "field/leaf.h"

namespace argil {

/// The 5^3 nodes of the next coarser level that span a leaf, x slowest.
inline constexpr int kCoarseNodesSide = 5;
using CoarseNodes = std::array<float, 125>;

/// The values of those nodes from anywhere: `values(origin)` gives those of a leaf or null, and
/// then `sample(node)` each of its nodes.
template <class Values, class Sample>
CoarseNodes gather_coarse(const Coord& fine_origin, const Values& values, const Sample& sample) {
  CoarseNodes out;
  const Coord low = coarser(fine_origin);
  const openvdb::CoordBBox box(low, low.offsetBy(kCoarseNodesSide - 1));
  for_each_leaf_origin(box, [&](const Coord& origin) {
    const float* leaf = values(origin);
    const Coord first = Coord::maxComponent(origin, box.min());
    const Coord last = Coord::minComponent(origin.offsetBy(kLeafSide - 1), box.max());
    for (int x = first.x(); x <= last.x(); ++x) {
      for (int y = first.y(); y <= last.y(); ++y) {
        const int row =
            ((x - low.x()) * kCoarseNodesSide + y - low.y()) * kCoarseNodesSide - low.z();
        for (int z = first.z(); z <= last.z(); ++z) {
          const Coord node(x, y, z);
          out[static_cast<std::size_t>(row + z)] =
              leaf != nullptr ? leaf[leaf_offset(node)] : sample(node);
        }
      }
    }
  });
  return out;
}

/// The 8^3 nodes of the leaf that they span: odd nodes average their coarse neighbours pairwise,
/// one axis after the other.
void upsample(const CoarseNodes& coarse, LeafValues& out);

/// Copies what a leaf's values and the node box have in common to `out`, the box's nodes, z
/// fastest.
void copy_into_box(const Coord& origin, const float* values, const openvdb::CoordBBox& box,
                   std::vector<float>& out);

/// Clamps values to the band, to both sides.
void clamp_to(float band, LeafValues& values) noexcept;

}  // namespace argil
