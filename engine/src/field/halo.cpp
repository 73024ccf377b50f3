// SPDX-License-Identifier: GPL-3.0-or-later
// Rows are copied along z, leaf by leaf: most of what a halo holds lies in one leaf.
#include "field/halo.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "field/leaf_finder.h"

namespace argil {

LeafHalo with_halo(const LevelStack& stack, int level, const Coord& origin) {
  assert(is_leaf_origin(origin));
  LeafHalo value;
  value.fill(std::numeric_limits<float>::quiet_NaN());
  openvdb::CoordBBox box(origin, origin.offsetBy(kLeafSide - 1));
  box.expand(1);
  LeafFinder leaves(stack, level);
  for_each_leaf_origin(box, [&](const Coord& near) {
    const float* leaf = leaves.values(near);
    if (leaf == nullptr) return;
    const Coord lo = Coord::maxComponent(near, box.min());
    const Coord hi = Coord::minComponent(near.offsetBy(kLeafSide - 1), box.max());
    const auto count = static_cast<std::size_t>(hi.z() - lo.z() + 1);
    for (int x = lo.x(); x <= hi.x(); ++x) {
      for (int y = lo.y(); y <= hi.y(); ++y) {
        const Coord at = Coord(x, y, lo.z()) - box.min();
        const std::size_t to = static_cast<std::size_t>(at.x()) * kHaloStride[0] +
                               static_cast<std::size_t>(at.y()) * kHaloStride[1] +
                               static_cast<std::size_t>(at.z());
        std::copy_n(leaf + leaf_offset(Coord(x, y, lo.z())), count,
                    value.begin() + static_cast<std::ptrdiff_t>(to));
      }
    }
  });
  return value;
}

void overlay_leaf(const float* values, LeafHalo& halo) {
  for (std::size_t n = 0; n < kLeafNodes; ++n) halo[halo_index(n)] = values[n];
}

}  // namespace argil
