// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "argil/core/result.h"
#include "argil/core/vec3.h"
#include "argil/engine/tool.h"

namespace argil {

/// One sample of the hand.
struct StrokeSample {
  /// Seconds of any clock, -1e12 to 1e12, not decreasing within a stroke. It matters for `hold_s`
  /// alone.
  double time_s = 0.0;
  /// Of the tool's centre; no coordinate beyond kMaxReachMm, nor kMaxNode voxels.
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

/// Turns about an axis through the origin in which every dab is repeated, mirror images included.
struct Radial {
  int count = 1;         ///< 1 (none) to 64, evenly around
  std::size_t axis = 2;  ///< 0, 1 or 2 for x, y or z
};

/// How samples become dabs.
struct StrokeStyle {
  /// Distance between dabs as a fraction of the tool's smallest radius, 0.05 to 2; usual 0.25.
  /// Strength is given per quarter radius and made up for it, and add and carve sweep from dab to
  /// dab, so that the result hardly depends on it (StrokeSpacing.*). Anchored actions take at most
  /// 0.25, or what they push would fold over; but the images of emboss lie just so far apart.
  double spacing = 0.25;
  Mirror mirror = {};
  Radial radial = {};

  /// A steady hand: the tool is drawn behind the samples on a string of this length; 0 to 1000. The
  /// stroke ends where the tool is, short of the last sample by the string.
  double steady_mm = 0.0;

  /// While the hand rests another dab falls every so many seconds of the samples' time, 0.005 to
  /// 3600, and at most 100 from one sample to the next; 0: never. For anchored actions never.
  double hold_s = 0.0;

  /// Each sample is one dab of a quarter radius' weight, wherever it lies, and nothing is between
  /// two: `spacing` and `hold_s` are not read. Actions that take their whole path at once have none
  /// of it, but emboss lays an image with each.
  bool has_dots = false;
};

/// The timed series of poses between press and release: what scripts and journals hold a line of.
/// With the clay before it, it decides all bits of the clay after it.
struct Stroke : StrokeStyle {
  Tool tool;
  std::vector<StrokeSample> samples;  ///< at least one
};

/// Success, or bad_input naming the field that is out of its range, its value and the range.
/// Whether tool and poses fit a given clay is asked when they are applied.
Result<void> validate_stroke(const Stroke& stroke);

/// The two halves of validate_stroke, for a stroke that comes in pieces. `samples` of any length;
/// the message counts them within the piece.
Result<void> validate_brush(const Tool& tool, const StrokeStyle& style);
Result<void> validate_samples(std::span<const StrokeSample> samples);

/// Turns samples into evenly spaced dabs as they come: the first sample, then one dab per `spacing`
/// along the polyline of the samples (orientation and pressure interpolated), each followed by its
/// images. What is left of the path to the next dab carries over from sample to sample, so that the
/// dabs do not depend on the pieces in which a stroke is given
/// (LiveStrokeDabs.DoNotDependOnThePieces).
///
/// A hand may be faster than an edit for every dab. So those of stamped and profiled actions, which
/// sweep from dab to dab and whose union does not depend on their order, are joined to one edit
/// until 8 ms of the samples' time have gone since the last one, their path is 2 smallest radii
/// long or they are 40; and with each sample where these come more seldom than every 8 ms
/// (JoinedDabs.*).
class DabFeeder {
 public:
  /// `tool` and `style` as validate_brush wants them.
  DabFeeder(const Tool& tool, const StrokeStyle& style) noexcept;

  /// Appends the dabs on the path from the last sample to this one, which validate_samples accepts:
  /// groups of images(), each a dab and its images. The first sample makes a dab at once; later
  /// ones may make none. Samples in one place make none but by `hold_s`. Dabs that are to be joined
  /// are held back, and appended with the last of them.
  void feed(const StrokeSample& sample, std::vector<Dab>& dabs);

  /// Appends what is left of the path to the last sample, as a dab that stands for less path (but
  /// no image of emboss closer than others), and what was held back. At the end of the stroke.
  void finish(std::vector<Dab>& dabs);

  /// How many dabs each is repeated as, itself included: 1 to 504. Two mirror planes through the
  /// axis of an even number of turns count as one, since the turns make the other.
  std::size_t images() const noexcept;

  /// No more dabs, images included, than feeding these would make now.
  double most_dabs(std::span<const StrokeSample> samples) const noexcept;

  const StrokeStyle& style() const noexcept { return style_; }

  /// The sample fed last; none before the first.
  const std::optional<StrokeSample>& last() const noexcept { return last_; }

 private:
  DabPose steadied(const StrokeSample& sample) const;
  void move(const DabPose& to, double time_s, std::vector<Dab>& dabs);
  void drop(const DabPose& at, double time_s, double quarters, std::vector<Dab>& dabs);
  bool is_due(double time_s) const noexcept;
  void release(double time_s, std::vector<Dab>& dabs);

  StrokeStyle style_;
  bool is_anchored_;
  bool is_swept_;
  bool is_dotted_;  ///< each sample is a dab
  bool is_placed_;  ///< each dab stands for itself and not for a piece of path
  double radius_mm_;
  double quarters_ = 1.0;  ///< of the radius, that a step is long
  double step_mm_ = 0.0;
  double until_next_mm_ = 0.0;  ///< path left to the next dab
  std::optional<StrokeSample> last_;
  DabPose hand_;             ///< where the tool was with the last sample, drawn on its string
  DabPose dropped_;          ///< the last dab
  double dropped_s_ = 0.0;   ///< and when
  std::vector<Dab> joined_;  ///< dabs whose edit is not due yet,
  double joined_mm_ = 0.0;   ///< and their path
  double released_s_ = 0.0;  ///< when the last edit was due
};

/// The pose between two, `fraction` 0 (a) to 1 (b): orientations by normalised linear interpolation
/// along the shorter arc, enough between samples of one hand.
DabPose between(const DabPose& a, const DabPose& b, double fraction) noexcept;

/// The dabs of a stroke in the order they are applied: all that DabFeeder makes of its samples.
std::vector<Dab> dabs_of(const Stroke& stroke);

}  // namespace argil
