// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "argil/engine/clay.h"

#include "brush.h"
#include "workshop.h"

namespace argil::viewer {

/// The brush's tool as it is felt: no smaller and no larger than a device may feel, a mesh as the
/// ball around it. Its place is left out.
haptics::ForceTool felt_tool(const Brush& brush, double radius_mm);

/// Where the centre of a tool lies that is pressed so deep into the surface; below 0 it is held
/// above.
Vec3 pressed_place(const haptics::ForceTool& tool, const SurfaceHit& hit, double press_mm);

/// What a tool feels that is held still there, by the energy law, as the servo works it out: on a
/// window of its own, with the same lattice.
/// Returns  nothing for a tool that the clay has no window for: far larger than the clay, or too
///          long or flat.
/// Threads  the clay's. Cost  reading the window, about a millisecond.
std::optional<Workshop::Felt> feel(const Clay& clay, const SurfaceHit& hit,
                                   const Workshop::Touch& touch);

}  // namespace argil::viewer
