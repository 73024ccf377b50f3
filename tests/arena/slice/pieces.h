// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "argil/core/triangle_mesh.h"

namespace argil::arena {

/// Something to print, in mm.
struct PrintPiece {
  std::string name;  ///< what it is, and the size that matters
  TriangleMesh mesh;
};

/// Sixty: walls, tapers, pins, gaps, floors and tubes from too thin to thick enough for a nozzle of
/// 0.4 mm, and sound ones.
std::vector<PrintPiece> print_pieces();

}  // namespace argil::arena
