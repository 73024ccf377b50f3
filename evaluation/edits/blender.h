// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"

#include "edits/row.h"
#include "edits/shape.h"

namespace argil::evaluation {

/// One stroke of one of Blender's brushes.
struct BlenderCase {
  Editor editor = Editor::plain;  ///< not argil
  StrokePlan plan;
  int repeats = 0;         ///< 0: not timed
  double detail_mm = 0.0;  ///< longest edge of dynamic topology, voxel of the remesher
};

struct BlenderAnswer {
  std::string complaint;  ///< why there is nothing else; "" when all went well
  StrokeTimes times;
  /// After the long stroke: the mesh within kBlenderReach radii of it, or all of a mesh whose faces
  /// are new.
  TriangleMesh result;
  std::int64_t covered = 0;  ///< vertices within the radius of the first dab, before the stroke
  std::int64_t moved = 0;    ///< vertices that the stroke moved; plain only
};
inline constexpr double kBlenderReach = 2.0;

/// Blender's name of the brush.
const char* blender_brush_name(Brush brush);

/// Runs Blender once, in a window on a screen of its own (Xvfb), and has it do all cases in turn,
/// on the ball in so many squares as quad_ball has it. Blender and screen end with this call,
/// however that ends, and leave nothing behind.
///
/// Returns  an answer for each case.
/// Errors   interrupted; disk; internal with what Blender said last, where it did nothing. Where it
///          crashes, that case says so, and it begins again with the next.
Result<std::vector<BlenderAnswer>> run_blender(const BumpyBall& ball, int squares,
                                               const std::vector<BlenderCase>& cases,
                                               const Progress& progress);

}  // namespace argil::evaluation
