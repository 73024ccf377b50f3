// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>

#include "argil/engine/clay.h"
#include "argil/engine/display_block.h"

namespace argil::viewer {

/// A view by which a clay is drawn from its coarse levels alone, wherever it is looked at from: the
/// finest level of no more than a few thousand leaves, some 100 000 triangles, which take a
/// twentieth of a second. Nothing for a clay that has no more than those at its finest.
inline std::optional<DisplayView> coarse_view(const Clay& clay) {
  constexpr std::int64_t kMostLeaves = 4000;
  const auto levels = clay.level_stats();
  std::size_t level = 0;
  while (level + 1 < levels.size() && levels[level].leaves > kMostLeaves) ++level;
  if (level == 0) return std::nullopt;
  DisplayView view;  // of a parallel projection, the same everywhere
  view.pixel_mm = levels[level].voxel_mm;
  view.coarser = static_cast<int>(level);
  return view;
}

}  // namespace argil::viewer
