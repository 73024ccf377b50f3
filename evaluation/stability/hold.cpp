// SPDX-License-Identifier: GPL-3.0-or-later
// A hold at a wall or at clay: its plan, its device, and what linear theory says of it.
#include "stability/hold.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <thread>

#include <tbb/parallel_for.h>

#include "argil/haptics/servo/governor.h"
#include "argil/haptics/servo/position_filter.h"

#include "chart/chart.h"

namespace argil::evaluation {
namespace {

constexpr Vec3 kDown{0.0, -1.0, 0.0};

}  // namespace

haptics::FalconModel falcon(bool is_frictionless, int delay_ticks) {
  haptics::FalconModel device =
      is_frictionless ? haptics::frictionless_falcon() : haptics::FalconModel();
  // One step of position everywhere: what is found belongs to the law, not to where the handle is.
  device.encoder = haptics::Encoder::uniform;
  device.delay_ticks = delay_ticks;
  return device;
}

haptics::HoldTest hold_test(const HoldCase& held, double rest_mm) {
  assert(std::isfinite(rest_mm));
  haptics::HoldTest test;
  test.device = held.device;
  test.hand = haptics::hand_model(held.hand);
  test.servo = held.servo;
  test.plan = haptics::press_plan({0.0, rest_mm, 0.0}, kDown, kPressN);
  const double wait_s = held.servo.safety.ramp_in_s;
  for (haptics::HandKey& key : test.plan) key.time_s += wait_s;
  // Without friction quantisation leaves slow decays (docs/theory.md).
  test.settle_s = wait_s + (held.device.friction_n > 0.0 ? 3.0 : 5.0);
  return test;
}

haptics::HoldJudgement hold(haptics::ForceScene& scene, const HoldCase& held, double rest_mm,
                            haptics::ServoObserver* observer) {
  return haptics::run_hold_test(scene, hold_test(held, rest_mm), observer).judgement;
}

haptics::WallScene linear_wall(double stiffness_n_per_m, double damping_n_s_per_m) {
  assert(stiffness_n_per_m > 0.0 && damping_n_s_per_m >= 0.0);
  haptics::WallOptions options;
  options.offset_mm = 0.0;
  options.stiffness_n_per_m = stiffness_n_per_m;
  options.damping_n_s_per_m = damping_n_s_per_m;
  return haptics::WallScene(options);
}

double wall_rest_mm(const HoldCase& held, double stiffness_n_per_m) {
  return -1e3 * kPressN / stiffness_n_per_m - coupling_give_mm(held);
}

haptics::HoldJudgement hold_wall(const HoldCase& held, double stiffness_n_per_m,
                                 double damping_n_s_per_m) {
  haptics::WallScene wall = linear_wall(stiffness_n_per_m, damping_n_s_per_m);
  return hold(wall, held, wall_rest_mm(held, stiffness_n_per_m));
}

haptics::LinearLoop linear_loop(const HoldCase& held) {
  haptics::LinearLoop loop;
  loop.mass_kg = held.device.mass_kg;
  loop.damping_n_s_per_m = held.device.damping_n_s_per_m;
  loop.period_s = held.servo.period_s;
  loop.delay_ticks = held.device.delay_ticks;
  const haptics::HandModel hand = haptics::hand_model(held.hand);
  // Along its direction it adds a force alone: no mass, no spring, no damper.
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

double coupling_give_mm(const HoldCase& held) {
  const haptics::ServoOptions& servo = held.servo;
  if (servo.coupling.kind == haptics::CouplingKind::direct) return 0.0;
  double spring = servo.coupling.stiffness_n_per_m;
  if (servo.governor.is_on) {
    const double limit = haptics::stiffness_limit_n_per_m(
        held.device.damping_n_s_per_m + servo.coupling.damping_n_s_per_m, servo.period_s,
        held.device.delay_ticks * servo.period_s);
    spring = std::min(spring, servo.governor.share * limit);
  }
  assert(spring > 0.0);
  return 1e3 * kPressN / spring;
}

LateScene::LateScene(haptics::ForceScene& scene, double gain_per_ms, double period_s)
    : scene_(scene), gain_(haptics::PositionFilter({gain_per_ms, 1.0}).gain_over(period_s)) {}

void LateScene::begin_tick(const haptics::HandleState& handle) noexcept {
  scene_.begin_tick(handle);
  late_.force_n += gain_ * (scene_.force_at(handle).force_n - late_.force_n);
}

haptics::SceneForce LateScene::force_at(const haptics::HandleState& /*handle*/) const noexcept {
  return late_;
}

Result<void> run_all(const std::vector<std::function<void()>>& work, const Progress& progress,
                     const std::string& stage, double from, double to) {
  assert(0.0 <= from && from <= to && to <= 1.0);
  // The thread that began works like the others and asks before each piece of its own, so that an
  // interrupt waits for one piece and not for a row of them.
  const std::thread::id beginner = std::this_thread::get_id();
  std::atomic<std::size_t> begun = 0;
  std::atomic<bool> is_stopped = false;
  Result<void> go;
  tbb::parallel_for(std::size_t{0}, work.size(), [&](std::size_t n) {
    if (is_stopped) return;
    const double done = static_cast<double>(begun++) / static_cast<double>(work.size());
    if (std::this_thread::get_id() == beginner) {
      go = tell(progress, stage, from + (to - from) * done);
      if (!go) is_stopped = true;
    }
    if (!is_stopped) work[n]();
  });
  return go;
}

}  // namespace argil::evaluation
