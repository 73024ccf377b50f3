// SPDX-License-Identifier: GPL-3.0-or-later
// Guidance along a path: a pull, a push, or between the two, its energy watched.
#include "argil/haptics/servo/guidance.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <initializer_list>
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
/// From this part of most_given_mj on the force fades.
constexpr double kFadePart = 0.2;

Vec3 nearest_on_segment(const Vec3& a, const Vec3& b, const Vec3& position) noexcept {
  const Vec3 along = b - a;
  const double square = dot(along, along);
  if (!(square > 0.0)) return a;
  return a + std::clamp(dot(position - a, along) / square, 0.0, 1.0) * along;
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

Guidance::Guidance(GuidanceOptions options, int delay_ticks)
    : options_(std::move(options)), observer_({}, delay_ticks) {
  assert(check_guidance(options_).ok());
  state_.share = first_share(options_.kind);
  state_.left_mj = options_.most_given_mj;
}

void Guidance::forget_motion() noexcept {
  observer_.reset();
  has_handle_ = false;
  sign_ = 0.0;
  stored_mj_ = 0.0;
  owed_mj_ = 0.0;
}

double Guidance::potential_mj(double distance_mm) const noexcept {
  assert(distance_mm >= 0.0);
  const double spring_n_per_mm = options_.stiffness_n_per_m / kMmPerM;
  const double linear_mm = options_.most_force_n / spring_n_per_mm;
  if (distance_mm <= linear_mm) return 0.5 * spring_n_per_mm * distance_mm * distance_mm;
  return options_.most_force_n * (distance_mm - 0.5 * linear_mm);
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

/// What was given since the last tick, and what of it has flown in.
void Guidance::account(const Vec3& handle_mm, double elapsed_s, double given_part) noexcept {
  assert(given_part >= 0.0 && given_part <= 1.0);
  const Vec3 moved_mm = has_handle_ ? (handle_mm - handle_mm_) / options_.scale : Vec3{};
  handle_mm_ = handle_mm;
  has_handle_ = true;
  observer_.gave(given_part * state_.force_n);
  const double before_mj = observer_.given_nmm();
  observer_.tick({}, moved_mm, elapsed_s);
  state_.given_mj = observer_.given_nmm();
  const double stored_mj = std::max(0.0, sign_) * potential_mj(state_.distance_mm);
  const double speed_mm_per_s = length(moved_mm) / elapsed_s;
  const double income_mw = kIncomeMw + kIncomeNSPerMm * speed_mm_per_s * speed_mm_per_s;
  owed_mj_ = std::max(
      0.0, owed_mj_ + state_.given_mj - before_mj + stored_mj - stored_mj_ - income_mw * elapsed_s);
  stored_mj_ = stored_mj;
  state_.left_mj = std::max(0.0, options_.most_given_mj - owed_mj_);
}

/// The wanted one, weaker where little may still be given; and a pull only as strong as can be paid
/// for.
double Guidance::allowed_sign(double wanted) const noexcept {
  const double fade = std::min(1.0, state_.left_mj / (kFadePart * options_.most_given_mj));
  const double faded = fade * wanted;
  const double held = std::max(0.0, sign_);
  const double potential = potential_mj(state_.distance_mm);
  if (!(faded > held) || !(potential > 0.0)) return faded;
  return std::min(faded, held + state_.left_mj / potential);
}

Vec3 Guidance::tick(const Vec3& tool_mm, const Vec3& handle_mm, double elapsed_s,
                    double given_part) noexcept {
  assert(is_finite(tool_mm) && is_finite(handle_mm) && elapsed_s > 0.0);
  if (options_.kind == GuidanceKind::none) return {};
  const Vec3 back_mm = (nearest_on_path(options_.path_mm, tool_mm) - tool_mm) / options_.scale;
  const bool begins = !has_handle_;
  state_.distance_mm = length(back_mm);
  account(handle_mm, elapsed_s, given_part);
  judge(elapsed_s);
  const double wanted = sign_of(state_.share);
  sign_ = begins ? wanted : allowed_sign(wanted);
  // What a pull stores more it may give later; what it stored as it began costs nothing.
  const double stored_mj = std::max(0.0, sign_) * potential_mj(state_.distance_mm);
  if (!begins) owed_mj_ = std::max(0.0, owed_mj_ + stored_mj - stored_mj_);
  stored_mj_ = stored_mj;
  const double size_n =
      std::min(options_.stiffness_n_per_m / kMmPerM * state_.distance_mm, options_.most_force_n);
  state_.force_n = sign_ * size_n * normalized(back_mm);
  return state_.force_n;
}

}  // namespace argil::haptics
