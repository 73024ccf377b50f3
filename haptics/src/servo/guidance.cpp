// SPDX-License-Identifier: GPL-3.0-or-later
// Guidance along a path: a pull, a push, or between the two, its energy watched.
//
// A push is directed by an average over the path. Seen from the tool a part of the path subtends an
// angle; on a straight piece at the distance p a point in the direction b off the perpendicular
// lies p / cos b away. With the weight w = 2 - distance / nearest, 0 from twice the nearest
// distance on, the integrals over b of w, w cos b and w sin b are closed forms, so that it does not
// matter how finely a path is divided.
#include "argil/haptics/servo/guidance.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>

#include "math/units.h"

namespace argil::haptics {
namespace {

/// What flows into the account whatever the hand does, and by its motion: less than the device's
/// own damping takes from it.
constexpr double kIncomeMw = 1.0;
constexpr double kIncomeNSPerMm = 1.0 / kMmPerM;
/// What the end of a path counts, which subtends no angle: as a radian.
constexpr double kEndWeight = 1.0;
/// Length of the average over a straight path, by which the average is divided: the integral of
/// w cos b over that of w, both from -60 to 60 degrees.
const double kStraightMean = (std::sqrt(3.0) - std::numbers::pi / 3.0) /
                             (2.0 * std::numbers::pi / 3.0 - std::log(2.0 + std::sqrt(3.0)));

Vec3 nearest_on_segment(const Vec3& a, const Vec3& b, const Vec3& position) noexcept {
  const Vec3 along = b - a;
  const double square = dot(along, along);
  if (!(square > 0.0)) return a;
  return a + std::clamp(dot(position - a, along) / square, 0.0, 1.0) * along;
}

/// A sum of directions, and of their weights.
struct Directions {
  Vec3 sum;
  double weight = 0.0;
};

void add_point(const Vec3& to_mm, double nearest_mm, Directions& all) noexcept {
  const double weight = kEndWeight * std::max(0.0, 2.0 - length(to_mm) / nearest_mm);
  all.sum += weight * normalized(to_mm);
  all.weight += weight;
}

/// A piece so short that its middle stands for it, to a thousandth.
void add_short_piece(const Vec3& a, const Vec3& b, double nearest_mm, Directions& all) noexcept {
  const Vec3 middle = 0.5 * (a + b);
  const double square = dot(middle, middle);
  const double angle = length(cross(middle, b - a)) / square;
  const double weight = angle * std::max(0.0, 2.0 - std::sqrt(square) / nearest_mm);
  all.sum += weight / std::sqrt(square) * middle;
  all.weight += weight;
}

/// A straight piece from a to b, both seen from the tool.
void add_piece(const Vec3& a, const Vec3& b, double nearest_mm, Directions& all) noexcept {
  constexpr double kShort = 0.1;
  const double size_mm = length(b - a);
  if (length(a) > 2.0 * nearest_mm + size_mm) return;
  if (size_mm < kShort * nearest_mm) return add_short_piece(a, b, nearest_mm, all);
  const Vec3 along = (b - a) / size_mm;
  const Vec3 foot = a - dot(a, along) * along;
  const double off_mm = length(foot);
  // On its own line it subtends no angle; far off it does not count.
  if (!(off_mm > 1e-9 * nearest_mm) || off_mm >= 2.0 * nearest_mm) return;
  const double ratio = off_mm / nearest_mm;
  const double most = std::acos(0.5 * ratio);
  const double from = std::clamp(std::atan2(dot(a, along), off_mm), -most, most);
  const double to = std::clamp(std::atan2(dot(b, along), off_mm), -most, most);
  if (!(to > from)) return;
  const double angle = to - from;
  const double across = 2.0 * (std::sin(to) - std::sin(from)) - ratio * angle;
  const double aside =
      2.0 * (std::cos(from) - std::cos(to)) + ratio * std::log(std::cos(to) / std::cos(from));
  all.sum += across / off_mm * foot + aside * along;
  all.weight += 2.0 * angle - ratio * (std::asinh(std::tan(to)) - std::asinh(std::tan(from)));
}

/// Where a push goes at a place that is `nearest_mm` (> 0) off the path: unit length away from it,
/// shorter between parts of it.
Vec3 away_from(const std::vector<Vec3>& path_mm, const Vec3& place_mm, double nearest_mm) noexcept {
  assert(!path_mm.empty() && nearest_mm > 0.0);
  Directions all;
  for (std::size_t n = 1; n < path_mm.size(); ++n) {
    add_piece(path_mm[n - 1] - place_mm, path_mm[n] - place_mm, nearest_mm, all);
  }
  const bool is_loop = path_mm.size() > 1 && path_mm.front() == path_mm.back();
  if (!is_loop) add_point(path_mm.front() - place_mm, nearest_mm, all);
  if (!is_loop && path_mm.size() > 1) add_point(path_mm.back() - place_mm, nearest_mm, all);
  if (!(all.weight > 0.0)) return {};
  const Vec3 mean = all.sum / (-kStraightMean * all.weight);
  return length(mean) > 1.0 ? normalized(mean) : mean;
}

/// As the options of hybrid are written: share 1 is s = 1, share 0 is s = -1.
constexpr double sign_of(double share) noexcept { return 2.0 * share - 1.0; }

double first_share(GuidanceKind kind) noexcept {
  switch (kind) {
    case GuidanceKind::direct:
      return 1.0;
    case GuidanceKind::indirect:
      return 0.0;
    case GuidanceKind::none:
    case GuidanceKind::hybrid:  // from no force on
      break;
  }
  return 0.5;
}

struct GuidanceRange {
  const char* name;
  double value;
  double most;
  const char* unit;
};

Result<void> check_ranges(std::initializer_list<GuidanceRange> all) {
  for (const GuidanceRange& one : all) {
    if (one.value > 0.0 && one.value <= one.most) continue;  // a NaN is outside
    std::ostringstream text;
    text << "the guidance's " << one.name << " is " << one.value << one.unit
         << "; must be greater than 0, at most " << one.most << one.unit;
    return Error{ErrorKind::bad_input, text.str()};
  }
  return {};
}

}  // namespace

const char* guidance_name(GuidanceKind kind) noexcept {
  switch (kind) {
    case GuidanceKind::direct:
      return "direct";
    case GuidanceKind::indirect:
      return "indirect";
    case GuidanceKind::hybrid:
      return "hybrid";
    case GuidanceKind::none:
      break;
  }
  return "none";
}

Result<void> check_guidance(const GuidanceOptions& options) {
  if (options.kind == GuidanceKind::none) return {};
  const auto bad = [](const std::string& message) { return Error{ErrorKind::bad_input, message}; };
  if (options.path_mm.empty()) return bad("guidance needs a path of at least one point");
  if (options.path_mm.size() > GuidanceOptions::kMostPoints) {
    return bad("the guidance's path has " + std::to_string(options.path_mm.size()) +
               " points; must be at most " + std::to_string(GuidanceOptions::kMostPoints) +
               ": leave some out");
  }
  for (const Vec3& point : options.path_mm) {
    if (!is_in_reach(point)) return bad("a point of the guidance's path is no place in reach");
  }
  return check_ranges({{"scale", options.scale, 1000.0, " mm for each mm"},
                       {"stiffness", options.stiffness_n_per_m, 500.0, " N/m"},
                       {"most force", options.most_force_n, 8.0, " N"},
                       {"tolerance", options.tolerance_mm, 1000.0, " mm"},
                       {"effort", options.effort_n, 8.0, " N"},
                       {"settling time", options.settle_s, 60.0, " s"},
                       {"change of share", options.most_change_per_s, 1000.0, " 1/s"},
                       {"energy", options.most_given_mj, 1000.0, " mJ"}});
}

Vec3 nearest_on_path(const std::vector<Vec3>& path_mm, const Vec3& place_mm) noexcept {
  if (path_mm.empty()) return place_mm;
  Vec3 best = path_mm.front();
  double best_square = dot(best - place_mm, best - place_mm);
  for (std::size_t n = 1; n < path_mm.size(); ++n) {
    const Vec3 near = nearest_on_segment(path_mm[n - 1], path_mm[n], place_mm);
    const double square = dot(near - place_mm, near - place_mm);
    if (square >= best_square) continue;
    best = near;
    best_square = square;
  }
  return best;
}

Guidance::Guidance(GuidanceOptions options) : options_(std::move(options)) {
  assert(check_guidance(options_).ok());
  state_.share = first_share(options_.kind);
  state_.stiffness_n_per_m = options_.stiffness_n_per_m;
  state_.left_mj = options_.most_given_mj;
}

void Guidance::forget_motion() noexcept {
  written_n_ = {};
  has_handle_ = false;
  owed_mj_ = std::max(0.0, owed_mj_ + stored_mj_);
  stored_mj_ = 0.0;
}

double Guidance::potential_mj(double distance_mm) const noexcept {
  assert(distance_mm >= 0.0);
  const double spring_n_per_mm = state_.stiffness_n_per_m / kMmPerM;
  if (spring_n_per_mm * distance_mm <= options_.most_force_n) {
    return 0.5 * spring_n_per_mm * distance_mm * distance_mm;
  }
  return options_.most_force_n * (distance_mm - 0.5 * options_.most_force_n / spring_n_per_mm);
}

double Guidance::sought_share() const noexcept {
  if (options_.kind != GuidanceKind::hybrid) return first_share(options_.kind);
  return std::min(1.0,
                  state_.error_mm / options_.tolerance_mm + state_.effort_n / options_.effort_n);
}

/// How the hand has done lately, and the share that follows from it.
void Guidance::judge(double elapsed_s) noexcept {
  assert(elapsed_s > 0.0);
  const double part = elapsed_s / (options_.settle_s + elapsed_s);
  error_squared_mm2_ += part * (state_.distance_mm * state_.distance_mm - error_squared_mm2_);
  state_.error_mm = std::sqrt(error_squared_mm2_);
  const double held_n = sign_ < 0.0 ? length(state_.force_n) : 0.0;
  state_.effort_n += part * (held_n - state_.effort_n);
  const double most = options_.most_change_per_s * elapsed_s;
  state_.share += std::clamp(sought_share() - state_.share, -most, most);
}

/// What was given since the last tick, and what of that has flown in.
void Guidance::account(const AidTick& tick) noexcept {
  assert(tick.given_part >= 0.0 && tick.given_part <= 1.0 && tick.delay_ticks >= 0);
  const Vec3 moved_mm = has_handle_ ? (tick.handle_mm - handle_mm_) / options_.scale : Vec3{};
  handle_mm_ = tick.handle_mm;
  written_n_[0] = has_handle_ ? tick.given_part * state_.force_n : Vec3{};
  has_handle_ = true;
  const auto late = static_cast<std::size_t>(std::clamp(tick.delay_ticks, 0, kMostDelayTicks));
  const double given_mj = dot(written_n_[late], moved_mm);
  std::copy_backward(written_n_.begin(), written_n_.end() - 1, written_n_.end());
  state_.given_mj += given_mj;
  state_.worked_mj += std::max(0.0, -given_mj);
  owed_mj_ += given_mj;
  const double speed_mm_per_s = length(moved_mm) / tick.elapsed_s;
  const double income_mw = kIncomeMw + kIncomeNSPerMm * speed_mm_per_s * speed_mm_per_s;
  if (owed_mj_ > 0.0) owed_mj_ = std::max(0.0, owed_mj_ - income_mw * tick.elapsed_s);
}

/// What the pull has stored now. As it begins that is the hand's; later only what it puts in is.
void Guidance::store(double stored_mj, bool begins) noexcept {
  assert(stored_mj >= 0.0);
  if (begins) owed_mj_ -= stored_mj;
  stored_mj_ = stored_mj;
  owed_mj_ = std::max(owed_mj_, -stored_mj_ - options_.most_given_mj);
  state_.left_mj = std::max(0.0, options_.most_given_mj - owed_mj_);
}

Vec3 Guidance::tick(const Vec3& tool_mm, const AidTick& tick, const SurfaceTouch& touch) noexcept {
  assert(is_finite(tool_mm) && is_finite(tick.handle_mm) && tick.elapsed_s > 0.0);
  if (options_.kind == GuidanceKind::none) return {};
  const Vec3 back_mm = (nearest_on_path(options_.path_mm, tool_mm) - tool_mm) / options_.scale;
  const double off_mm = length(back_mm);
  const bool begins = !has_handle_;
  state_.distance_mm = length(touch.along(back_mm));
  state_.stiffness_n_per_m = std::min(options_.stiffness_n_per_m, tick.most_stiffness_n_per_m);
  account(tick);
  judge(tick.elapsed_s);
  sign_ = sign_of(state_.share);
  store(std::max(0.0, sign_) * potential_mj(off_mm), begins);
  state_.force_n = {};
  if (!(off_mm > 0.0)) return {};
  // A spring that has stored what is left pulls by so much.
  const double left_n = std::sqrt(2.0 * tick.most_stiffness_n_per_m / kMmPerM * state_.left_mj);
  const double size_n =
      std::min(state_.stiffness_n_per_m / kMmPerM * off_mm, options_.most_force_n);
  const Vec3 direction = sign_ >= 0.0
                             ? back_mm / off_mm
                             : away_from(options_.path_mm, tool_mm, off_mm * options_.scale);
  state_.force_n = std::min(std::abs(sign_) * size_n, left_n) * touch.along(direction);
  return state_.force_n;
}

}  // namespace argil::haptics
