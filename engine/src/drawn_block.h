// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/engine/display_surface.h"

#include "leaf_change.h"
#include "surface_block.h"

namespace argil {

/// A block as it is drawn: what SurfaceBlock holds without its keys, rounded to float.
struct DrawnBlock {
  std::vector<DisplayVertex> vertices;
  std::vector<Triangle> triangles;
  BlockTrace trace;

  static constexpr bool kIsListed = true;  ///< BlocksOf tells which of them change

  std::int64_t triangle_count() const noexcept {
    return static_cast<std::int64_t>(triangles.size());
  }
  /// Becomes `from`. Says whether any bit of what is drawn changed.
  bool assign(const SurfaceBlock& from);
  /// What a renderer gets of it; `voxel_mm` of level 0.
  DisplayBlock shown_as(const BlockId& id, double voxel_mm) const;
};

inline BlockId id_of(const LeafPlace& at) {
  return {at.level, {at.place.x(), at.place.y(), at.place.z()}};
}
inline LeafPlace place_of(const BlockId& id) {
  return {id.level, Coord(id.place[0], id.place[1], id.place[2])};
}

}  // namespace argil
