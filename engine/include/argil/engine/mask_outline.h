// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/vec3.h"

namespace argil {

class Clay;

/// From where the clay was seen when something was drawn over its picture.
struct ViewFrame {
  /// The eye; of a parallel view any point, which is in the middle of the picture.
  Vec3 eye_mm;
  /// Any length but zero. It turns x to the picture's right, y to its up and z back to the viewer.
  Quat orientation;
  bool is_parallel = false;
};

/// A place in the picture, from its middle to the right and up: mm of a parallel view, else the
/// tangents of the angles.
using PicturePoint = std::array<double, 2>;

/// Masks, or frees, all that the picture shows within an outline, through the clay.
struct MaskOutline {
  static constexpr std::size_t kMostPoints = 100'000;  ///< of all loops

  ViewFrame view;
  /// Each closed by itself and not crossing itself; what is within any of them is meant.
  std::vector<std::vector<PicturePoint>> loops;
  bool frees = false;
  /// Only where the surface looks at the eye; what is too deep to have a side stays as it is.
  bool front_only = false;
};

/// Success, or bad_input naming what of it is out of its range.
Result<void> validate_outline(const MaskOutline& outline);

/// Does it. One undo step, also where nothing changes.
///
/// Errors   bad_input as validate_outline, or while a stroke is open; memory, interrupted: the mask
///          is as it was.
/// Accuracy on the surface the mask is a half, to 0.06, where the border was drawn, and 0 or 1 five
///          finest voxels beside it (MaskOutlines.*); more than ten from the surface a box of 16
///          may have one value, that of its middle. Of front_only it also fades over the last 6
///          degrees before the silhouette.
/// Cost     linear in the boxes of 16 voxels that the clay and its inside take, and in the points;
///          in boxes that the border passes, in their nodes times the points near them.
/// Determinism  same bits for any number of threads.
Result<void> mask_within(Clay& clay, const MaskOutline& outline, const Progress& progress = {});

}  // namespace argil
