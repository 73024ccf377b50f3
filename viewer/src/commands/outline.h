// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "argil/core/triangle_mesh.h"
#include "argil/engine/mask_outline.h"
#include "argil/io/stroke_script.h"

#include "picture/camera.h"
#include "picture/piece_frame.h"
#include "picture/stereo.h"

namespace argil::viewer {

/// How a drag is taken by a tool that also works by outlines: mask and trim.
enum class DragForm { brush, lasso, box, line };

/// What is chosen for both.
struct OutlineChoice {
  DragForm mask = DragForm::brush;  ///< never line
  DragForm trim = DragForm::brush;
  bool front_only = false;  ///< of masks
};

/// An outline that is being drawn over the picture.
struct OutlineDrag {
  DragForm form = DragForm::lasso;    ///< never brush
  bool is_trim = false;               ///< else it masks
  bool is_inverse = false;            ///< frees what is within; trims what is not
  WindowPart part;                    ///< the picture that it is drawn in
  Placement piece = {};               ///< of the piece that it is drawn over
  std::vector<Camera::Pixel> points;  ///< of the window; of a box two corners, of a line its ends
};

/// The pointer has moved on.
void extend(OutlineDrag& drag, const Camera::Pixel& to);

/// The closed outline that is drawn; of a line its two ends.
std::vector<Camera::Pixel> outline_of(const OutlineDrag& drag);

/// A closed line of points as loops that do not cross themselves and together enclose what it
/// encloses: where it crosses itself, what it went around since is a loop of its own. Loops of less
/// than a square pixel are left out, and so are points that change nothing by half a pixel. Each is
/// counter-clockwise where y points up.
std::vector<std::vector<Camera::Pixel>> simple_loops(std::vector<Camera::Pixel> points);

/// What the drag does to the piece, all in its own frame, whose clay is within these bounds;
/// nothing for a click, or an outline beside it.
std::optional<io::ScriptStep> step_of(const OutlineDrag& drag, const Box3& bounds_mm,
                                      bool front_only);

/// What a view shows within a loop, as a closed mesh from before the box until behind it; empty
/// where it shows nothing of the box there.
TriangleMesh solid_behind(const ViewFrame& view, const std::vector<PicturePoint>& loop,
                          const Box3& bounds_mm);

}  // namespace argil::viewer
