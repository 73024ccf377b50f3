// SPDX-License-Identifier: GPL-3.0-or-later
#include "stability/late/late_run.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <span>
#include <vector>

#include "argil/haptics/analysis/slide_judgement.h"
#include "argil/haptics/force/energy_account.h"
#include "argil/haptics/force/force_mix.h"
#include "argil/haptics/force/servo_force.h"

#include "stability/late/late_block.h"
#include "stability/late/late_plane.h"

namespace argil::evaluation {
namespace {

// The hand comes to rest, with 3 N, at 15 mm, so that it can sink in; works from 1.2 s on and is
// watched in the last second.
constexpr double kRestMm = 15.0;
constexpr double kWaitS = 0.6;
constexpr double kWorkS = 1.2;
constexpr double kWatchedS = 1.0;
constexpr double kMixS = haptics::ModeBlend::kUsualRampS;
constexpr double kWorkPressN = 1.0;
constexpr double kCarveMmPerS = 20.0;
constexpr double kSlideMmPerS = 50.0;
constexpr double kSlideHalfMm = 20.0;

bool works(LateAction action) { return action != LateAction::touch && action != LateAction::slide; }

HoldCase held_of(const LateCase& what) {
  HoldCase held;
  held.hand = what.hand;
  held.device = falcon(what.tool.is_spring(), 1);
  if (what.is_direct) {
    held.servo = haptics::bare_servo(kPeriodS);
    held.servo.velocity_lag_s = haptics::VelocityFilter::kUsualLagS;
  }
  return held;
}

/// The hand's way from when it presses with 3 N. The push hand, which nothing would stop, is led to
/// a place while it works, like the light one; and all are at a spring, where nothing would damp
/// what a press leaves of a swing.
std::vector<haptics::HandKey> late_plan(const LateCase& what, const HoldCase& held) {
  const Vec3 rest{0.0, kRestMm - coupling_give_mm(held), 0.0};
  const double press_n = what.tool.is_spring() ? 0.0 : kPressN;
  std::vector<haptics::HandKey> plan = haptics::press_plan(rest, {0.0, -1.0, 0.0}, press_n);
  for (haptics::HandKey& key : plan) key.time_s += kWaitS;
  haptics::HandKey key = plan.back();
  key.time_s = kWorkS;
  key.is_active = works(what.action);
  const bool is_led = what.tool.is_spring() || what.hand == haptics::Hand::push;
  if (key.is_active) key.press_n = is_led ? 0.0 : kWorkPressN;
  plan.push_back(key);
  if (what.action == LateAction::slide) {
    const double way_s = 2.0 * kSlideHalfMm / kSlideMmPerS;
    key.time_s += 0.5 * way_s;
    for (int way = 0; key.time_s <= kWorkS + stroke_s(what.tool); ++way) {
      key.place_mm.x = way % 2 == 0 ? kSlideHalfMm : -kSlideHalfMm;
      plan.push_back(key);
      key.time_s += way_s;
    }
    return plan;
  }
  key.time_s += stroke_s(what.tool);
  if (what.action == LateAction::carve) key.place_mm.y -= kCarveMmPerS * stroke_s(what.tool);
  plan.push_back(key);
  return plan;
}

/// What is left of the coordinate across the surface after the parabola that fits best.
std::vector<double> without_parabola(std::span<const Vec3> series) {
  const std::size_t count = series.size();
  assert(count > 3);
  const auto at = [&](std::size_t n) {
    return 2.0 * static_cast<double>(n) / static_cast<double>(count - 1) - 1.0;
  };
  std::array<double, 3> right{};  // sums of y t^k; of the even powers of t: one, square, fourth
  double one = 0.0;
  double square = 0.0;
  double fourth = 0.0;
  for (std::size_t n = 0; n < count; ++n) {
    const double t = at(n);
    one += 1.0;
    square += t * t;
    fourth += t * t * t * t;
    for (std::size_t k = 0; k < 3; ++k) right[k] += series[n].y * std::pow(t, k);
  }
  const double det = one * fourth - square * square;
  const double level = (right[0] * fourth - square * right[2]) / det;
  const double slope = right[1] / square;
  const double bend = (one * right[2] - right[0] * square) / det;
  std::vector<double> rest(count);
  for (std::size_t n = 0; n < count; ++n) {
    rest[n] = series[n].y - level - at(n) * (slope + at(n) * bend);
  }
  return rest;
}

/// Peak to peak, in the calmer half: a hand that settles is no cycle.
double lasting_swing(const std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  const auto swing = [](auto from, auto to) {
    const auto [least, most] = std::minmax_element(from, to);
    return *most - *least;
  };
  return std::min(swing(values.begin(), middle), swing(middle, values.end()));
}

int rises(const std::vector<double>& values) {
  int count = 0;
  for (std::size_t n = 1; n < values.size(); ++n) {
    count += values[n - 1] <= 0.0 && values[n] > 0.0 ? 1 : 0;
  }
  return count;
}

/// The last second: whether the handle swings, or the force chatters, and how hard is pressed.
void judge_swing(const haptics::HoldTestResult& run, LateFound& found) {
  const auto watched = static_cast<std::size_t>(std::lround(kWatchedS / kPeriodS));
  const auto forces = std::span<const Vec3>(run.held_force_n).last(watched);
  const std::vector<double> place =
      without_parabola(std::span<const Vec3>(run.true_position_mm).last(watched));
  found.swing_mm = lasting_swing(place);
  found.force_pp_n = lasting_swing(without_parabola(forces));
  found.frequency_hz = rises(place) / kWatchedS;
  for (const Vec3& force : forces) found.mean_n += force.y / static_cast<double>(watched);
  constexpr int kLeastRises = 3;
  if (rises(place) < kLeastRises) return;
  if (found.swing_mm > haptics::kLimitCycleMm) {
    found.verdict = haptics::Verdict::limit_cycle;
  } else if (found.force_pp_n > haptics::kBuzzN) {
    found.verdict = haptics::Verdict::buzz;
  }
}

/// What the servo gave from when the hand began to work, and what the lab allows of it.
void judge_energy(const haptics::HoldTestResult& run, LateFound& found) {
  const auto from = static_cast<std::size_t>(std::lround(kWorkS / kPeriodS));
  assert(run.ticks.size() > from + 3);
  const auto places = std::span<const Vec3>(run.true_position_mm).subspan(from);
  const auto forces = std::span<const Vec3>(run.held_force_n).subspan(from);
  found.given_mj = haptics::judge_slide(places, forces, {1.0, 0.0, 0.0}, kPeriodS).most_given_mj;
  const haptics::EnergyAccountOptions account;
  found.allowed_mj = account.most_nmm;
  for (std::size_t n = from; n < run.ticks.size(); ++n) {
    const Vec3& v = run.ticks[n].velocity_mm_per_s;
    found.allowed_mj +=
        kPeriodS * (account.power_mw + 1e-3 * account.device_damping_n_s_per_m * dot(v, v));
    found.faults |= run.ticks[n].faults;
  }
}

void judge_exchanges(const ExchangeMeter& meter, double lasted_s, LateFound& found) {
  found.exchange_mw = meter.put_in_mj() / lasted_s;
  found.outside_ms = 1e3 * kPeriodS * meter.outside();
  std::vector<double> steps = meter.steps_since(kWorkS + kMixS);
  if (steps.empty()) return;
  std::sort(steps.begin(), steps.end());
  found.step_p99_n = steps[(steps.size() - 1) * 99 / 100];
  found.step_most_n = steps.back();
}

LateFound run_late(const LateCase& what, EnergyScene& scene, haptics::ServoObserver* observer) {
  const HoldCase held = held_of(what);
  haptics::HoldTest test;
  test.device = held.device;
  test.hand = haptics::hand_model(held.hand);
  test.servo = held.servo;
  test.plan = late_plan(what, held);
  test.settle_s = kWorkS + stroke_s(what.tool) - kWatchedS;
  test.watch_s = kWatchedS;
  ExchangeMeter meter(scene, kWorkS, what.remedy == LateRemedy::governed);
  const haptics::HoldTestResult run = haptics::run_hold_test(meter, test, observer);
  LateFound found;
  judge_swing(run, found);
  judge_energy(run, found);
  judge_exchanges(meter, stroke_s(what.tool), found);
  const bool gives = works(what.action) && found.given_mj > found.allowed_mj;
  if (gives && found.verdict != haptics::Verdict::limit_cycle) {
    found.verdict = haptics::Verdict::gives;
  }
  return found;
}

/// Where the surface is when the tool rests at kRestMm with 3 N.
double surface_mm(const HeightLaw& law) { return kRestMm - law.height_mm(kPressN); }

}  // namespace

double stroke_s(const LateTool& tool) { return tool.is_spring() ? 3.0 : 2.0; }

LateFound run_on_plane(const LateCase& what, const HeightLaw& law) {
  LatePlane plane(law, what, surface_mm(law));
  return run_late(what, plane, nullptr);
}

LateFound run_on_clay(const LateCase& what, const HeightLaw& law) {
  auto made = LateBlock::make(what, surface_mm(law));
  LateFound found;
  if (!made) {
    found.worked = made.error();
    return found;
  }
  LateBlock& block = *made.value();
  found = run_late(what, block, &block);
  found.worked = block.worked();
  return found;
}

haptics::CarvingLoop carving_loop(const LateCase& what, const HeightLaw& law) {
  const HoldCase held = held_of(what);
  const haptics::HandModel hand = haptics::hand_model(what.hand);
  haptics::CarvingLoop loop;
  loop.mass_kg = held.device.mass_kg + hand.mass_kg;
  loop.damping_n_s_per_m = held.device.damping_n_s_per_m + hand.damping_n_s_per_m;
  loop.hand_stiffness_n_per_m = hand.stiffness_n_per_m;
  const double slope_n_per_mm = law.at(law.height_mm(kPressN)).slope_n_per_mm;
  loop.stiffness_n_per_m = what.tool.is_spring()
                               ? what.tool.spring_n_per_m
                               : 1e3 * haptics::ForceMix{}.contact_active * slope_n_per_mm;
  if (!what.is_direct) loop.coupling_n_per_m = 1e3 * kPressN / coupling_give_mm(held);
  loop.delay_s = (0.5 + held.device.delay_ticks) * kPeriodS;
  return loop;
}

double lateness_s(const LateCase& what, double dab_s) {
  haptics::CarvingLateness late;
  late.age_s = what.late.age_s;
  late.period_s = what.late.period_s;
  late.dab_s = dab_s;
  if (what.remedy != LateRemedy::at_once) {
    late.exchange_s = 0.5e-3 * haptics::ServoForce::kBlendMs;
  }
  late.delay_s = (0.5 + held_of(what).device.delay_ticks) * kPeriodS;
  return late.total_s();
}

}  // namespace argil::evaluation
