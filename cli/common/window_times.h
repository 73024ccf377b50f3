// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "argil/core/result.h"
#include "argil/engine/clay.h"
#include "argil/engine/window.h"
#include "argil/haptics/force/tool_force.h"

namespace argil::cli {

/// What the windows take that the servo reads for a tool, thread CPU time in ms.
struct WindowTimes {
  std::vector<double> fresh;      ///< nothing of an earlier one is kept
  std::vector<double> moved;      ///< the tool is four nodes of the window from where it was
  std::vector<double> after_dab;  ///< the tool carved where it is; empty where it cannot

  void append(const WindowTimes& other);
};

/// The window that a servo asks for where a tool is, with nodes every `spacing_mm`, that may move
/// `margin_mm` in it; less where that would not fit a slot (kWindowCapacity).
WindowRequest servo_window(const haptics::ForceTool& tool, const haptics::ForceMaterial& material,
                           double spacing_mm, double margin_mm);

/// Times `count` windows of each kind around the tool, with all that publishing one takes.
///
/// Moves go to and fro along the surface, 8 nodes to either side of the tool. Dabs are as large as
/// the tool, and each is taken back: the clay, without an open stroke, then has the bits that it
/// had, but what could be redone is another dab.
///
/// Errors   as read_window; memory.
Result<WindowTimes> time_windows(Clay& clay, const haptics::ForceTool& tool,
                                 const WindowRequest& request, int count);

}  // namespace argil::cli
