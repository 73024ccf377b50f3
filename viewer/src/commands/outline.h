// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "document/request.h"
#include "picture/camera.h"
#include "picture/piece_frame.h"
#include "picture/stereo.h"

namespace argil::viewer {

/// How a drag is taken by a tool that also works by outlines: mask and trim.
enum class DragForm { brush, lasso, box, line, curve };

/// What is chosen for both.
struct OutlineChoice {
  DragForm mask = DragForm::brush;  ///< never line or curve
  DragForm trim = DragForm::brush;
  bool front_only = false;  ///< of masks
};

/// An outline that is being drawn over the picture.
struct OutlineDrag {
  DragForm form = DragForm::lasso;   ///< never brush
  bool is_trim = false;              ///< else it masks
  bool is_inverse = false;           ///< frees what is within; trims what is not
  WindowPart part;                   ///< the picture that it is drawn in
  std::optional<PieceKey> key = {};  ///< of the piece that it is drawn over
  Placement piece = {};              ///< where that is shown
  /// Of the window; of a box two corners, of a line its ends, of a curve those that were clicked.
  std::vector<Camera::Pixel> points;
};

/// The pointer has moved on.
void extend(OutlineDrag& drag, const Camera::Pixel& to);

/// The closed outline that is drawn; of a line its two ends. A curve goes straight on at its ends,
/// and round the window on the side that it takes away: to the right of whoever draws it.
std::vector<Camera::Pixel> outline_of(const OutlineDrag& drag);

/// A closed line of points as loops that do not cross themselves and together enclose what it
/// encloses: where it crosses itself, what it went around since is a loop of its own. Loops of less
/// than a square pixel are left out, and so are points that change nothing by half a pixel. Each is
/// counter-clockwise where y points up.
std::vector<std::vector<Camera::Pixel>> simple_loops(std::vector<Camera::Pixel> points);

/// What the drag does to the piece, in its frame; nothing for a click.
std::optional<Request> request_of(const OutlineDrag& drag, bool front_only);

}  // namespace argil::viewer
