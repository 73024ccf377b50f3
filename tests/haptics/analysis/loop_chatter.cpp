// SPDX-License-Identifier: GPL-3.0-or-later
// The equation of a tool that carves clay it feels late, against its own bounds and a simulation.
#include "argil/haptics/analysis/loop_chatter.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <limits>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "argil/haptics/analysis/hold_test.h"
#include "argil/haptics/servo/governor.h"
#include "argil/haptics/simulation/hand_model.h"

namespace argil::haptics {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// Hand and device as one; the push hand is led while it works, so that it has its spring.
CarvingLoop carved_by(Hand hand, double n_per_m, const FalconModel& device) {
  const HandModel model = hand_model(hand);
  CarvingLoop loop;
  loop.mass_kg = device.mass_kg + model.mass_kg;
  loop.damping_n_s_per_m = device.damping_n_s_per_m + model.damping_n_s_per_m;
  loop.hand_stiffness_n_per_m = model.stiffness_n_per_m;
  loop.stiffness_n_per_m = n_per_m;
  return loop;
}

/// The left side of the equation at s = i omega.
std::complex<double> residue(const CarvingLoop& loop, const Chatter& at) {
  const std::complex<double> s{0.0, 2.0 * kPi * at.frequency_hz};
  const std::complex<double> rest =
      loop.mass_kg * s * s + loop.damping_n_s_per_m * s + loop.hand_stiffness_n_per_m;
  const std::complex<double> spring =
      loop.stiffness_n_per_m * (1.0 - std::exp(-(at.lateness_s - loop.delay_s) * s));
  const std::complex<double> coupled =
      std::isinf(loop.coupling_n_per_m) ? spring : spring / (1.0 + spring / loop.coupling_n_per_m);
  return rest + coupled * std::exp(-loop.delay_s * s);
}

TEST(LoopChatter, IsARootOfTheEquation) {
  int compared = 0;
  for (const Hand hand : {Hand::push, Hand::light, Hand::arm, Hand::firm}) {
    for (const double n_per_m : {150.0, 600.0, 2400.0}) {
      for (const double coupling : {std::numeric_limits<double>::infinity(), 1000.0}) {
        CarvingLoop loop = carved_by(hand, n_per_m, {});
        loop.coupling_n_per_m = coupling;
        const auto first = first_chatter(loop);
        if (!first) continue;
        EXPECT_LT(std::abs(residue(loop, *first)), 1e-3 * n_per_m) << hand_model(hand).name;
        ++compared;
      }
    }
  }
  EXPECT_GE(compared, 12);
}

TEST(LoopChatter, NeverComesBeforeWhatTheGovernorAllows) {
  for (const double n_per_m : {150.0, 600.0, 2400.0, 1e5}) {
    CarvingLoop loop = carved_by(Hand::none, n_per_m, {});
    loop.delay_s = 0.0;
    if (const auto direct = first_chatter(loop)) {
      EXPECT_GE(direct->lateness_s, kPi * std::sqrt(loop.mass_kg / (2.0 * n_per_m)));
    } else {
      // b^2 / 2 m
      EXPECT_LT(n_per_m, 2.0 * loop.damping_n_s_per_m * loop.damping_n_s_per_m / loop.mass_kg);
    }
    loop.coupling_n_per_m = 1000.0;
    if (const auto coupled = first_chatter(loop)) {
      EXPECT_GT(chatter_limit_n_per_m(loop.mass_kg, 0.999 * coupled->lateness_s), 0.0);
      EXPECT_LE(chatter_limit_n_per_m(loop.mass_kg, coupled->lateness_s), 1000.0);
    }
  }
}

TEST(LoopChatter, NeedsASpringThatOvercomesTheDamping) {
  CarvingLoop loop;
  const double least_n_per_m = 0.5 * loop.damping_n_s_per_m * loop.damping_n_s_per_m / loop.mass_kg;
  loop.delay_s = 0.0;
  loop.stiffness_n_per_m = 0.99 * least_n_per_m;
  EXPECT_FALSE(first_chatter(loop));
  loop.stiffness_n_per_m = 1.2 * least_n_per_m;
  EXPECT_TRUE(first_chatter(loop));
}

/// A spring from where the tool has cut, 1 mm above itself, to where it is; what it has cut is
/// known after whole ticks.
class LateSpring final : public ForceScene {
 public:
  LateSpring(double n_per_m, std::size_t late_ticks)
      : n_per_mm_(1e-3 * n_per_m), late_(late_ticks) {}

  SceneForce force_at(const HandleState& handle) const noexcept override {
    SceneForce felt;
    felt.force_n.y = n_per_mm_ * std::max(0.0, surface_mm_ - handle.position_mm.y);
    return felt;
  }
  void end_tick(const HandleState& tool) noexcept override {
    cuts_mm_.push_back(tool.is_active ? tool.position_mm.y + 1.0 : surface_mm_);
    if (cuts_mm_.size() > late_) {
      surface_mm_ = std::min(surface_mm_, cuts_mm_[cuts_mm_.size() - 1 - late_]);
    }
  }

 private:
  double n_per_mm_;
  std::size_t late_;
  std::vector<double> cuts_mm_;
  double surface_mm_ = 0.0;
};

/// Whether a hand that is led down at 20 mm/s chatters by more than a hand ignores.
bool chatters(Hand hand, double n_per_m, std::size_t late_ticks) {
  HoldTest test;
  test.device = frictionless_falcon();
  test.device.encoder = Encoder::uniform;
  test.hand = hand_model(hand);
  test.servo = bare_servo(1e-3);
  HandKey key;
  key.place_mm.y = 2.0;
  key.is_active = true;
  test.plan.push_back(key);
  key.time_s = 3.0;
  key.place_mm.y -= 20.0 * key.time_s;
  test.plan.push_back(key);
  test.settle_s = 2.5;
  test.watch_s = 0.5;
  LateSpring spring(n_per_m, late_ticks);
  return run_hold_test(spring, test).judgement.force_pp_n > kBuzzN;
}

/// Whatever the hand, once the spring is stiff enough that the swing is a small one.
TEST(LateWindows, CycleWhereTheEquationSays) {
  for (const Hand hand : {Hand::push, Hand::light, Hand::arm, Hand::firm}) {
    for (const double n_per_m : {1200.0, 1700.0, 2400.0}) {
      const auto first = first_chatter(carved_by(hand, n_per_m, frictionless_falcon()));
      ASSERT_TRUE(first);
      // A tick's end to the next one's force, half a tick of hold and the device's delay.
      const CarvingLateness none{0.0, 1e-3, 1e-3, 0.0, 1.5e-3};
      const double age_ms = 1e3 * (first->lateness_s - none.total_s());
      std::size_t late = static_cast<std::size_t>(0.7 * age_ms);
      ASSERT_FALSE(chatters(hand, n_per_m, late));
      while (late < 150 && !chatters(hand, n_per_m, late)) ++late;
      const double ratio = static_cast<double>(late) / age_ms;
      std::printf("%s, K = %g: equation %.1f ms, simulation %zu ms\n", hand_model(hand).name,
                  n_per_m, age_ms, late);
      EXPECT_GE(ratio, 0.95);
      EXPECT_LE(ratio, 1.10);
    }
  }
}

}  // namespace
}  // namespace argil::haptics
