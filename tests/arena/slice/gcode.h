// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "argil/core/vec3.h"

namespace argil::arena {

/// A line of plastic: from one point to another, in mm.
struct Bead {
  Vec3 from;
  Vec3 to;
  double width_mm = 0.0;
};

/// All that is laid down at one height of the nozzle.
struct PrintedLayer {
  double z_mm = 0.0;  ///< its upper side
  std::vector<Bead> beads;
};

/// The layers in PrusaSlicer's G-code, with absolute extrusion and its comments (;LAYER_CHANGE,
/// ;Z:, ;WIDTH:); layers in which nothing is laid down are not among them.
std::vector<PrintedLayer> printed_layers(const std::string& gcode);

}  // namespace argil::arena
