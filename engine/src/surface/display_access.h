// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "argil/engine/display_surface.h"

#include "surface/drawn_block.h"

namespace argil {

/// Which state of a DisplaySurface its blocks are in. Whoever keeps something made from them knows
/// by it whether the surface's lists are all that it missed: then `before` is what it took in last.
struct DisplayEdition {
  std::uint64_t before = 0;  ///< `now` before the last update, 0 for none
  std::uint64_t now = 0;     ///< of no other surface and no other update of this program; 0: none
};

/// What of a DisplaySurface only the engine sees.
struct DisplayAccess {
  static DisplayEdition edition(const DisplaySurface& surface) noexcept;

  /// Of level 0 of the clay of the last update; 0 before the first.
  static double voxel_mm(const DisplaySurface& surface) noexcept;

  /// The coarsest level of which the last view hides a leaf; -1 where it hides none.
  static int coarsest_hidden(const DisplaySurface& surface) noexcept;

  /// DisplaySurface::blocks in no order.
  static std::vector<BlockId> drawn(const DisplaySurface& surface);

  /// One that has triangles. It stays where it is, whatever becomes of its bits, until the surface
  /// lists it as gone.
  static const DrawnBlock& block(const DisplaySurface& surface, const BlockId& id);
};

}  // namespace argil
