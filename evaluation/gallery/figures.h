// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "argil/core/triangle_mesh.h"

#include "gallery/plate.h"

namespace argil::evaluation {

/// One figure under a picture.
struct Figure {
  std::string name;  ///< "serration rms"
  std::string unit;  ///< "h": kGalleryVoxel; mm, mm³, °, or "" for a ratio
  double value = 0.0;
};

/// How far the surface came to lie outside and inside of where it was, in mm, 0 or more: over the
/// vertices, the body's distance over its slope.
struct Reach {
  double out_mm = 0.0;
  double in_mm = 0.0;
  double farthest_mm() const noexcept { return out_mm > in_mm ? out_mm : in_mm; }
};
Reach reach_of(Body body, const TriangleMesh& mesh);

/// The figures of a plate on what somebody made of it: the same function for every mesh.
///
/// Shapes  start, mesh: closed, the body before and after.
std::vector<Figure> figures_of(const Plate& plate, const TriangleMesh& start,
                               const TriangleMesh& mesh);

/// "1.25 mm", "0.022 h".
std::string figure_text(const Figure& figure);

}  // namespace argil::evaluation
