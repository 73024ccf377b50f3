// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "argil/core/result.h"
#include "argil/core/vec3.h"
#include "argil/engine/tool.h"

namespace argil {

/// One sample of the hand.
struct StrokeSample {
  double time_s = 0.0;  ///< not decreasing within a stroke
  Vec3 position_mm;
  Quat orientation;       ///< any length but zero; normalised before use
  double pressure = 1.0;  ///< 0 to 1
};

/// Planes through the origin in which every dab is repeated.
struct Mirror {
  bool x = false;
  bool y = false;
  bool z = false;
};

/// The timed series of poses between press and release.
struct Stroke {
  Tool tool;
  /// Distance between dabs as a fraction of the tool's smallest radius, 0.05 to 2; usual 0.25.
  double spacing = 0.25;
  Mirror mirror;
  std::vector<StrokeSample> samples;  ///< at least one
};

/// Success, or bad_input naming the field that is out of its range, its value and the range.
Result<void> validate_stroke(const Stroke& stroke);

/// The dabs of a stroke in the order they are applied: the first sample, then one per `spacing`
/// along the polyline of the samples (orientation and pressure interpolated), each followed by its
/// mirror images. The last sample is not repeated when it is nearer than one spacing.
std::vector<DabPose> dabs_of(const Stroke& stroke);

}  // namespace argil
