// SPDX-License-Identifier: GPL-3.0-or-later
// Samples come in pieces of any length; a DabFeeder keeps what is left of the path to the next dab
// and of the time to the next one of a resting hand, so that pieces cannot be told from the whole.
#include "argil/engine/stroke.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <string>

#include "field/bad_input.h"

namespace argil {
namespace {

constexpr double kLeastSpacing = 0.05;
constexpr double kLargestSpacing = 2.0;
constexpr double kAnchoredSpacing = 0.25;
constexpr int kMostTurns = 64;
constexpr double kLongestString = 1000.0;
constexpr double kShortestHold = 0.005;
constexpr double kLongestHold = 3600.0;
/// Dabs of a resting hand between two samples: a longer gap is a pause of whoever recorded them.
constexpr int kMostHeld = 100;
/// Dabs that sweep are joined for so long, or so far in radii.
constexpr double kJoinS = 0.008;
constexpr double kMostJoined = 2.0;
constexpr std::size_t kMostJoinedDabs = 40;  ///< where they lie close or in one place
/// Beyond any clock; differences of such times are finite.
constexpr double kLatestS = 1e12;

Error bad_sample(std::size_t index, const std::string& what) {
  return {ErrorKind::bad_input, "poses[" + std::to_string(index) + "]: " + what};
}

/// Along the shorter arc: q and -q are one orientation.
Quat blend(const Quat& a, const Quat& b, double t) {
  const double d = a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z;
  const double s = d < 0.0 ? -t : t;
  return normalized(Quat{a.w * (1.0 - t) + b.w * s, a.x * (1.0 - t) + b.x * s,
                         a.y * (1.0 - t) + b.y * s, a.z * (1.0 - t) + b.z * s});
}

/// The rotation `b`, then `a`.
Quat product(const Quat& a, const Quat& b) {
  return {
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

/// A rotation seen in the mirror of `axis`: that about the other two axes runs the other way.
Quat mirrored(Quat q, std::size_t axis) {
  if (axis != 0) q.x = -q.x;
  if (axis != 1) q.y = -q.y;
  if (axis != 2) q.z = -q.z;
  return q;
}

DabPose mirrored(DabPose pose, std::size_t axis) {
  pose.position_mm[axis] = -pose.position_mm[axis];
  pose.orientation = mirrored(pose.orientation, axis);
  return pose;
}

/// Cosine and sine of `part` of `count` equal turns; quarter turns exactly, so that what they
/// repeat is repeated to the bit.
std::array<double, 2> turn_of(int part, int count) {
  constexpr std::array<std::array<double, 2>, 4> kQuarters{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  if (4 * part % count == 0) return kQuarters[static_cast<std::size_t>(4 * part / count % 4)];
  const double angle = 2.0 * std::numbers::pi * part / count;
  return {std::cos(angle), std::sin(angle)};
}

/// The half angle is a turn of twice as many parts, so that quarter turns stay exact.
Quat quaternion_of(int part, const Radial& radial) {
  const auto [half_c, half_s] = turn_of(part, 2 * radial.count);
  Vec3 axis;
  axis[radial.axis] = half_s;
  return {half_c, axis.x, axis.y, axis.z};
}

/// Position and orientation turn by the same angle.
DabPose turned(DabPose pose, int part, const Radial& radial) {
  const auto [c, s] = turn_of(part, radial.count);
  const std::size_t u = (radial.axis + 1) % 3;
  const std::size_t v = (radial.axis + 2) % 3;
  Vec3& p = pose.position_mm;
  const Vec3 before = p;
  p[u] = c * before[u] - s * before[v];
  p[v] = s * before[u] + c * before[v];
  pose.orientation = normalized(product(quaternion_of(part, radial), pose.orientation));
  return pose;
}

/// The reflection in another axis than x is that in x and a half turn about the third.
Dab mirrored(Dab dab, std::size_t axis) {
  dab.from = mirrored(dab.from, axis);
  dab.at = mirrored(dab.at, axis);
  dab.is_mirrored = !dab.is_mirrored;
  dab.turn = mirrored(dab.turn, axis);
  if (axis == 1) dab.turn = product(dab.turn, {0.0, 0.0, 0.0, 1.0});
  if (axis == 2) dab.turn = product(dab.turn, {0.0, 0.0, 1.0, 0.0});
  return dab;
}

Dab turned(Dab dab, int part, const Radial& radial) {
  dab.from = turned(dab.from, part, radial);
  dab.at = turned(dab.at, part, radial);
  dab.turn = product(quaternion_of(part, radial), dab.turn);
  return dab;
}

/// The planes that add images to the turns: two planes through the axis are the first of them and a
/// half turn.
std::array<bool, 3> planes_of(const StrokeStyle& style) {
  std::array<bool, 3> planes{style.mirror.x, style.mirror.y, style.mirror.z};
  const std::size_t u = (style.radial.axis + 1) % 3;
  const std::size_t v = (style.radial.axis + 2) % 3;
  if (planes[u] && planes[v] && style.radial.count % 2 == 0) planes[v] = false;
  return planes;
}

/// The dab and all its images, the dab first.
void append_images(std::vector<Dab>& dabs, const Dab& dab, const StrokeStyle& style) {
  assert(style.radial.axis < 3 && style.radial.count >= 1);
  const std::size_t first = dabs.size();
  dabs.push_back(dab);
  const std::array<bool, 3> planes = planes_of(style);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!planes[axis]) continue;
    const std::size_t count = dabs.size();
    for (std::size_t i = first; i < count; ++i) dabs.push_back(mirrored(dabs[i], axis));
  }
  const std::size_t count = dabs.size();
  for (int part = 1; part < style.radial.count; ++part) {
    for (std::size_t i = first; i < count; ++i) {
      dabs.push_back(turned(dabs[i], part, style.radial));
    }
  }
}

}  // namespace

DabPose between(const DabPose& a, const DabPose& b, double fraction) noexcept {
  assert(fraction > -1e-9 && fraction <= 1.0);
  return {a.position_mm * (1.0 - fraction) + b.position_mm * fraction,
          blend(a.orientation, b.orientation, fraction),
          a.pressure * (1.0 - fraction) + b.pressure * fraction};
}

Result<void> validate_brush(const Tool& tool, const StrokeStyle& style) {
  if (auto ok = validate_tool(tool); !ok) return ok;
  if (!(style.spacing >= kLeastSpacing && style.spacing <= kLargestSpacing)) {
    return bad_input("spacing is " + number_text(style.spacing) +
                     "; must be from 0.05 to 2 smallest radii");
  }
  if (style.radial.count < 1 || style.radial.count > kMostTurns || style.radial.axis > 2) {
    return bad_input("radial repeats " + std::to_string(style.radial.count) + " times about axis " +
                     std::to_string(style.radial.axis) + "; must be 1 to 64 about axis 0, 1 or 2");
  }
  if (!(style.steady_mm >= 0.0 && style.steady_mm <= kLongestString)) {
    return bad_input("steady_mm is " + number_text(style.steady_mm) + "; must be from 0 to 1000");
  }
  if (style.hold_s != 0.0 && !(style.hold_s >= kShortestHold && style.hold_s <= kLongestHold)) {
    return bad_input("hold_s is " + number_text(style.hold_s) +
                     "; must be 0, or from 0.005 to 3600");
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
    if (!is_in_reach(s.position_mm))
      return bad_sample(i, "the position is out of reach, more than 1 km from the origin");
    if (std::abs(s.time_s) > kLatestS) {
      return bad_sample(
          i, "the time is " + number_text(s.time_s) + " s; must be from -1e12 to 1e12 s");
    }
    if (norm <= 0.0) return bad_sample(i, "the quaternion is zero; use 1,0,0,0 for no rotation");
    if (s.pressure < 0.0 || s.pressure > 1.0) return bad_sample(i, "pressure must be from 0 to 1");
    if (i > 0 && s.time_s < samples[i - 1].time_s) return bad_sample(i, "time runs backwards");
  }
  return {};
}

Result<void> validate_stroke(const Stroke& stroke) {
  if (auto ok = validate_brush(stroke.tool, stroke); !ok) return ok;
  if (stroke.samples.empty()) {
    return Error{ErrorKind::bad_input, "poses is empty; give at least one"};
  }
  return validate_samples(stroke.samples);
}

DabFeeder::DabFeeder(const Tool& tool, const StrokeStyle& style) noexcept
    : style_(style),
      is_anchored_(is_anchored(tool.action)),
      is_swept_(is_stamped(tool.action) || is_profiled(tool.action)),
      is_dotted_(style.has_dots && (!is_anchored_ || tool.action == Action::emboss)),
      is_placed_(tool.action == Action::emboss && tool.alpha_mode == AlphaMode::space),
      radius_mm_(smallest_radius(tool)) {
  // Steps this short keep what a dab pushes from folding the matter over.
  assert(smallest_radius(tool) > 0.0 && style.spacing > 0.0);
  const double spacing =
      is_anchored_ && !is_placed_ ? std::min(style.spacing, kAnchoredSpacing) : style.spacing;
  quarters_ = spacing / 0.25;
  step_mm_ = spacing * radius_mm_;
  until_next_mm_ = step_mm_;
}

std::size_t DabFeeder::images() const noexcept {
  const std::array<bool, 3> planes = planes_of(style_);
  const auto count = std::count(planes.begin(), planes.end(), true);
  return static_cast<std::size_t>(style_.radial.count) << count;
}

/// An upper bound without making them: the path as the hand gave it, which a string only shortens.
double DabFeeder::most_dabs(std::span<const StrokeSample> samples) const noexcept {
  if (samples.empty()) return 0.0;
  if (is_dotted_) {
    return static_cast<double>(samples.size() * images()) + static_cast<double>(joined_.size());
  }
  double path_mm = 0.0;
  Vec3 at = last_ ? hand_.position_mm : samples.front().position_mm;
  for (const StrokeSample& sample : samples) {
    path_mm += length(sample.position_mm - at);
    at = sample.position_mm;
  }
  double held = 0.0;
  if (style_.hold_s > 0.0 && !is_anchored_) {
    const double rested_s = samples.back().time_s - (last_ ? dropped_s_ : samples.front().time_s);
    held =
        std::min(rested_s / style_.hold_s, 1.0 * kMostHeld * static_cast<double>(samples.size()));
  }
  // The first dab, and one that was due when these samples began.
  return (path_mm / step_mm_ + held + 2.0) * static_cast<double>(images()) +
         static_cast<double>(joined_.size());
}

DabPose DabFeeder::steadied(const StrokeSample& sample) const {
  DabPose pose{sample.position_mm, normalized(sample.orientation), sample.pressure};
  if (style_.steady_mm == 0.0 || !last_) return pose;
  const Vec3 to = sample.position_mm - hand_.position_mm;
  const double far = length(to);
  const double path_mm = std::max(0.0, far - style_.steady_mm);
  pose.position_mm = hand_.position_mm;
  if (path_mm > 0.0) pose.position_mm += to * (path_mm / far);
  return pose;
}

void DabFeeder::drop(const DabPose& at, double time_s, double quarters, std::vector<Dab>& dabs) {
  // A dot stands alone: nothing sweeps to it from the one before.
  const Dab dab{last_ && !is_dotted_ ? dropped_ : at, at, false, quarters};
  joined_mm_ += length(dab.at.position_mm - dab.from.position_mm);
  append_images(joined_, dab, style_);
  dropped_ = at;
  dropped_s_ = time_s;
  until_next_mm_ = step_mm_;
  if (is_due(time_s)) release(time_s, dabs);
}

/// Whether what is joined is to be done. The first dab always is.
bool DabFeeder::is_due(double time_s) const noexcept {
  return !is_swept_ || is_dotted_ || !last_ || time_s >= released_s_ + kJoinS ||
         joined_mm_ >= kMostJoined * radius_mm_ || joined_.size() >= kMostJoinedDabs * images();
}

void DabFeeder::release(double time_s, std::vector<Dab>& dabs) {
  const std::size_t last = joined_.size() - std::min(joined_.size(), images());
  for (std::size_t n = 0; n < last; ++n) joined_[n].is_joined = true;
  dabs.insert(dabs.end(), joined_.begin(), joined_.end());
  joined_.clear();
  joined_mm_ = 0.0;
  released_s_ = time_s;
}

void DabFeeder::feed(const StrokeSample& sample, std::vector<Dab>& dabs) {
  assert(is_in_reach(sample.position_mm));
  assert(!last_ || sample.time_s >= last_->time_s);
  const DabPose pose = steadied(sample);
  if (!last_ || is_dotted_) {
    drop(pose, sample.time_s, 1.0, dabs);
  } else {
    move(pose, sample.time_s, dabs);
    // Who gives samples more seldom than that would not see the last of them while the hand rests.
    const bool is_seldom = sample.time_s - last_->time_s >= kJoinS;
    if (!joined_.empty() && (is_seldom || is_due(sample.time_s))) release(sample.time_s, dabs);
  }
  last_ = sample;
  hand_ = pose;
}

/// Dabs by path and dabs by time (a resting hand) are drawn from the same piece of path, whichever
/// is due first.
void DabFeeder::move(const DabPose& to, double time_s, std::vector<Dab>& dabs) {
  const double path_mm = length(to.position_mm - hand_.position_mm);
  const double start_s = last_->time_s;
  const double span_s = time_s - start_s;
  const bool holds = style_.hold_s > 0.0 && !is_anchored_;
  int held = 0;
  double fraction = 0.0;  // of the path and of the time that is gone
  while (true) {
    const double by_path = path_mm > 0.0 ? fraction + until_next_mm_ / path_mm : 2.0;
    const bool can_hold = holds && held < kMostHeld && span_s > 0.0;
    const double by_time =
        can_hold ? std::max(fraction, (dropped_s_ + style_.hold_s - start_s) / span_s) : 2.0;
    const double next = std::min(by_path, by_time);
    if (!(next <= 1.0)) break;
    const bool is_held = by_time < by_path;
    if (is_held) ++held;
    fraction = next;
    drop(between(hand_, to, fraction), start_s + fraction * span_s, is_held ? 1.0 : quarters_,
         dabs);
  }
  until_next_mm_ -= (1.0 - fraction) * path_mm;
}

void DabFeeder::finish(std::vector<Dab>& dabs) {
  if (!last_) return;
  if (!is_placed_ && !is_dotted_ && !(hand_.position_mm == dropped_.position_mm)) {
    const double rest = 1.0 - until_next_mm_ / step_mm_;
    drop(hand_, last_->time_s, rest * quarters_, dabs);
  }
  if (!joined_.empty()) release(last_->time_s, dabs);
}

std::vector<Dab> dabs_of(const Stroke& stroke) {
  std::vector<Dab> dabs;
  DabFeeder feeder(stroke.tool, stroke);
  for (const StrokeSample& sample : stroke.samples) feeder.feed(sample, dabs);
  feeder.finish(dabs);
  return dabs;
}

}  // namespace argil
