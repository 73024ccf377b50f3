// SPDX-License-Identifier: GPL-3.0-or-later
// What filters do in the closed loop: the claim of section 4 of the sculpting report, refuted as a
// statement on stability and confirmed as one on noise; and the ripple of a slide over eq. 3.9.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include <gtest/gtest.h>

#include "argil/haptics/scene/scene_round.h"

#include "haptics/servo/loop_scenes.h"
#include "haptics/servo/tick.h"

namespace argil::haptics {
namespace {

/// Contact law (2) of Blanch et al. 2004 at a point, e = 4, on the plane y = 0: slope K at the
/// surface.
class FieldWall final : public ForceScene {
 public:
  explicit FieldWall(double stiffness_n_per_m)
      : skin_mm_(1e3 * kExponent * kSurfaceN / stiffness_n_per_m) {}
  SceneForce force_at(const HandleState& place) const noexcept override {
    const double density = std::max(0.0, 1.0 - place.position_mm.y / skin_mm_);
    SceneForce felt;
    felt.force_n.y = std::min(kSurfaceN * std::pow(density, kExponent), kMostN);
    return felt;
  }

 private:
  static constexpr double kExponent = 4.0;
  static constexpr double kSurfaceN = 3.0;
  static constexpr double kMostN = 8.0;
  double skin_mm_;
};

/// The force low-passed by a gain a tick, which Blanch et al. 2004 warn of.
class LateForce final : public ForceScene {
 public:
  LateForce(const ForceScene& scene, double gain) : scene_(scene), gain_(gain) {}
  void begin_tick(const HandleState& handle) noexcept override {
    late_n_ += gain_ * (scene_.force_at(handle).force_n - late_n_);
  }
  SceneForce force_at(const HandleState& /*place*/) const noexcept override {
    SceneForce felt;
    felt.force_n = late_n_;
    return felt;
  }

 private:
  const ForceScene& scene_;
  double gain_;
  Vec3 late_n_;
};

HoldTest press_surface(Hand hand) {
  HoldTest test;
  test.device.encoder = Encoder::uniform;
  test.hand = hand_model(hand);
  test.servo = bare_servo(kTickS);
  test.plan = press_plan({}, scenes::kDown, 3.0);
  return test;
}

/// Root mean square of the force's change from tick to tick, over a part of a run.
double step_rms_n(const HoldTestResult& result, double from_s, double to_s) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t n = 1; n < result.ticks.size(); ++n) {
    if (result.ticks[n].time_s < from_s || result.ticks[n].time_s > to_s) continue;
    const Vec3 step = result.ticks[n].force_n - result.ticks[n - 1].force_n;
    sum += dot(step, step);
    ++count;
  }
  return std::sqrt(sum / count);
}

TEST(Equation2With6to8, QuietensAWaveringSensor) {
  FieldWall wall(1000.0);
  HoldTest test = press_surface(Hand::arm);
  test.device.jitter_counts = 1.0;
  const double direct = step_rms_n(run_hold_test(wall, test), 3.0, 4.0);
  test.servo.position_filter = PositionFilterOptions{0.2, 1.0};
  const double filtered = step_rms_n(run_hold_test(wall, test), 3.0, 4.0);
  RecordProperty("ratio", std::to_string(direct / filtered));
  EXPECT_GE(direct / filtered, 4.0);
}

TEST(Equation2With6to8, TurnsAQuietContactIntoASlowHeave) {
  FieldWall wall(3000.0);
  const HoldTest direct = press_surface(Hand::light);
  EXPECT_EQ(run_hold_test(wall, direct).judgement.verdict, Verdict::quiet);

  LateForce late(wall, 0.1);
  const HoldJudgement by_force = run_hold_test(late, direct).judgement;
  EXPECT_EQ(by_force.verdict, Verdict::limit_cycle);
  EXPECT_NEAR(by_force.position_pp_mm, 14.8, 0.25 * 14.8);

  HoldTest filtered = direct;
  filtered.servo.position_filter = PositionFilterOptions{0.1, 1.0};
  const HoldJudgement by_position = run_hold_test(wall, filtered).judgement;
  EXPECT_EQ(by_position.verdict, Verdict::limit_cycle);
  EXPECT_NEAR(by_position.position_pp_mm, 6.8, 0.25 * 6.8);
  EXPECT_LT(by_position.position_pp_mm, by_force.position_pp_mm);
}

/// The governor takes the filter's lag for delay: with it every hand holds a hard wall quietly, and
/// without it not.
TEST(Equation2With6to8, IsQuietBehindAGovernorThatCountsItsLag) {
  constexpr double kHardNPerM = 20'000.0;
  for (const PositionFilterOptions& filter :
       {PositionFilterOptions{0.2, 0.3}, {0.1, 1.0}, {0.03, 3.0}, {0.01, 10.0}}) {
    for (const Hand hand : {Hand::push, Hand::light, Hand::arm, Hand::firm}) {
      HoldTest test = press_surface(hand);
      test.servo = ServoOptions();
      for (HandKey& key : test.plan) key.time_s += test.servo.safety.ramp_in_s;
      test.plan.insert(test.plan.begin(), test.plan.front());
      test.plan.front().time_s = 0.0;
      test.servo.position_filter = filter;
      scenes::PlainWall wall(kHardNPerM);
      const HoldTestResult result = run_hold_test(wall, test);
      EXPECT_EQ(result.judgement.verdict, Verdict::quiet)
          << filter.gain << " " << static_cast<int>(hand) << " " << result.judgement.position_pp_mm;
      const double delay_s = 1.5e-3 + filter_lag_s(filter, kTickS);
      EXPECT_NEAR(result.ticks.back().most_stiffness_n_per_m, 0.5 * 3.0 / delay_s, 1e-6);
    }
  }
  HoldTest without = press_surface(Hand::light);
  without.servo = ServoOptions();
  without.servo.governor.is_on = false;
  without.servo.coupling.stiffness_n_per_m = 1000.0;  // what it gives without a filter
  without.servo.position_filter = PositionFilterOptions{0.03, 3.0};
  scenes::PlainWall wall(kHardNPerM);
  EXPECT_NE(run_hold_test(wall, without).judgement.verdict, Verdict::quiet);
}

/// Slides 30 mm in 0.6 s over the ball of eq. 3.9, 3000 N/m and 50 N s/m, coupled directly.
double slide_ripple_n(double lag_s) {
  SphereScene ball;
  HoldTest test;
  test.device.encoder = Encoder::uniform;
  test.hand = hand_model(Hand::arm);
  test.servo = bare_servo(kTickS);
  test.servo.velocity_lag_s = lag_s;
  for (int n = 0; n <= 20; ++n) {
    const double angle = -0.3 + 0.03 * n;
    HandKey key;
    key.time_s = 2.0 + 0.03 * n;
    key.direction = {-std::sin(angle), -std::cos(angle), 0.0};
    key.place_mm = -49.0 * key.direction;
    key.press_n = 3.0;
    if (n == 0) {
      test.plan = press_plan(key.place_mm, key.direction, 3.0);
      key.time_s = 2.0;
    }
    test.plan.push_back(key);
  }
  return step_rms_n(run_hold_test(ball, test), 2.0, 2.6);
}

TEST(Equation3_9, RipplesInASlideByTheEncodersCounts) {
  const double raw = slide_ripple_n(0.0);
  const double filtered = slide_ripple_n(-kTickS / std::log(0.7));  // a mean of alpha = 0.3
  RecordProperty("raw_n", std::to_string(raw));
  RecordProperty("filtered_n", std::to_string(filtered));
  std::printf("slide over the ball: force steps %.2f N rms raw, %.2f filtered\n", raw, filtered);
  EXPECT_LE(filtered, 0.5);
  EXPECT_GT(raw, 3.0 * filtered);
}

}  // namespace
}  // namespace argil::haptics
