// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/engine/stroke.h"

#include <array>
#include <cmath>
#include <sstream>
#include <string>

namespace argil {
namespace {

constexpr double kLeastSpacing = 0.05;
constexpr double kLargestSpacing = 2.0;

Error bad_sample(std::size_t index, const std::string& what) {
  return {ErrorKind::bad_input, "poses[" + std::to_string(index) + "]: " + what};
}

/// Normalised linear interpolation along the shorter way: enough between samples of one hand.
Quat blend(const Quat& a, const Quat& b, double t) {
  const double d = a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z;
  const double s = d < 0.0 ? -t : t;
  return normalized(Quat{a.w * (1.0 - t) + b.w * s, a.x * (1.0 - t) + b.x * s,
                         a.y * (1.0 - t) + b.y * s, a.z * (1.0 - t) + b.z * s});
}

DabPose between(const StrokeSample& a, const StrokeSample& b, double t) {
  return {a.position_mm * (1.0 - t) + b.position_mm * t,
          blend(normalized(a.orientation), normalized(b.orientation), t),
          a.pressure * (1.0 - t) + b.pressure * t};
}

/// Mirroring in the plane of `axis` negates that coordinate and the rotation about the other two.
DabPose mirrored(DabPose pose, std::size_t axis) {
  pose.position_mm[axis] = -pose.position_mm[axis];
  Quat& q = pose.orientation;
  if (axis != 0) q.x = -q.x;
  if (axis != 1) q.y = -q.y;
  if (axis != 2) q.z = -q.z;
  return pose;
}

/// The pose and all its images, the pose first.
void append_images(std::vector<DabPose>& dabs, const DabPose& pose, const Mirror& mirror) {
  const std::size_t first = dabs.size();
  dabs.push_back(pose);
  const std::array<bool, 3> planes{mirror.x, mirror.y, mirror.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!planes[axis]) continue;
    const std::size_t count = dabs.size();
    for (std::size_t i = first; i < count; ++i) dabs.push_back(mirrored(dabs[i], axis));
  }
}

}  // namespace

Result<void> validate_brush(const Tool& tool, double spacing) {
  if (auto ok = validate_tool(tool); !ok) return ok;
  if (!std::isfinite(spacing) || spacing < kLeastSpacing || spacing > kLargestSpacing) {
    std::ostringstream message;
    message << "spacing is " << spacing << "; must be from 0.05 to 2 smallest radii";
    return Error{ErrorKind::bad_input, message.str()};
  }
  return {};
}

Result<void> validate_samples(std::span<const StrokeSample> samples) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const StrokeSample& s = samples[i];
    const Quat& q = s.orientation;
    const double norm = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
    if (!is_finite(s.position_mm) || !std::isfinite(s.time_s) || !std::isfinite(norm) ||
        !std::isfinite(s.pressure)) {
      return bad_sample(i, "a number is not finite");
    }
    if (norm <= 0.0) return bad_sample(i, "the quaternion is zero; use 1,0,0,0 for no rotation");
    if (s.pressure < 0.0 || s.pressure > 1.0) return bad_sample(i, "pressure must be from 0 to 1");
    if (i > 0 && s.time_s < samples[i - 1].time_s) return bad_sample(i, "time runs backwards");
  }
  return {};
}

Result<void> validate_stroke(const Stroke& stroke) {
  if (auto ok = validate_brush(stroke.tool, stroke.spacing); !ok) return ok;
  if (stroke.samples.empty()) {
    return Error{ErrorKind::bad_input, "poses is empty; give at least one"};
  }
  return validate_samples(stroke.samples);
}

DabFeeder::DabFeeder(const Tool& tool, double spacing, const Mirror& mirror) noexcept
    : step_mm_(spacing * smallest_radius(tool)), until_next_mm_(step_mm_), mirror_(mirror) {}

void DabFeeder::feed(const StrokeSample& sample, std::vector<DabPose>& dabs) {
  if (!last_) {
    append_images(dabs, between(sample, sample, 0.0), mirror_);
    last_ = sample;
    return;
  }
  const double way = length(sample.position_mm - last_->position_mm);
  double gone = 0.0;
  while (way - gone >= until_next_mm_) {
    gone += until_next_mm_;
    append_images(dabs, between(*last_, sample, gone / way), mirror_);
    until_next_mm_ = step_mm_;
  }
  until_next_mm_ -= way - gone;
  last_ = sample;
}

std::vector<DabPose> dabs_of(const Stroke& stroke) {
  std::vector<DabPose> dabs;
  DabFeeder feeder(stroke.tool, stroke.spacing, stroke.mirror);
  for (const StrokeSample& sample : stroke.samples) feeder.feed(sample, dabs);
  return dabs;
}

}  // namespace argil
