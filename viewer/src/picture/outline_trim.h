// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "argil/core/vec3.h"
#include "argil/engine/mask_outline.h"
#include "argil/engine/operation.h"

namespace argil::viewer {

/// What a view shows within loops is cut away, or all but that, right through the clay; all in the
/// frame of the clay.
struct OutlineTrim {
  ViewFrame view;
  /// Each closed, not crossing itself, and counter-clockwise where y points up.
  std::vector<std::vector<PicturePoint>> loops;
  bool keeps_within = false;
};

/// For clay that is within these bounds; nothing where all loops lie beside it.
std::optional<Combine> combine_of(const OutlineTrim& trim, const Box3& bounds_mm);

}  // namespace argil::viewer
