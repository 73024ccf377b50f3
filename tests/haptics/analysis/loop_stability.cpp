// SPDX-License-Identifier: GPL-3.0-or-later
// The exact limits of the linear loop against figures of its own derivation and of docs/theory.md.
#include "argil/haptics/analysis/loop_stability.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "argil/haptics/servo/governor.h"
#include "argil/haptics/simulation/hand_model.h"

namespace argil::haptics {
namespace {

LinearLoop held_by(Hand hand, double damping_n_s_per_m) {
  LinearLoop loop;
  loop.damping_n_s_per_m = damping_n_s_per_m;
  if (hand == Hand::push) return loop;
  const HandModel model = hand_model(hand);
  loop.mass_kg += model.mass_kg;
  loop.damping_n_s_per_m += model.damping_n_s_per_m;
  loop.hand_stiffness_n_per_m = model.stiffness_n_per_m;
  return loop;
}

struct Row {
  double damping_n_s_per_m;
  double period_s;
  int delay_ticks;
  std::array<double, 4> limit_n_per_m;  // push, light, arm, firm
};

class LoopStabilityTable : public testing::TestWithParam<Row> {};

TEST_P(LoopStabilityTable, IsTheExactEigenvalueOfTheory) {
  const Row& row = GetParam();
  const std::array hands{Hand::push, Hand::light, Hand::arm, Hand::firm};
  for (std::size_t n = 0; n < hands.size(); ++n) {
    LinearLoop loop = held_by(hands[n], row.damping_n_s_per_m);
    loop.period_s = row.period_s;
    loop.delay_ticks = row.delay_ticks;
    EXPECT_NEAR(largest_stable_stiffness_n_per_m(loop), row.limit_n_per_m[n],
                2e-3 * row.limit_n_per_m[n])
        << hand_model(hands[n]).name;
  }
}

INSTANTIATE_TEST_SUITE_P(B2, LoopStabilityTable,
                         testing::Values(Row{3.0, 0.5e-3, 1, {4004, 8012, 12616, 30798}},
                                         Row{3.0, 1e-3, 1, {2004, 4012, 6317, 15466}},
                                         Row{3.975, 1e-3, 1, {2656, 4666, 6970, 16127}},
                                         Row{3.0, 5e-3, 1, {404, 813, 1278, 3215}},
                                         Row{3.0, 1e-3, 0, {6007, 12022, 18930, 46237}}));

TEST(LoopStability, AgreesWithTheFormulaForAReleasedHandle) {
  for (const double period_s : {0.25e-3, 0.5e-3, 1e-3, 2e-3}) {
    for (const int delay : {0, 1, 2}) {
      LinearLoop loop;
      loop.period_s = period_s;
      loop.delay_ticks = delay;
      const double formula = stiffness_limit_n_per_m(3.0, period_s, delay * period_s);
      EXPECT_NEAR(largest_stable_stiffness_n_per_m(loop), formula, 0.02 * formula)
          << period_s << " s, delay " << delay;
    }
  }
}

/// The rendered damping c at which the loop turns unstable, by bisection to 1e-6 relative.
double largest_stable_damping_n_s_per_m(LinearLoop loop) {
  double low = 1.0;
  double high = 1e7;
  while (high / low > 1.0 + 1e-6) {
    loop.rendered_damping_n_s_per_m = std::sqrt(low * high);
    // A handle that is only damped stays where it is: an eigenvalue of 1 that is no instability.
    const bool is_unstable = spectral_radius(loop) > 1.0 + 1e-9;
    (is_unstable ? high : low) = loop.rendered_damping_n_s_per_m;
  }
  return low;
}

TEST(LoopStability, GivesTheLimitsOfRenderedDamping) {
  LinearLoop loop;
  loop.damping_n_s_per_m = 0.0;
  const std::array factor{2.0, 2.0 * (std::sqrt(2.0) - 1.0), 0.536};
  for (int delay = 0; delay < 3; ++delay) {
    loop.delay_ticks = delay;
    const double expected = factor[static_cast<std::size_t>(delay)] * loop.mass_kg / loop.period_s;
    EXPECT_NEAR(largest_stable_damping_n_s_per_m(loop), expected, 2e-3 * expected) << delay;
  }
}

TEST(LoopStability, DampingRaisesTheLimitAndThenTakesItAway) {
  LinearLoop loop;
  const double bare = largest_stable_stiffness_n_per_m(loop);
  loop.rendered_damping_n_s_per_m = 50.0;
  const double damped = largest_stable_stiffness_n_per_m(loop);
  loop.rendered_damping_n_s_per_m = 390.0;
  EXPECT_NEAR(damped, 31'000.0, 1'000.0);  // an independent eigenvalue
  EXPECT_GT(damped, 10.0 * bare);
  EXPECT_EQ(largest_stable_stiffness_n_per_m(loop), 0.0);
}

TEST(LoopStability, GrowsWithTheRadiusItSays) {
  // Simulated for many ticks, the state grows as the spectral radius to their number.
  LinearLoop loop;
  loop.stiffness_n_per_m = 3000.0;
  const double radius = spectral_radius(loop);
  EXPECT_GT(radius, 1.0);
  loop.stiffness_n_per_m = 1000.0;
  EXPECT_LT(spectral_radius(loop), 1.0);
}

}  // namespace
}  // namespace argil::haptics
