// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/force/own_cuts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "argil/haptics/force/servo_force.h"

#include "haptics/force/analytic_publisher.h"
#include "haptics/force/fields.h"

namespace argil::haptics {
namespace {

using namespace fields;

constexpr double kCutMm = 2.0;

WindowSlot window_of(const Distance& field, const Vec3& center) {
  const Window sampled_window = sampled(field, center, 8.0, 0.5);
  WindowSlot slot;
  slot.sequence = 1;
  slot.origin_mm = sampled_window.view.origin_mm;
  slot.voxel_mm = sampled_window.view.voxel_mm;
  slot.nodes = sampled_window.view.nodes;
  std::copy(sampled_window.values.begin(), sampled_window.values.end(), slot.distance_mm.begin());
  return slot;
}

Vec3 place_of(const WindowSlot& slot, int i, int j, int k) {
  return slot.origin_mm + slot.voxel_mm * Vec3{static_cast<double>(i), static_cast<double>(j),
                                               static_cast<double>(k)};
}

/// A straight way through a plane, stamped on a window that has not heard of it: near the tool it
/// is the plane without the capsule that the ball went through.
TEST(OwnCuts, TakeTheToolsWayOutOfAWindow) {
  OwnCuts cuts(kCutMm);
  Vec3 place{-3, 0, 0};
  for (int tick = 0; tick <= 60; ++tick) {
    place = {-3.0 + 0.05 * tick, 0.0, 0.0};
    cuts.move_to(place, tick < 1 ? OwnCuts::kGrowS : 1e-3, true);
    if (tick == 0) {
      for (int n = 0; n < 30; ++n) cuts.move_to(place, 1e-3, true);
    }
  }
  const Distance before = plane({0, 0, 1});
  WindowSlot slot = window_of(before, place);
  const double reach_mm = 3.0;
  cuts.stamp_all(slot, place, reach_mm);
  int changed = 0;
  for (int i = 0; i < slot.nodes[0]; ++i) {
    for (int j = 0; j < slot.nodes[1]; ++j) {
      for (int k = 0; k < slot.nodes[2]; ++k) {
        const Vec3 p = place_of(slot, i, j, k);
        const Vec3 nearest{std::clamp(p.x, -3.0, 0.0), 0.0, 0.0};
        const double left = std::max(before(p), kCutMm - length(p - nearest));
        const bool is_near =
            std::max({std::abs(p.x - place.x), std::abs(p.y), std::abs(p.z)}) <= reach_mm;
        const double expected = is_near ? left : before(p);
        EXPECT_NEAR(slot.distance_mm[slot.view().index(i, j, k)], expected, 1e-5);
        changed += expected > before(p) + 1e-6 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(changed, 200);
}

/// What a late clay has not answered is not felt, and its answer changes nothing more.
TEST(OwnCuts, OnlyLowerTheEnergy) {
  WindowChannel channel;
  AnalyticPublisher publisher(channel);
  ServoForce servo(channel, {}, ForceLaw::energy, ForceMethod::volume, {0.0, 0.0, 0.0}, kCutMm);
  ForceTool tool = ball_tool(kCutMm, {0, 0, 1});
  const Distance clay = plane({0, 0, 1});
  publisher.publish(clay, tool);
  double last_nmm = std::numeric_limits<double>::infinity();
  double largest_step_n = 0.0;
  Vec3 last_n = servo.tick(tool).contact_n;
  const double whole_n = length(last_n);
  for (int tick = 0; tick < 100; ++tick) {
    if (tick == 50) publisher.publish(clay, tool);  // one that knows nothing of the cut yet
    servo.begin_tick(tool);
    const ForceResult felt = servo.at(tool);
    EXPECT_LE(felt.energy_nmm, last_nmm + 1e-6) << tick;
    largest_step_n = std::max(largest_step_n, length(felt.contact_n - last_n));
    last_nmm = felt.energy_nmm;
    last_n = felt.contact_n;
    servo.cut(tool, 1e-3, true);
  }
  EXPECT_LT(length(last_n), 0.8 * whole_n);
  EXPECT_LT(largest_step_n, 0.15 * whole_n);
}

/// Where the hand does not work, was carried elsewhere, or the time is over, nothing is cut.
TEST(OwnCuts, EndWithTheStrokeAndAreForgotten) {
  OwnCuts cuts(kCutMm);
  const auto cut_at = [&](const Vec3& place) {
    for (int n = 0; n < 40; ++n) cuts.move_to(place, 1e-3, true);
  };
  cut_at({-6, 0, 0});
  cuts.move_to({-6, 0, 0}, 1e-3, false);
  EXPECT_FALSE(cuts.is_cutting());
  cuts.move_to({6, 0, 0}, 1e-3, false);
  cut_at({6, 0, 0});
  cuts.forget_motion();
  WindowSlot between = window_of(plane({0, 0, 1}), {0, 0, 0});
  cuts.stamp_all(between, {0, 0, 0}, 3.0);
  EXPECT_EQ(distance_at(between.view(), {0, 0, -1}), -1.0) << "cut from one stroke to the next";
  WindowSlot there = window_of(plane({0, 0, 1}), {6, 0, 0});
  cuts.stamp_all(there, {6, 0, 0}, 3.0);
  EXPECT_NE(there.distance_mm, window_of(plane({0, 0, 1}), {6, 0, 0}).distance_mm);
  cuts.move_to({6, 0, 0}, OwnCuts::kKeptS + 0.01, false);
  there = window_of(plane({0, 0, 1}), {6, 0, 0});
  cuts.stamp_all(there, {6, 0, 0}, 3.0);
  EXPECT_EQ(there.distance_mm, window_of(plane({0, 0, 1}), {6, 0, 0}).distance_mm);
}

}  // namespace
}  // namespace argil::haptics
