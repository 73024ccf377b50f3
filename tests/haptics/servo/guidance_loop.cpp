// SPDX-License-Identifier: GPL-3.0-or-later
// Guidance in the whole loop: every hand, slow and late loops, filters, loops of path, and surfaces
// on which contact begins and ends. Its energy is counted from the ticks, in the tests' own words.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "argil/haptics/analysis/hold_test.h"
#include "argil/haptics/scene/scene_catalogue.h"
#include "argil/haptics/servo/guided_scene.h"

namespace argil::haptics::guidance_loop {
namespace {

constexpr std::array kKinds{GuidanceKind::direct, GuidanceKind::indirect, GuidanceKind::hybrid};
constexpr std::array kAllHands{Hand::push, Hand::light, Hand::arm, Hand::firm};

/// Nothing to touch.
class Air final : public ForceScene {
 public:
  SceneForce force_at(const HandleState&) const noexcept override { return {}; }
};

/// A floor under y = 0, 1 N/mm.
class Floor final : public ForceScene {
 public:
  SceneForce force_at(const HandleState& handle) const noexcept override {
    const double deep_mm = std::max(0.0, -handle.position_mm.y);
    return {{0.0, deep_mm, 0.0}, deep_mm > 0.0 ? 1000.0 : 0.0};
  }
};

GuidanceOptions along(GuidanceKind kind, std::vector<Vec3> path_mm) {
  GuidanceOptions options;
  options.kind = kind;
  options.path_mm = std::move(path_mm);
  return options;
}

const std::vector<Vec3> kBent{{-20.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 20.0, 0.0}};

struct Guided {
  HoldTestResult ran;
  GuidanceState end;
  double most_given_mj = 0.0;  ///< at any time, counted from the ticks
  double income_mj = 0.0;      ///< what may have flown in
};

/// What the aid that the device held did to the true handle.
Guided run(ForceScene& scene, const GuidanceOptions& options, const HoldTest& test) {
  GuidedScene guided(scene, options);
  Guided out;
  out.ran = run_hold_test(guided, test);
  out.end = guided.guidance();
  const auto late = static_cast<std::size_t>(test.device.delay_ticks);
  const double period_s = test.servo.period_s;
  double given_mj = 0.0;
  for (std::size_t n = late + 1; n < out.ran.ticks.size(); ++n) {
    const ServoTick& acted = out.ran.ticks[n - 1 - late];
    const Vec3 moved_mm = out.ran.ticks[n].position_mm - out.ran.ticks[n - 1].position_mm;
    given_mj += acted.given_part * dot(acted.aid_n, moved_mm);
    out.most_given_mj = std::max(out.most_given_mj, given_mj);
    out.income_mj += 1e-3 * dot(moved_mm, moved_mm) / period_s + period_s;
  }
  EXPECT_NEAR(out.end.given_mj, given_mj, 0.01) << "the servo counts what it gives";
  return out;
}

HandKey key_at(double time_s, const Vec3& place_mm, double press_n = 0.0) {
  HandKey key;
  key.time_s = time_s;
  key.place_mm = place_mm;
  key.press_n = press_n;
  return key;
}

HoldTest test_of(Hand hand, std::vector<HandKey> plan, bool has_friction = true) {
  HoldTest test;
  if (!has_friction) test.device = frictionless_falcon();
  test.hand = hand_model(hand);
  test.plan = std::move(plan);
  test.settle_s = test.plan.back().time_s + 4.0;
  return test;
}

/// A hand that holds still beside the path.
HoldTestResult held(GuidanceKind kind, Hand hand, const Vec3& at_mm) {
  Air air;
  return run(air, along(kind, kBent), test_of(hand, {key_at(0.0, at_mm)})).ran;
}

std::string said(const Guided& guided) {
  return std::to_string(guided.ran.judgement.position_pp_mm) + " mm, " +
         std::to_string(guided.ran.judgement.force_pp_n) + " N, " +
         std::to_string(guided.end.stiffness_n_per_m) + " N/m";
}

TEST(GuidanceLoop, IsQuietBesideThePathInEveryHand) {
  for (const Hand hand : kAllHands) {
    for (const GuidanceKind kind : kKinds) {
      const HoldTestResult ran = held(kind, hand, {-10.0, -8.0, 0.0});
      EXPECT_EQ(ran.judgement.verdict, Verdict::quiet)
          << guidance_name(kind) << " " << static_cast<int>(hand) << ": "
          << ran.judgement.force_pp_n << " N " << ran.judgement.position_pp_mm << " mm";
      EXPECT_EQ(ran.faults & (kCutFaults | kForceLimited), 0U);
    }
  }
}

TEST(GuidanceLoop, LeadsThePathAsTheHandsStiffnessLets) {
  // 8 mm * 135 / 195 and 135 / 75, friction aside.
  const auto off_mm = [&](GuidanceKind kind) {
    return -held(kind, Hand::arm, {-10.0, -8.0, 0.0}).mean_position_mm.y;
  };
  EXPECT_NEAR(off_mm(GuidanceKind::direct), 5.5, 1.0);
  EXPECT_NEAR(off_mm(GuidanceKind::indirect), 14.4, 2.5);
  EXPECT_NEAR(off_mm(GuidanceKind::hybrid), 5.5, 1.5) << "8 mm are beyond its tolerance";
}

void expect_quiet_at(const Vec3& at, const std::vector<Vec3>& loop, Hand hand) {
  for (const bool has_friction : {true, false}) {
    Air air;
    const std::vector<HandKey> plan{key_at(0.0, {-20.0, 0.0, 0.0}), key_at(1.5, at)};
    const Guided in =
        run(air, along(GuidanceKind::indirect, loop), test_of(hand, plan, has_friction));
    EXPECT_EQ(in.ran.judgement.verdict, Verdict::quiet)
        << loop.size() - 1 << " sides, hand " << static_cast<int>(hand) << ": " << said(in);
  }
}

/// Off-hand into a loop of 15 mm, to its middle and beside it: a push has no side there.
TEST(GuidanceLoop, IsQuietInsideALoop) {
  for (const int sides : {8, 24}) {
    std::vector<Vec3> loop;
    for (int n = 0; n <= sides; ++n) {
      const double angle = 2.0 * std::numbers::pi * (n % sides) / sides;
      loop.push_back({15.0 * std::cos(angle), 15.0 * std::sin(angle), 0.0});
    }
    for (const Hand hand : kAllHands) {
      for (const Vec3& at : {Vec3{}, Vec3{8.0, 3.0, 0.0}}) expect_quiet_at(at, loop, hand);
    }
  }
}

/// A servo loop and the stiffest guidance that it may give.
struct GuidedLoop {
  double rate_hz;
  int delay_ticks;
  double filter;  // 0: none
  double lambda_mm;
  double most_n_per_m;  // of guidance, of a Falcon with 3.975 N s/m
};

/// Brought to the path's end in a jerk.
HoldTest jerk_in(const GuidedLoop& loop, Hand hand) {
  HoldTest test = test_of(
      hand,
      {key_at(0.0, {0.0, 12.0, 0.0}), key_at(0.7, {0.0, 12.0, 0.0}), key_at(0.75, {0.0, 2.0, 0.0})},
      false);
  test.servo.period_s = 1.0 / loop.rate_hz;
  test.device.delay_ticks = loop.delay_ticks;
  if (loop.filter > 0.0) {
    test.servo.position_filter = PositionFilterOptions{loop.filter, loop.lambda_mm};
  }
  return test;
}

/// Loops as slow, late and filtered as can be asked for, and the stiffest and strongest guidance.
TEST(GuidanceLoop, IsQuietInLoopsThatAreSlowLateOrFiltered) {
  constexpr std::array kLoops{
      GuidedLoop{1000.0, 1, 0.0, 0.0, 500.0}, GuidedLoop{1000.0, 1, 0.02, 10.0, 19.7},
      GuidedLoop{1000.0, 1, 0.2, 0.3, 181.0}, GuidedLoop{100.0, 3, 0.0, 0.0, 28.4},
      GuidedLoop{200.0, 5, 0.0, 0.0, 36.1},   GuidedLoop{250.0, 4, 0.05, 3.0, 27.9}};
  for (const GuidedLoop& loop : kLoops) {
    for (const GuidanceKind kind : kKinds) {
      for (const Hand hand : kAllHands) {
        GuidanceOptions options = along(kind, {{-10.0, 0.0, 0.0}, {10.0, 0.0, 0.0}});
        options.stiffness_n_per_m = 500.0;
        options.most_force_n = 8.0;
        Air air;
        const Guided steady = run(air, options, jerk_in(loop, hand));
        EXPECT_EQ(steady.ran.judgement.verdict, Verdict::quiet)
            << loop.rate_hz << " Hz, " << loop.delay_ticks << " ticks, filter " << loop.filter
            << ", " << guidance_name(kind) << ", hand " << static_cast<int>(hand) << ": "
            << said(steady);
        EXPECT_NEAR(steady.end.stiffness_n_per_m, loop.most_n_per_m, 0.02 * loop.most_n_per_m);
      }
    }
  }
}

/// Where the pull of a place beside a ball's surface can be of no use: 1.5 N less what is across.
double law_n(const Vec3& tool_mm, const Vec3& goal_mm) {
  const Vec3 back_mm = goal_mm - tool_mm;
  const Vec3 out = normalized(tool_mm);
  const Vec3 pull_n = std::min(1.5, 0.06 * length(back_mm)) * normalized(back_mm);
  return length(pull_n - dot(pull_n, out) * out);
}

/// Over the sphere of the catalogue (50 mm) to a point far round it and back, again and again: the
/// pull is there all the time, and has given no more than it may.
TEST(GuidanceOnABall, IsAliveAndPassiveAllTheWayRound) {
  const SceneEntry& entry = *find_scene("sphere");
  for (const Vec3& goal : {Vec3{46.0, 20.0, 0.0}, Vec3{50.0, 0.0, 0.0}, Vec3{0.0, 20.0, 46.0}}) {
    for (const Hand hand : {Hand::light, Hand::firm}) {
      const auto sphere = entry.make(SceneValues(entry.parameters));
      std::vector<HandKey> plan{key_at(0.0, {-26.0, 48.0, 0.0}), key_at(0.6, {-26.0, 48.0, 0.0}),
                                key_at(1.0, {-22.0, 42.0, 0.0})};
      for (int round = 0; round < 4; ++round) {
        const double begin_s = 1.0 + 4.0 * round;
        plan.push_back(key_at(begin_s + 2.0, {22.0, 42.0, 0.0}));
        plan.push_back(key_at(begin_s + 4.0, {-22.0, 42.0, 0.0}));
      }
      const Guided guided = run(*sphere, along(GuidanceKind::direct, {goal}), test_of(hand, plan));
      int touching = 0;
      for (const ServoTick& tick : guided.ran.ticks) {
        if (tick.time_s < 1.0) continue;
        const double across_n = dot(tick.aid_n, normalized(tick.proxy_mm));
        if (std::abs(across_n) > 0.02) continue;  // in the air all of it is felt
        ++touching;
        ASSERT_NEAR(length(tick.aid_n), law_n(tick.proxy_mm, goal), 0.03) << tick.time_s << " s";
      }
      EXPECT_GT(touching, 8000);
      const Vec3 first = guided.ran.ticks.front().proxy_mm;
      const double stored_mj = 1.5 * (length(goal - first) - 12.5);
      EXPECT_LE(guided.most_given_mj, stored_mj + 25.0 + guided.income_mj);
      EXPECT_EQ(guided.ran.judgement.verdict, Verdict::quiet) << said(guided);
    }
  }
}

/// A hand that taps a floor while it goes along a path that lies 4 mm over it: with each tap the
/// part of the pull across the floor goes and comes.
TEST(GuidanceOnAFloor, IsAliveAndPassiveWhereContactBeginsAndEnds) {
  for (const GuidanceKind kind : {GuidanceKind::direct, GuidanceKind::indirect}) {
    for (const double over_mm : {4.0, 15.0}) {
      Floor floor;
      std::vector<HandKey> plan{key_at(0.0, {-20.0, 3.0, 12.0}), key_at(0.6, {-20.0, 3.0, 12.0})};
      constexpr int kTaps = 60;
      for (int tap = 0; tap < kTaps; ++tap) {
        const double at_s = 0.6 + 0.2 * (tap + 1);
        // In, across and out: a way round that gains where a pull is not the same in and out.
        const double z_mm = tap % 4 < 2 ? 12.0 : 6.0;
        plan.push_back(key_at(at_s, {-20.0 + 0.5 * tap, tap % 2 == 0 ? -6.0 : 3.0, z_mm}));
      }
      const GuidanceOptions options = along(kind, {{-50.0, over_mm, 0.0}, {50.0, over_mm, 0.0}});
      const Guided guided = run(floor, options, test_of(Hand::firm, plan));
      const Vec3 first = guided.ran.ticks.front().proxy_mm;
      const double off_mm = std::hypot(first.y - over_mm, first.z);
      const double stored_mj = kind == GuidanceKind::direct ? 0.03 * off_mm * off_mm : 0.0;
      EXPECT_LE(guided.most_given_mj, stored_mj + 25.0 + guided.income_mj) << over_mm;
      // At the end as strong as its law, with all of these taps behind it.
      const ServoTick& last = guided.ran.ticks.back();
      const Vec3 off = last.proxy_mm - Vec3{last.proxy_mm.x, over_mm, 0.0};
      const double full_n = std::min(1.5, 0.06 * length(off));
      const double along_n = length(last.aid_n);
      EXPECT_GT(along_n, 0.95 * full_n * std::abs(off.z) / length(off)) << guidance_name(kind);
      EXPECT_LT(along_n, 1.05 * full_n);
    }
  }
}

}  // namespace
}  // namespace argil::haptics::guidance_loop
