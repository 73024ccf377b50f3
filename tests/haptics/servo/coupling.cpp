// SPDX-License-Identifier: GPL-3.0-or-later
// Direct and indirect coupling: eq. 4.1 and 4.2.
#include "argil/haptics/servo/coupling.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "haptics/servo/loop_scenes.h"
#include "haptics/servo/tick.h"

namespace argil::haptics {
namespace {

using scenes::PlainWall;

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

HandleState handle_at(const Vec3& place_mm) {
  HandleState handle;
  handle.position_mm = place_mm;
  return handle;
}

CouplingOptions indirect(double stiffness_n_per_m) {
  CouplingOptions options;
  options.stiffness_n_per_m = stiffness_n_per_m;
  return options;
}

/// 20 N wherever y < 0: a step that no spring law has.
class Relay final : public ForceScene {
 public:
  SceneForce force_at(const HandleState& place) const noexcept override {
    SceneForce felt;
    if (place.position_mm.y < 0.0) felt.force_n.y = 20.0;
    return felt;
  }
};

/// A ball of 50 mm: the direction turns with the position.
class Ball final : public ForceScene {
 public:
  SceneForce force_at(const HandleState& place) const noexcept override {
    SceneForce felt;
    const double distance = length(place.position_mm);
    if (distance < 50.0) felt.force_n = 3.0 * (50.0 - distance) * normalized(place.position_mm);
    return felt;
  }
};

TEST(Equation4_2, PullsTheHandleTowardsTheProxy) {
  // The wall is so stiff that the proxy rests on it, 1 mm outside the handle.
  Coupling coupling(indirect(1000.0));
  const CoupledForce felt =
      coupling.tick(PlainWall(1e9), handle_at({0.0, -1.0, 0.0}), kUnlimited, kTickS);
  EXPECT_NEAR(felt.proxy_mm.y, 0.0, 1e-3);
  EXPECT_NEAR(felt.force_n.y, 1.0, 1e-3);
}

TEST(Equation4_2, RepelsTheHandleAsPrinted) {
  CouplingOptions options = indirect(1000.0);
  options.as_printed = true;
  Coupling coupling(options);
  const CoupledForce felt =
      coupling.tick(PlainWall(1e9), handle_at({0.0, -1.0, 0.0}), kUnlimited, kTickS);
  EXPECT_NEAR(felt.force_n.y, -1.0, 1e-3);  // deeper into the wall: why it is not the default
}

TEST(Equation4_2, PutsTheStiffnessesInSeries) {
  for (const double wall : {200.0, 1500.0, 8000.0, 30000.0}) {
    for (const double spring : {400.0, 1500.0}) {
      Coupling coupling(indirect(spring));
      const CoupledForce felt =
          coupling.tick(PlainWall(wall), handle_at({3.0, -4.0, 2.0}), kUnlimited, kTickS);
      const double series = wall * spring / (wall + spring);
      EXPECT_NEAR(felt.force_n.y, 4e-3 * series, 4e-5 * series) << wall << " " << spring;
      EXPECT_LE(felt.queries, 10);
    }
  }
}

TEST(Equation4_2, HoldsTheProxyOnARigidWall) {
  Coupling coupling(indirect(1500.0));
  for (int step = 1; step < 120; ++step) {
    const double depth = 0.05 * step;
    const CoupledForce felt =
        coupling.tick(Relay(), handle_at({0.0, -depth, 0.0}), kUnlimited, kTickS);
    ASSERT_NEAR(felt.force_n.y, 1.5 * depth, 2e-3) << depth;
  }
}

TEST(Equation4_2, NeverExceedsTheGovernorsStiffness) {
  Coupling coupling(indirect(1500.0));
  const CoupledForce felt = coupling.tick(Relay(), handle_at({0.0, -1.0, 0.0}), 300.0, kTickS);
  EXPECT_NEAR(felt.force_n.y, 0.3, 1e-3);
}

TEST(Equation4_2, FollowsASurfaceThatTurns) {
  // Slid round a ball at 100 mm/s, the force stays radial within what a tick's way turns.
  Coupling coupling(indirect(1500.0));
  double worst = 0.0;
  for (int tick = 0; tick < 1000; ++tick) {
    const double angle = 0.1 * tick / 48.0;
    const Vec3 out{std::cos(angle), std::sin(angle), 0.0};
    const CoupledForce felt = coupling.tick(Ball(), handle_at(48.0 * out), kUnlimited, kTickS);
    if (tick == 0) continue;
    worst = std::max(worst, length(normalized(felt.force_n) - out));
    ASSERT_NEAR(length(felt.force_n), 2.0, 2e-3);
  }
  EXPECT_LT(worst, 1e-3);
}

/// A groove: two walls of 45 degrees that meet at x = 0, y = 0; deep in it the push comes from the
/// sides, and a proxy kept on a rail would be held sideways by more than the spring.
class Groove final : public ForceScene {
 public:
  SceneForce force_at(const HandleState& place) const noexcept override {
    SceneForce felt;
    const double height = 10.0 - 10.0 * std::cos(0.25 * place.position_mm.x);
    const double slope = 2.5 * std::sin(0.25 * place.position_mm.x);
    const double depth = height - place.position_mm.y;
    if (depth <= 0.0) return felt;
    felt.force_n = 1.5 * depth * Vec3{-slope, 1.0, 0.0};
    felt.stiffness_n_per_m = 1500.0;
    return felt;
  }
};

TEST(Equation4_2, HoldsNoStifferAcrossTheForceThanItsSpring) {
  Coupling coupling(indirect(300.0));
  Vec3 before;
  for (int tick = 0; tick < 200; ++tick) {
    const Vec3 place{0.01 * tick - 1.0, -8.0, 0.0};
    const CoupledForce felt = coupling.tick(Groove(), handle_at(place), kUnlimited, kTickS);
    if (tick > 10) {  // it starts 8 mm deep, where no hand comes from nothing
      // 0.01 mm in a spring of 300 N/m, and the accuracy of two balances
      ASSERT_LE(length(felt.force_n - before), 3e-3 + 2.5e-3) << tick;
    }
    before = felt.force_n;
  }
}

TEST(Equation4_2, StaysOnItsSideOfASheetWhenTheHandleDrawsBack) {
  class Sheet final : public ForceScene {  // 2 mm thick, pushing out on either side
   public:
    SceneForce force_at(const HandleState& place) const noexcept override {
      SceneForce felt;
      const double y = place.position_mm.y;
      if (y > 0.0 || y < -2.0) return felt;
      felt.force_n.y = y > -1.0 ? -30.0 * y : -30.0 * (y + 2.0);
      felt.stiffness_n_per_m = 30'000.0;
      return felt;
    }
  };
  Coupling coupling(indirect(1000.0));
  double depth = 0.0;
  for (int step = 0; step < 80; ++step, depth += 0.05) {
    coupling.tick(Sheet(), handle_at({0.0, -depth, 0.0}), kUnlimited, kTickS);
  }
  for (int step = 0; step < 25; ++step, depth -= 0.15) {  // 150 mm/s
    const CoupledForce felt =
        coupling.tick(Sheet(), handle_at({0.0, -depth, 0.0}), kUnlimited, kTickS);
    ASSERT_GT(felt.proxy_mm.y, -0.5) << depth;
    ASSERT_NEAR(felt.force_n.y, depth * 30.0 / 31.0, 0.01) << depth;
  }
}

TEST(Equation4_2, IsFreeWhereNothingIsTouched) {
  CouplingOptions options = indirect(1500.0);
  options.damping_n_s_per_m = 5.0;
  Coupling coupling(options);
  HandleState handle = handle_at({0.0, 2.0, 0.0});
  handle.velocity_mm_per_s = {0.0, -500.0, 0.0};
  const CoupledForce felt = coupling.tick(PlainWall(8000.0), handle, kUnlimited, kTickS);
  EXPECT_EQ(felt.force_n, Vec3{});
  EXPECT_EQ(felt.proxy_mm, handle.position_mm);
}

TEST(Equation4_1, GivesTheScenesForceWhenDirect) {
  CouplingOptions options;
  options.kind = CouplingKind::direct;
  Coupling coupling(options);
  const CoupledForce felt =
      coupling.tick(PlainWall(8000.0), handle_at({0.0, -1.0, 0.0}), 300.0, kTickS);
  EXPECT_DOUBLE_EQ(felt.force_n.y, 8.0);
  EXPECT_EQ(felt.queries, 1);
}

TEST(Coupling, SaysWhenTheSceneGivesNoNumber) {
  PlainWall wall(1000.0);
  wall.bad = true;
  for (const CouplingKind kind : {CouplingKind::direct, CouplingKind::indirect}) {
    CouplingOptions options;
    options.kind = kind;
    Coupling coupling(options);
    const CoupledForce felt = coupling.tick(wall, handle_at({0.0, -1.0, 0.0}), kUnlimited, kTickS);
    EXPECT_NE(felt.faults & kSceneNotFinite, 0U);
    EXPECT_EQ(felt.force_n, Vec3{});
  }
}

/// Asks no more often than a scene can afford, even where the law fits no secant.
TEST(Coupling, KeepsToTheScenesQueries) {
  class Dear final : public ForceScene {
   public:
    SceneForce force_at(const HandleState& place) const noexcept override {
      SceneForce felt;
      if (place.position_mm.y < 0.0) felt.force_n.y = 20.0;
      return felt;
    }
    int most_queries() const noexcept override { return 8; }
  };
  Coupling coupling(indirect(1500.0));
  for (const double depth : {0.1, 3.0, 1.0}) {
    const CoupledForce felt =
        coupling.tick(Dear(), handle_at({0.0, -depth, 0.0}), kUnlimited, kTickS);
    EXPECT_LE(felt.queries, 10);  // with the handle's own and the proxy's
    EXPECT_TRUE(is_finite(felt.force_n));
  }
}

}  // namespace
}  // namespace argil::haptics
