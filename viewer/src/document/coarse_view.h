// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "argil/engine/clay.h"
#include "argil/engine/display_block.h"

namespace argil::viewer {

/// A view by which a clay is drawn from its coarse levels alone, wherever it is looked at from: the
/// finest level of no more than so many leaves, or the coarsest. 4000 have some 100 000 triangles,
/// which take a twentieth of a second. Nothing for a clay that has no more than those at its
/// finest.
inline std::optional<DisplayView> coarse_view(const Clay& clay, std::int64_t most_leaves = 4000) {
  const auto levels = clay.level_stats();
  std::size_t level = 0;
  while (level + 1 < levels.size() && levels[level].leaves > most_leaves) ++level;
  if (level == 0) return std::nullopt;
  DisplayView view;  // of a parallel projection, the same everywhere
  view.pixel_mm = levels[level].voxel_mm;
  view.coarser = static_cast<int>(level);
  return view;
}

}  // namespace argil::viewer
