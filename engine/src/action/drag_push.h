// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "argil/engine/action.h"

#include "brush/stroke_motion.h"

namespace argil {

/// The pushes of grab and of twist: each depends on the dab and the point alone.
std::unique_ptr<const Push> grab_push();
std::unique_ptr<const Push> twist_push();

/// That of an action, or nothing where what a dab moves cannot be told from it and a point, or not
/// quickly: elastic reaches three times as far as its tool, slide asks the clay.
inline std::unique_ptr<const Push> drag_push_of(Action action) {
  if (action == Action::grab) return grab_push();
  if (action == Action::twist) return twist_push();
  return nullptr;
}

}  // namespace argil
