// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/engine/display_block.h"

#include "field/leaf_change.h"
#include "surface/block_extractor.h"

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

inline BlockId id_of(const LeafKey& at) {
  return {at.level, {at.origin.x(), at.origin.y(), at.origin.z()}};
}
inline LeafKey leaf_of(const BlockId& id) {
  return {id.level, Coord(id.origin[0], id.origin[1], id.origin[2])};
}

}  // namespace argil
