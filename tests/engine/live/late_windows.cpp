// SPDX-License-Identifier: GPL-3.0-or-later
// Real clay that is felt late: windows that come every P and are A old when they come.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "argil/engine/clay_worker.h"
#include "argil/haptics/analysis/hold_test.h"
#include "argil/haptics/scene/scene_clay.h"

namespace argil {
namespace {

using haptics::Hand;

constexpr double kFineMm = 1.0;
constexpr double kFeedMmPerS = 20.0;
constexpr double kPressedS = 1.2;  ///< from then on it carves

struct Lateness {
  double age_s;     ///< A
  double period_s;  ///< P
};

/// Steps the clay every P, and hands on what it publishes A later.
class LateClay final : public haptics::ServoObserver {
 public:
  LateClay(ClayWorker& worker, WindowChannel& from, WindowChannel& to, const Lateness& late)
      : worker_(worker), from_(from), to_(to), late_(late) {}

  void after_tick(const haptics::ServoTick& tick) override {
    if (tick.time_s + 1e-9 >= next_s_) {
      next_s_ += late_.period_s;
      EXPECT_TRUE(worker_.step().ok());
      if (from_.fetch()) waiting_.emplace_back(tick.time_s + late_.age_s, from_.read_slot());
    }
    while (!waiting_.empty() && waiting_.front().first <= tick.time_s + 1e-9) {
      to_.write_slot() = waiting_.front().second;
      to_.publish();
      waiting_.pop_front();
    }
  }

 private:
  ClayWorker& worker_;
  WindowChannel& from_;
  WindowChannel& to_;
  Lateness late_;
  double next_s_ = 0.0;
  std::deque<std::pair<double, WindowSlot>> waiting_;
};

/// Comes down, presses 3 N, then carves straight down for 1.5 s.
haptics::HoldTest drilling(Hand hand, haptics::Encoder encoder) {
  haptics::HoldTest test;
  test.device.encoder = encoder;
  test.hand = haptics::hand_model(hand);
  test.plan = haptics::press_plan({0.0, -3.0, 0.0}, {0.0, -1.0, 0.0}, 3.0);
  for (haptics::HandKey& key : test.plan) key.time_s += 0.6;
  haptics::HandKey key = test.plan.back();
  key.time_s = kPressedS;
  key.press_n = test.hand.is_push ? 0.0 : 1.0;
  key.is_active = true;
  test.plan.push_back(key);
  key.time_s += 1.5;
  key.place_mm.y -= 1.5 * kFeedMmPerS;
  test.plan.push_back(key);
  test.settle_s = kPressedS + 0.5;
  test.watch_s = 1.0;
  return test;
}

/// What was found of the last second.
struct Drilled {
  double swing_mm = 0.0;  ///< in pieces of 0.2 s, in which the hand's way is nearly straight
  double mean_n = 0.0;
  double step_n = 0.0;  ///< 99 % of the changes of the force from tick to tick
  double way_mm = 0.0;
};

Drilled judge(const haptics::HoldTestResult& run) {
  const std::size_t watched = 1000;
  const auto places = std::span<const Vec3>(run.true_position_mm).last(watched);
  const auto forces = std::span<const Vec3>(run.held_force_n).last(watched);
  Drilled found;
  for (std::size_t n = 0; n + 200 <= watched; n += 200) {
    const auto piece = haptics::judge_hold(places.subspan(n, 200), forces.subspan(n, 200), 1e-3);
    if (piece.frequency_hz > 0.0) found.swing_mm = std::max(found.swing_mm, piece.position_pp_mm);
  }
  std::vector<double> steps;
  for (std::size_t n = 0; n + 1 < watched; ++n) {
    steps.push_back(length(forces[n + 1] - forces[n]));
    found.mean_n += forces[n].y / static_cast<double>(watched);
  }
  std::sort(steps.begin(), steps.end());
  found.step_n = steps[steps.size() * 99 / 100];
  found.way_mm = places.front().y - places.back().y;
  return found;
}

Drilled drill(Hand hand, const Lateness& late, bool is_stamped,
              haptics::Encoder encoder = haptics::Encoder::kinematic) {
  ClayOptions clay_options;
  clay_options.voxel_mm = 0.5;
  Clay clay = Clay::block({16.0, 60.0, 16.0}, clay_options).value();
  ToolSampleRing ring(1024);
  WindowChannel fresh;
  WindowChannel late_windows;
  ClayWorkerOptions worker_options;
  worker_options.tool = {Action::carve, Shape::ball, {kFineMm, kFineMm, kFineMm}, 1.0};
  ClayWorker worker(clay, worker_options, ring, fresh);
  haptics::ClaySceneOptions options;
  options.tool.radii_mm = {kFineMm, kFineMm, kFineMm};
  options.material.skin_mm = 1.0;
  options.material.exponent = 4.0;
  options.offset_mm = {0.0, 30.0, 0.0};
  options.own_cut_mm = is_stamped ? kFineMm : 0.0;
  haptics::ClayScene scene(options, ring, late_windows);
  LateClay steps(worker, fresh, late_windows, late);
  const Drilled found = judge(haptics::run_hold_test(scene, drilling(hand, encoder), &steps));
  std::printf(
      "%s, (A, P) = (%g, %g) ms, %s: swing %.3f mm, mean %.2f N, step %.3f N, way %.1f mm\n",
      haptics::hand_model(hand).name, 1e3 * late.age_s, 1e3 * late.period_s,
      is_stamped ? "stamped" : "not stamped", found.swing_mm, found.mean_n, found.step_n,
      found.way_mm);
  return found;
}

/// Without stamps, in the hand that chatters first.
TEST(LateWindows, QuietAtFiveMs) {
  const Drilled found = drill(Hand::light, {0.005, 0.005}, false);
  EXPECT_LT(found.swing_mm, 0.06);
  EXPECT_GT(found.way_mm, 10.0);
}

/// Clay that is felt 92 ms late in all and resists what is gone already: not where the servo takes
/// its own cuts out of the windows.
TEST(LateWindows, StampedAreQuietAtFiftyMs) {
  const Lateness late{0.050, 0.050};
  const double without_n = drill(Hand::arm, late, false).mean_n;
  for (const Hand hand : {Hand::push, Hand::light, Hand::arm, Hand::firm}) {
    const Drilled found = drill(hand, late, true);
    EXPECT_LT(found.swing_mm, 0.03);
    EXPECT_LT(found.mean_n, 0.5 * without_n);
    EXPECT_GT(found.way_mm, 10.0);
  }
}

/// What a tick changes of the force, at exchanges of windows and between them. With an encoder that
/// does not round: through the coupling each of its counts is 0.06 N.
TEST(LateWindows, StampedHaveNoStepAtAnExchange) {
  const Lateness late{0.050, 0.050};
  EXPECT_GT(drill(Hand::arm, late, false, haptics::Encoder::exact).step_n, 0.05);
  for (const Hand hand : {Hand::push, Hand::arm}) {
    EXPECT_LT(drill(hand, late, true, haptics::Encoder::exact).step_n, 0.03);
  }
}

/// Whether a tool that is led over clay, to and fro from rest, is ever without its window.
bool leaves_its_window(double mm_per_s, const Lateness& late, double margin_mm) {
  constexpr double kHalfWayMm = 25.0;
  ClayOptions clay_options;
  clay_options.voxel_mm = 0.5;
  Clay clay = Clay::block({80.0, 20.0, 16.0}, clay_options).value();
  ToolSampleRing ring(1024);
  WindowChannel fresh;
  WindowChannel late_windows;
  ClayWorkerOptions worker_options;
  worker_options.tool = {Action::carve, Shape::ball, {kFineMm, kFineMm, kFineMm}, 1.0};
  ClayWorker worker(clay, worker_options, ring, fresh);
  haptics::ClaySceneOptions options;
  options.tool.radii_mm = {kFineMm, kFineMm, kFineMm};
  options.margin_mm = margin_mm;
  haptics::ClayScene scene(options, ring, late_windows);
  LateClay steps(worker, fresh, late_windows, late);
  bool has_left = false;
  haptics::ServoTick tick;
  haptics::HandleState tool;
  tool.position_mm.y = 10.0;
  for (int n = 0; n < 1500; ++n) {
    tick.time_s = tool.time_s = 1e-3 * n;
    if (n > 300) {  // it has its first windows
      if (tool.velocity_mm_per_s.x == 0.0) tool.velocity_mm_per_s.x = mm_per_s;
      if (std::abs(tool.position_mm.x) > kHalfWayMm) {
        tool.velocity_mm_per_s.x = tool.position_mm.x > 0.0 ? -mm_per_s : mm_per_s;
      }
      tool.position_mm.x += 1e-3 * tool.velocity_mm_per_s.x;
    }
    scene.begin_tick(tool);
    const std::uint32_t faults = scene.force_at(tool).faults;
    has_left |= n > 300 && (faults & haptics::kSceneOutsideWindow) != 0;
    scene.end_tick(tool);
    steps.after_tick(tick);
  }
  return has_left;
}

/// v = margin / (A + P + 5 ms), from rest on: what the window reaches before it knows of the
/// motion.
TEST(LateWindows, HoldTheToolBelowTheEdgeSpeed) {
  constexpr double kMarginMm = 4.0;
  for (const Lateness& late : {Lateness{0.005, 0.005}, {0.05, 0.05}}) {
    const double edge_mm_per_s = kMarginMm / (late.age_s + late.period_s + 0.005);
    EXPECT_FALSE(leaves_its_window(0.8 * edge_mm_per_s, late, kMarginMm)) << late.age_s;
    EXPECT_TRUE(leaves_its_window(2.0 * edge_mm_per_s, late, kMarginMm)) << late.age_s;
  }
}

}  // namespace
}  // namespace argil
