// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

#include "argil/engine/storage.h"

#include "field/vdb.h"

namespace argil {

// Coordinates as storage.h has them, and as OpenVDB has them.

inline Coord coord_of(const NodeCoord& node) noexcept { return {node[0], node[1], node[2]}; }
inline NodeCoord node_coord(const Coord& node) noexcept { return {node.x(), node.y(), node.z()}; }

/// For asserts.
inline bool is_aligned(const NodeCoord& origin, int side) noexcept {
  return std::all_of(origin.begin(), origin.end(), [&](int x) { return (x & (side - 1)) == 0; });
}

}  // namespace argil
