// SPDX-License-Identifier: GPL-3.0-or-later
#include "chart/stability_hold.h"

#include <algorithm>

#include <tbb/parallel_for.h>

#include "argil/haptics/governor.h"
#include "argil/haptics/position_filter.h"

namespace argil::cli::chart {
namespace {

constexpr Vec3 kDown{0.0, -1.0, 0.0};

}  // namespace

haptics::FalconModel falcon(bool is_frictionless, int delay_ticks) {
  haptics::FalconModel device =
      is_frictionless ? haptics::frictionless_falcon() : haptics::FalconModel();
  device.encoder = haptics::Encoder::uniform;
  device.delay_ticks = delay_ticks;
  return device;
}

haptics::HoldJudgement hold(haptics::ForceScene& scene, const HoldCase& held, double rest_mm,
                            haptics::ServoObserver* observer) {
  haptics::HoldTest test;
  test.device = held.device;
  test.hand = haptics::hand_model(held.hand);
  test.servo = held.servo;
  test.plan = haptics::press_plan({0.0, rest_mm, 0.0}, kDown, kPressN);
  const double wait_s = held.servo.safety.ramp_in_s;
  for (haptics::HandKey& key : test.plan) key.time_s += wait_s;
  test.settle_s = wait_s + (held.device.friction_n > 0.0 ? 3.0 : 5.0);
  return haptics::run_hold_test(scene, test, observer).judgement;
}

haptics::LinearLoop linear_loop(const HoldCase& held) {
  haptics::LinearLoop loop;
  loop.mass_kg = held.device.mass_kg;
  loop.damping_n_s_per_m = held.device.damping_n_s_per_m;
  loop.period_s = held.servo.period_s;
  loop.delay_ticks = held.device.delay_ticks;
  const haptics::HandModel hand = haptics::hand_model(held.hand);
  if (hand.is_push) return loop;
  loop.mass_kg += hand.mass_kg;
  loop.damping_n_s_per_m += hand.damping_n_s_per_m;
  loop.hand_stiffness_n_per_m = hand.stiffness_n_per_m;
  return loop;
}

double formula_n_per_m(const HoldCase& held, double added_damping_n_s_per_m) {
  const haptics::LinearLoop loop = linear_loop(held);
  return haptics::stiffness_limit_n_per_m(loop.damping_n_s_per_m + added_damping_n_s_per_m,
                                          loop.period_s, loop.delay_ticks * loop.period_s);
}

double coupling_way_mm(const HoldCase& held) {
  const haptics::ServoOptions& servo = held.servo;
  if (servo.coupling.kind == haptics::CouplingKind::direct) return 0.0;
  double spring = servo.coupling.stiffness_n_per_m;
  if (servo.governor.is_on) {
    const double limit = haptics::stiffness_limit_n_per_m(
        held.device.damping_n_s_per_m + servo.coupling.damping_n_s_per_m, servo.period_s,
        held.device.delay_ticks * servo.period_s);
    spring = std::min(spring, servo.governor.share * limit);
  }
  return 1e3 * kPressN / spring;
}

LateScene::LateScene(haptics::ForceScene& scene, double gain_per_ms, double period_s)
    : scene_(scene), gain_(haptics::PositionFilter({gain_per_ms, 1.0}).gain_over(period_s)) {}

void LateScene::begin_tick(const haptics::HandleState& handle) noexcept {
  scene_.begin_tick(handle);
  late_.force_n += gain_ * (scene_.force_at(handle).force_n - late_.force_n);
}

haptics::SceneForce LateScene::force_at(const haptics::HandleState& /*place*/) const noexcept {
  return late_;
}

Result<void> run_all(const std::vector<std::function<void()>>& work, const Progress& progress,
                     const std::string& stage, double from, double to) {
  constexpr std::size_t kBetweenReports = 16;
  for (std::size_t begin = 0; begin < work.size(); begin += kBetweenReports) {
    const double done = static_cast<double>(begin) / static_cast<double>(work.size());
    if (progress && !progress(stage, from + (to - from) * done)) {
      return Error{ErrorKind::interrupted, "interrupted; nothing was written"};
    }
    tbb::parallel_for(begin, std::min(begin + kBetweenReports, work.size()),
                      [&](std::size_t n) { work[n](); });
  }
  return {};
}

}  // namespace argil::cli::chart
