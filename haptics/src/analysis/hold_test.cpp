// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/analysis/hold_test.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <span>

#include "argil/haptics/servo/servo_run.h"

#include "math/unit.h"

namespace argil::haptics {
namespace {

constexpr double kApproachMm = 5.0;
/// A firm tap: friction would hide a cycle just above the limit from a gentle one.
constexpr double kApproachS = 0.05;

/// Keeps what the simulated device alone knows.
class Watcher final : public ServoObserver {
 public:
  Watcher(const SimFalcon& device, HoldTestResult& result, ServoObserver* next)
      : device_(device), result_(result), next_(next) {}

  void after_tick(const ServoTick& tick) override {
    result_.ticks.push_back(tick);
    result_.true_position_mm.push_back(device_.true_position_mm());
    result_.held_force_n.push_back(device_.held_force_n());
    if (next_ != nullptr) next_->after_tick(tick);
  }

 private:
  const SimFalcon& device_;
  HoldTestResult& result_;
  ServoObserver* next_;
};

Vec3 mean(std::span<const Vec3> values) {
  Vec3 sum;
  for (const Vec3& value : values) sum += value;
  return values.empty() ? sum : sum / static_cast<double>(values.size());
}

}  // namespace

HoldTestResult run_hold_test(ForceScene& scene, const HoldTest& test, ServoObserver* observer,
                             const std::atomic<bool>* stop) {
  assert(!test.plan.empty() && test.watch_s > 0.0 && test.settle_s >= 0.0);
  HoldTestResult result;
  SimFalcon device(test.device, test.hand, HandPlan(test.plan));
  Servo servo(device, scene, test.servo);
  VirtualClock clock;
  Watcher watcher(device, result, observer);
  const std::atomic<bool> goes_on = false;
  result.faults = run_servo(servo, clock, test.settle_s + test.watch_s,
                            stop != nullptr ? *stop : goes_on, &watcher)
                      .faults;
  result.most_given_nmm = servo.passivity().most_given_nmm();

  const auto watched = std::min(
      result.ticks.size(),
      std::max<std::size_t>(3, static_cast<std::size_t>(test.watch_s / test.servo.period_s)));
  if (watched < 3 || result.ticks.size() < 3) return result;
  assert(result.true_position_mm.size() == result.ticks.size() &&
         result.held_force_n.size() == result.ticks.size());
  const auto positions = std::span<const Vec3>(result.true_position_mm).last(watched);
  const auto forces = std::span<const Vec3>(result.held_force_n).last(watched);
  result.judgement = judge_hold(positions, forces, test.servo.period_s);
  result.mean_position_mm = mean(positions);
  result.mean_force_n = mean(forces);
  return result;
}

std::vector<HandKey> press_plan(const Vec3& place_mm, const Vec3& direction, double press_n) {
  assert(is_unit(direction) && press_n >= 0.0);
  HandKey before;
  before.place_mm = place_mm - kApproachMm * direction;
  before.direction = direction;
  HandKey pressed = before;
  pressed.time_s = kApproachS;
  pressed.place_mm = place_mm;
  pressed.press_n = press_n;
  return {before, pressed};
}

ServoOptions bare_servo(double period_s) noexcept {
  assert(period_s > 0.0);
  ServoOptions options;
  options.period_s = period_s;
  options.coupling.kind = CouplingKind::direct;
  options.governor.is_on = false;
  options.velocity_lag_s = 0.0;
  options.safety.most_force_n = 9.0;
  options.safety.most_slew_n_per_s = std::numeric_limits<double>::infinity();
  options.safety.ramp_in_s = 0.0;
  return options;
}

}  // namespace argil::haptics
