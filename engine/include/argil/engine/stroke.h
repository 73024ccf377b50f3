// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
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

/// The two halves of validate_stroke, for a stroke that comes in pieces. `samples` of any length;
/// the message counts them within the piece.
Result<void> validate_brush(const Tool& tool, double spacing);
Result<void> validate_samples(std::span<const StrokeSample> samples);

/// Turns samples into evenly spaced dabs as they come: the first sample, then one dab per `spacing`
/// along the polyline of the samples (orientation and pressure interpolated), each followed by its
/// mirror images. What is left of the way to the next dab carries over from sample to sample, so
/// that the dabs do not depend on the pieces in which a stroke is given
/// (LiveStrokeDabs.DoNotDependOnThePieces).
class DabFeeder {
 public:
  /// `tool` and `spacing` as validate_brush wants them.
  DabFeeder(const Tool& tool, double spacing, const Mirror& mirror) noexcept;

  /// Appends the dabs on the way from the last sample to this one, which validate_samples accepts.
  void feed(const StrokeSample& sample, std::vector<DabPose>& dabs);

  /// The sample fed last; none before the first.
  const std::optional<StrokeSample>& last() const noexcept { return last_; }

 private:
  double step_mm_;
  double until_next_mm_;  ///< way left to the next dab
  Mirror mirror_;
  std::optional<StrokeSample> last_;
};

/// The dabs of a stroke in the order they are applied: all that DabFeeder makes of its samples. The
/// last sample is not repeated when it is nearer than one spacing.
std::vector<DabPose> dabs_of(const Stroke& stroke);

}  // namespace argil
