// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "argil/core/result.h"
#include "argil/engine/clay.h"
#include "argil/haptics/force/tool_force.h"

namespace argil::cli {

/// What the windows take that the servo reads for a tool, thread CPU time in ms.
struct WindowTimes {
  std::vector<double> fresh;      ///< nothing of an earlier one is kept
  std::vector<double> moved;      ///< the tool is four nodes of the window from where it was
  std::vector<double> after_dab;  ///< the tool carved where it is; empty where it cannot

  void append(const WindowTimes& other);
};

/// Times `count` windows of each kind around the tool, with all that publishing one takes.
///
/// Moves go to and fro along the surface, 8 nodes to either side of the tool. Dabs are as large as
/// the tool, and each is taken back: the clay, without an open stroke, then has the bits that it
/// had, but what could be redone is another dab.
///
/// Units    margin_mm: how far the tool may move within a window, >= 0.
/// Errors   as read_window; memory.
Result<WindowTimes> time_windows(Clay& clay, const haptics::ForceTool& tool,
                                 const haptics::ForceMaterial& material, double margin_mm,
                                 int count);

}  // namespace argil::cli
