// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/result.h"
#include "argil/engine/clay.h"
#include "argil/engine/window.h"
#include "argil/haptics/force/lattice_force.h"
#include "argil/haptics/force/tool_force.h"

namespace argil::cli {

/// How a force is taken from a window: summed over a fixed number of nodes, over every finest voxel
/// by exact distances, or at the tool's centre alone.
enum class FeltMethod { lod, fine, point };

/// Who asks calls the tool and the method `fine` so: "--tool", "--method fine".
struct FeltWords {
  const char* tool;
  const char* fine;
};

/// The nodes that a method reads for a tool on a clay.
haptics::Lattice felt_lattice(const Clay& clay, const haptics::ForceTool& tool, FeltMethod method);

/// The window around the tool's place that a method reads, whose centre may then move by
/// `margin_mm`.
///
/// Errors   bad_input of lod for a tool so large that its window no longer pays, or so long or flat
///          that no lattice within the budget resolves it: it would be felt wrong. As read_window.
/// Threads  the clay's.
Result<FieldWindow> felt_window(const Clay& clay, const haptics::ForceTool& tool,
                                const haptics::ForceMaterial& material, FeltMethod method,
                                double margin_mm, const FeltWords& words);

}  // namespace argil::cli
