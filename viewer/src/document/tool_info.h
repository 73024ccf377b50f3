// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "argil/engine/action.h"

namespace argil::viewer {

/// A tool of the window: an action of the engine, or one of them used in another way (the stamp).
struct ToolInfo : ActionInfo {
  bool is_stamp = false;  ///< once for each press, where the pointer is
};
/// All of them, in the order in which panels show them.
std::span<const ToolInfo> tool_infos() noexcept;

}  // namespace argil::viewer
