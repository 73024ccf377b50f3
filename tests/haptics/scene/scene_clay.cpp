// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene/scene_clay.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "haptics/force/analytic_publisher.h"
#include "haptics/force/fields.h"
#include "support/effort.h"

namespace argil::haptics {
namespace {

using namespace fields;

ClaySceneOptions ball_options(double radius_mm = 4.0) {
  ClaySceneOptions options;
  options.tool = ball_tool(radius_mm, {});
  return options;
}

HandleState clay_handle_at(const Vec3& place, double time_s, bool is_active = false) {
  return {place, {}, time_s, is_active};
}

/// A scene with the two queues it talks through and a hand-made clay.
struct Rig {
  explicit Rig(const ClaySceneOptions& options = ball_options(), std::size_t ring_capacity = 64)
      : ring(ring_capacity), scene(options, ring, channel), publisher(channel) {}

  std::vector<ToolSample> taken() {
    std::vector<ToolSample> samples;
    ToolSample sample;
    while (ring.pop(sample)) samples.push_back(sample);
    return samples;
  }

  ToolSampleRing ring;
  WindowChannel channel;
  ClayScene scene;
  AnalyticPublisher publisher;
};

TEST(ClayScene, KnowsNothingBeforeTheFirstWindow) {
  Rig rig;
  const HandleState handle = clay_handle_at({0, 0, 1}, 0.0);
  rig.scene.begin_tick(handle);
  rig.scene.end_tick(handle);
  const SceneForce force = rig.scene.force_at(handle);
  EXPECT_EQ(force.force_n, Vec3{});
  EXPECT_EQ(force.faults, static_cast<std::uint32_t>(kSceneWaiting));
  EXPECT_EQ(rig.scene.most_queries(), 12);
}

/// Flat clay whose detail is waves of 2 mm along x, 0.05 mm high, slid over at 50 mm/s.
TEST(ClayScene, AddsATextureOfTheDetailThatTheWindowLost) {
  ClaySceneOptions options = ball_options();
  options.texture.emplace();
  Rig rig(options);
  SurfaceDetail& detail = rig.publisher.detail;
  detail.is_known = true;
  detail.origin_mm = {-3.875, -3.875, 0.0};
  detail.step_x_mm = {0.25, 0.0, 0.0};
  detail.step_y_mm = {0.0, 0.25, 0.0};
  detail.normal = {0.0, 0.0, 1.0};
  for (int n = 0; n < SurfaceDetail::kSide * SurfaceDetail::kSide; ++n) {
    const int row = n / SurfaceDetail::kSide;
    const double x = row * 0.25 - 3.875;
    detail.height_mm[static_cast<std::size_t>(n)] =
        static_cast<float>(0.05 * std::sin(std::numbers::pi * x));
  }
  rig.publisher.publish(plane({0, 0, 1}), ball_tool(4.0, {}));
  Rig plain;
  plain.publisher.publish(plane({0, 0, 1}), ball_tool(4.0, {}));
  double least = 0.0;
  double most = 0.0;
  for (int n = 0; n <= 80; ++n) {
    const HandleState handle = clay_handle_at({-2.0 + 0.05 * n, 0.0, 0.0}, 1e-3 * n);
    for (Rig* each : {&rig, &plain}) {
      each->scene.begin_tick(handle);
      each->scene.end_tick(handle);
    }
    const Vec3 more = rig.scene.force_at(handle).force_n - plain.scene.force_at(handle).force_n;
    ASSERT_NEAR(more.x, 0.0, 1e-6);
    least = std::min(least, more.z);
    most = std::max(most, more.z);
  }
  EXPECT_NEAR(most, 0.05, 0.01);
  EXPECT_NEAR(least, -0.05, 0.01);
  for (const ToolSample& sample : rig.taken()) EXPECT_TRUE(sample.wants_detail);
  for (const ToolSample& sample : plain.taken()) EXPECT_FALSE(sample.wants_detail);
}

/// The passive mix: all of the contact, 0.3 of the viscosity; placed by the offset.
TEST(ClayScene, FeelsTheClayWhereItIsPlaced) {
  ClaySceneOptions options = ball_options();
  options.offset_mm = {3, -2, 5};
  Rig rig(options);
  ForceTool tool = ball_tool(4.0, {3, -2, 1});
  tool.velocity_mm_per_s = {20, 0, 0};
  rig.publisher.publish(plane({0, 0, 1}), tool);
  HandleState handle = clay_handle_at({0, 0, -4}, 0.0);
  handle.velocity_mm_per_s = tool.velocity_mm_per_s;
  rig.scene.begin_tick(handle);
  rig.scene.end_tick(handle);
  const SceneForce force = rig.scene.force_at(handle);
  const LatticeForce lattice(tool, {}, ForceLaw::energy, choose_lattice(tool).voxel_mm);
  const ForceResult felt = lattice.evaluate(rig.scene.window().view(), tool);
  EXPECT_LE(length(force.force_n - (felt.contact_n + 0.3 * felt.viscosity_n)), 1e-12);
  EXPECT_GT(force.force_n.z, 1.0);
  EXPECT_LT(force.force_n.x, -0.01);
  EXPECT_DOUBLE_EQ(force.stiffness_n_per_m, 1e3 * felt.stiffness_n_per_mm);
  EXPECT_GT(force.stiffness_n_per_m, 0.0);
  EXPECT_EQ(force.faults, static_cast<std::uint32_t>(kSceneSound));
}

/// Another scene on the same ring: indices go on, an old answer answers nothing new, and a stroke
/// that was left open ends.
TEST(ClayScene, GoesOnWhereAnEarlierSceneHasStopped) {
  ToolSampleRing ring(64);
  WindowChannel channel;
  AnalyticPublisher publisher(channel);
  std::uint64_t given = 0;
  {
    ClayScene first(ball_options(), ring, channel);
    for (int tick = 0; tick < 100; ++tick) {
      const HandleState handle = clay_handle_at({0, 0, 4}, 1e-3 * tick, true);
      first.begin_tick(handle);
      first.end_tick(handle);
    }
    given = first.samples();
    publisher.publish(plane({0, 0, 1}), ball_tool(4.0, {0, 0, 4}), 4.0, given, 0.1);
    first.end_stroke();
    EXPECT_EQ(first.samples(), given + 1);
    first.end_stroke();
    given = first.samples();
  }
  ToolSample last;
  while (ring.pop(last)) {
  }
  EXPECT_EQ(last.index, given);
  EXPECT_FALSE(last.is_active);

  ClaySceneOptions options = ball_options();
  options.samples_before = given;
  ClayScene second(options, ring, channel);
  std::uint32_t faults = 0;
  for (int tick = 0; tick < 300; ++tick) {
    const HandleState handle = clay_handle_at({0, 0, 4}, 1e-3 * tick, true);
    second.begin_tick(handle);
    faults = second.force_at(handle).faults;
    second.end_tick(handle);
  }
  EXPECT_EQ(faults, static_cast<std::uint32_t>(kSceneWindowStale));
  ASSERT_TRUE(ring.pop(last));
  EXPECT_EQ(last.index, given + 1);
  EXPECT_FALSE(last.is_active);
  ASSERT_TRUE(ring.pop(last));
  EXPECT_TRUE(last.is_active);
}

/// Working: 0.3 of the contact, reached in a straight line over 100 ms.
TEST(ClayScene, RampsFromTouchingToWorking) {
  Rig rig;
  const Vec3 place{0, 0, 1};
  rig.publisher.publish(plane({0, 0, 1}), ball_tool(4.0, place));
  std::vector<double> felt;
  for (int tick = 0; tick <= 150; ++tick) {
    const HandleState handle = clay_handle_at(place, 1e-3 * tick, tick > 0);
    rig.scene.begin_tick(handle);
    rig.scene.end_tick(handle);
    felt.push_back(rig.scene.force_at(handle).force_n.z);
  }
  const double whole = felt.front();
  EXPECT_NEAR(felt[50] / whole, 1.0 - 0.7 * 0.5, 1e-9);
  EXPECT_NEAR(felt[100] / whole, 0.3, 1e-9);
  EXPECT_NEAR(felt[150] / whole, 0.3, 1e-9);
}

/// And back: where the tool rests in the clay the energy that it feels there grows by no more than
/// the account pays, and off the clay nothing is held back. Deeper it is borne meanwhile.
TEST(ClayScene, PaysForTheWayBackToTouching) {
  ClaySceneOptions options = ball_options();
  options.account = {2.0, 1.0, 0.0};
  Rig rig(options);
  const Vec3 place{0, 0, 1};
  rig.publisher.publish(plane({0, 0, 1}), ball_tool(4.0, place), 10.0);
  int tick = 0;
  const auto feel = [&](const Vec3& at, bool is_active) {
    const HandleState handle = clay_handle_at(at, 1e-3 * tick++, is_active);
    rig.scene.begin_tick(handle);
    rig.scene.end_tick(handle);
  };
  const auto force_at = [&](double z) {
    return rig.scene.force_at(clay_handle_at({0, 0, z}, 0.0)).force_n.z;
  };
  // The energy at the place: the force up to there from where it ends.
  const auto energy_nmm = [&] {
    constexpr double kStepMm = 0.02;
    double sum = 0.0;
    for (double z = 1.0 + 0.5 * kStepMm; z < 20.0; z += kStepMm) sum += kStepMm * force_at(z);
    return sum;
  };
  feel(place, false);
  const double whole_nmm = energy_nmm();
  const double whole_n = force_at(1.0);
  const double deep_n = force_at(-3.0);
  for (int n = 0; n < 1000; ++n) feel(place, true);
  const double working_nmm = energy_nmm();
  EXPECT_NEAR(working_nmm / whole_nmm, 0.3, 1e-6);
  for (int n = 1; n <= 200; ++n) {
    feel(place, false);
    // 1 mJ was saved up, and 2 mW flow in.
    if (n % 20 == 0) {
      EXPECT_LE(energy_nmm(), working_nmm + 1.0 + 2e-3 * n + 1e-3) << n;
    }
  }
  EXPECT_LT(force_at(1.0), 0.9 * whole_n);
  EXPECT_GT(force_at(-3.0), 0.6 * deep_n);
  rig.publisher.publish(plane({0, 0, 1}), ball_tool(4.0, {0, 0, 20}));
  for (int n = 0; n < 20; ++n) feel({0, 0, 20}, false);
  rig.publisher.publish(plane({0, 0, 1}), ball_tool(4.0, place));
  for (int n = 0; n < 20; ++n) feel({0, 0, 20}, false);
  EXPECT_NEAR(force_at(1.0) / whole_n, 1.0, 1e-9);
}

/// With the share of the contact in it, half of the way from touching to working too.
TEST(ClayScene, PushesAgainstTheSlopeOfItsEnergy) {
  Rig rig;
  rig.publisher.publish(plane({0, 0, 1}), ball_tool(4.0, {0, 0, 1}));
  for (int tick = 0; tick <= 50; ++tick) {
    rig.scene.begin_tick(clay_handle_at({0, 0, 1}, 1e-3 * tick, true));
    rig.scene.end_tick(clay_handle_at({0, 0, 1}, 1e-3 * tick, true));
    if (tick % 25 != 0) continue;
    constexpr double kStepMm = 0.01;
    const auto energy_at = [&](double z) {
      return rig.scene.energy_at(clay_handle_at({0, 0, z}, 1e-3 * tick));
    };
    const double slope_n = (energy_at(1 + kStepMm) - energy_at(1 - kStepMm)) / (2.0 * kStepMm);
    const double force_n = rig.scene.force_at(clay_handle_at({0, 0, 1}, 1e-3 * tick)).force_n.z;
    EXPECT_GT(force_n, 0.5);
    EXPECT_NEAR(force_n, -slope_n, 1e-3 * force_n) << tick;
  }
}

/// Dragged along or working, what it touches is the surface, which pushes straight out.
TEST(ClayScene, TellsTheSurfacesPushWithoutTheDrag) {
  Rig rig;
  rig.publisher.publish(plane({0, 0, 1}), ball_tool(4.0, {}));
  HandleState tool = clay_handle_at({0.0, 0.0, 1.0}, 0.0, true);
  tool.velocity_mm_per_s = {80.0, 0.0, 0.0};
  for (int n = 0; n < 200; ++n) {  // until it works and the window is taken
    tool.time_s = 1e-3 * n;
    rig.scene.begin_tick(tool);
    rig.scene.end_tick(tool);
  }
  const Vec3 felt_n = rig.scene.force_at(tool).force_n;
  EXPECT_LT(felt_n.x, -0.1) << "the drag";
  const Vec3 touch_n = rig.scene.touch_n(tool);
  EXPECT_NEAR(touch_n.x, 0.0, 1e-6);
  EXPECT_NEAR(touch_n.y, 0.0, 1e-6);
  EXPECT_GT(touch_n.z, 2.0 * felt_n.z) << "and as firmly as when it is only touched";
}

TEST(ClayScene, UsesThePointForceWhenAsked) {
  ClaySceneOptions options = ball_options();
  options.method = ForceMethod::point;
  Rig rig(options);
  const ForceTool tool = ball_tool(4.0, {0, 0, 1});
  rig.publisher.publish(plane({0, 0, 1}), tool);
  const HandleState handle = clay_handle_at(tool.position_mm, 0.0);
  rig.scene.begin_tick(handle);
  rig.scene.end_tick(handle);
  EXPECT_EQ(rig.scene.force_at(handle).force_n,
            point_force(rig.scene.window().view(), tool, {}).contact_n);
}

/// The same samples at 1 kHz and 4 kHz; an edge of is_active comes at once.
TEST(ClayScene, TellsTheClayOnItsOwnPeriod) {
  std::vector<std::vector<ToolSample>> heard;
  for (const int rate : {1000, 4000}) {
    Rig rig;
    for (int tick = 0; tick <= rate / 10; ++tick) {
      const double t = static_cast<double>(tick) / rate;
      rig.scene.begin_tick(clay_handle_at({t, 0, 1}, t, t >= 0.0419));
      rig.scene.end_tick(clay_handle_at({t, 0, 1}, t, t >= 0.0419));
    }
    heard.push_back(rig.taken());
    EXPECT_EQ(rig.scene.samples(), 22U) << rate;  // 0, 5 ... 100 ms and the edge
    EXPECT_EQ(rig.scene.dropped(), 0U);
  }
  ASSERT_EQ(heard[0].size(), heard[1].size());
  for (std::size_t n = 0; n < heard[0].size(); ++n) {
    EXPECT_EQ(heard[0][n].index, n + 1);
    EXPECT_NEAR(heard[0][n].time_s, heard[1][n].time_s, 1e-12);
    EXPECT_EQ(heard[0][n].is_active, heard[1][n].is_active);
  }
  const ToolSample& edge = heard[0][9];
  EXPECT_TRUE(edge.is_active);
  EXPECT_FALSE(heard[0][8].is_active);
  EXPECT_NEAR(edge.time_s, 0.042, 1e-12);
  const Lattice lattice = choose_lattice(ball_tool(4.0, {}));
  EXPECT_EQ(edge.voxel_mm, lattice.voxel_mm);
  EXPECT_EQ(edge.reach_mm, window_reach_mm(ball_tool(4.0, {}), lattice, 4.0));
}

TEST(ClayScene, TellsHowOldTheClayIsThatIsFelt) {
  Rig rig;
  const ForceTool tool = ball_tool(4.0, {0, 0, 1});
  const auto age_at = [&](double time_s) {
    const HandleState handle = clay_handle_at(tool.position_mm, time_s);
    rig.scene.begin_tick(handle);
    rig.scene.end_tick(handle);
    return rig.scene.window_stamp().age_s;
  };
  const auto publish = [&](std::uint64_t answers, double time_s) {
    rig.publisher.publish(plane({0, 0, 1}), tool, 4.0, answers, time_s);
  };
  publish(0, 0.0);
  EXPECT_LT(age_at(0.0), 0.0) << "nothing was asked yet";
  EXPECT_LT(age_at(0.005), 0.0);
  publish(1, 0.0);
  EXPECT_DOUBLE_EQ(age_at(0.007), 0.007);
  EXPECT_DOUBLE_EQ(age_at(0.012), 0.012);
  publish(2, 0.005);
  EXPECT_DOUBLE_EQ(age_at(0.013), 0.008);
  // Of a clock that went back an older answer says nothing.
  EXPECT_LT(age_at(0.001), 0.0);
  EXPECT_LT(age_at(0.006), 0.0);
  publish(rig.scene.samples(), 0.001);
  EXPECT_DOUBLE_EQ(age_at(0.009), 0.008);
}

/// Where the hand works, what it does is felt late; unless the scene takes its cuts out itself.
TEST(ClayScene, TellsHowLateItsWorkIsFelt) {
  for (const double own_cut_mm : {0.0, 4.0}) {
    ClaySceneOptions options = ball_options();
    options.own_cut_mm = own_cut_mm;
    Rig rig(options);
    const ForceTool tool = ball_tool(4.0, {0, 0, 1});
    rig.publisher.publish(plane({0, 0, 1}), tool);
    double lateness_s = 0.0;
    const auto feel = [&](double time_s, bool is_active) {
      const HandleState handle = clay_handle_at(tool.position_mm, time_s, is_active);
      rig.scene.begin_tick(handle);
      lateness_s = rig.scene.window_stamp().lateness_s;
      rig.scene.end_tick(handle);
    };
    feel(0.0, false);
    rig.publisher.publish(plane({0, 0, 1}), tool, 4.0, 1, 0.0);
    feel(0.030, false);
    EXPECT_EQ(lateness_s, 0.0);
    feel(0.035, true);
    feel(0.040, true);
    // Half a sample, the age, half the blend.
    EXPECT_NEAR(lateness_s, own_cut_mm > 0.0 ? 0.0 : 0.0025 + 0.040 + 0.0025, 1e-12);
  }
}

/// A hand that moves fast on late clay gets a window that holds it until the next one has come, and
/// the usual one again when it rests.
TEST(ClayScene, AsksForAWindowThatHoldsTheToolAtItsSpeed) {
  Rig rig;
  const Lattice lattice = choose_lattice(ball_tool(4.0, {}));
  const double usual_mm = window_reach_mm(ball_tool(4.0, {}), lattice, 4.0);
  const auto reach_at_the_end = [&](double speed_mm_per_s, double from_s) {
    for (int tick = 0; tick < 400; ++tick) {
      HandleState handle = clay_handle_at({0, 0, 20}, from_s + 1e-3 * tick);
      handle.velocity_mm_per_s = {speed_mm_per_s, 0, 0};
      // Answered 100 ms late.
      rig.publisher.publish(plane({0, 0, 1}), ball_tool(4.0, {0, 0, 20}), 4.0, rig.scene.samples(),
                            handle.time_s - 0.1);
      rig.scene.begin_tick(handle);
      rig.scene.end_tick(handle);
    }
    return rig.taken().back().reach_mm;
  };
  EXPECT_DOUBLE_EQ(reach_at_the_end(0.0, 0.0), usual_mm);
  const double fast_mm = reach_at_the_end(80.0, 0.4);
  EXPECT_GE(fast_mm - usual_mm, 80.0 * 0.105 - 4.0);
  EXPECT_LE(fast_mm - usual_mm, 80.0 * 0.112 - 4.0 + lattice.voxel_mm);
  EXPECT_DOUBLE_EQ(reach_at_the_end(0.0, 0.8), usual_mm);
}

TEST(ClayScene, CallsTheWindowStaleByItsOldestUnansweredSample) {
  Rig rig;
  const ForceTool tool = ball_tool(4.0, {0, 0, 1});
  const auto faults_at = [&](double time_s) {
    const HandleState handle = clay_handle_at(tool.position_mm, time_s);
    rig.scene.begin_tick(handle);
    rig.scene.end_tick(handle);
    return rig.scene.force_at(handle).faults;
  };
  const auto publish = [&](std::uint64_t answers, double time_s) {
    rig.publisher.publish(plane({0, 0, 1}), tool, 4.0, answers, time_s);
  };
  publish(0, 0.0);
  for (int i = 0; i <= 20; ++i) EXPECT_EQ(faults_at(0.005 * i), 0U) << i;
  EXPECT_EQ(faults_at(0.105), static_cast<std::uint32_t>(kSceneWindowStale));
  publish(10, 0.045);
  EXPECT_EQ(faults_at(0.110), 0U);
  EXPECT_EQ(faults_at(0.150), static_cast<std::uint32_t>(kSceneWindowStale));
  publish(rig.scene.samples(), 0.150);
  EXPECT_EQ(faults_at(5.0), 0U) << "a servo that paused finds nothing unanswered";
  EXPECT_EQ(faults_at(5.05), 0U);
}

/// A clock that went back, as the servo tells it: samples and answers go on at once, and the stroke
/// that was open ends.
TEST(ClayScene, StartsAnewWhereTheServoForgetsItsMotion) {
  Rig rig;
  const ForceTool tool = ball_tool(4.0, {0, 0, 1});
  rig.publisher.publish(plane({0, 0, 1}), tool, 4.0, 0, 0.0);
  const auto faults_at = [&](double time_s) {
    const HandleState handle = clay_handle_at(tool.position_mm, time_s, true);
    rig.scene.begin_tick(handle);
    rig.scene.end_tick(handle);
    return rig.scene.force_at(handle).faults;
  };
  EXPECT_EQ(faults_at(10.000), 0U);
  EXPECT_EQ(faults_at(10.005), 0U);
  for (const ToolSample& sample : rig.taken()) EXPECT_TRUE(sample.is_active);
  rig.scene.forget_motion();
  for (int i = 0; i < 20; ++i) EXPECT_EQ(faults_at(1.0 + 0.005 * i), 0U) << i;
  const std::vector<ToolSample> after = rig.taken();
  ASSERT_EQ(after.size(), 20U);
  EXPECT_FALSE(after[0].is_active);
  EXPECT_TRUE(after[1].is_active);
  EXPECT_DOUBLE_EQ(after[0].time_s, 1.0);
  // An answer to what was asked by the old clock says nothing of the age.
  rig.publisher.publish(plane({0, 0, 1}), tool, 4.0, 2, 10.005);
  EXPECT_EQ(faults_at(1.105), static_cast<std::uint32_t>(kSceneWindowStale));
}

/// Replugged or held up, a clay that does not answer is no fresher than before.
TEST(ClayScene, KeepsTheAgeOfWhatIsUnansweredWhereOnlyTheHandWasLost) {
  Rig rig;
  const ForceTool tool = ball_tool(4.0, {0, 0, 1});
  rig.publisher.publish(plane({0, 0, 1}), tool, 4.0, 0, 0.0);
  std::uint32_t faults = 0;
  for (int tick = 0; tick <= 200; ++tick) {
    rig.scene.forget_motion();
    const HandleState handle = clay_handle_at(tool.position_mm, 1e-3 * tick);
    rig.scene.begin_tick(handle);
    rig.scene.end_tick(handle);
    faults = rig.scene.force_at(handle).faults;
  }
  EXPECT_EQ(faults, static_cast<std::uint32_t>(kSceneWindowStale));
  EXPECT_EQ(rig.scene.samples(), 41U);
}

/// The sample that ends a stroke is told again while the ring is full.
TEST(ClayScene, EndsTheStrokeEvenWhenTheRingWasFull) {
  Rig rig(ball_options(), 2);
  for (int i = 0; i < 6; ++i) {
    if (i == 2) rig.scene.forget_motion();
    const HandleState handle = clay_handle_at({0, 0, 1}, 0.005 * i, true);
    rig.scene.begin_tick(handle);
    rig.scene.end_tick(handle);
    if (i == 3) rig.taken();
  }
  const std::vector<ToolSample> samples = rig.taken();
  ASSERT_EQ(samples.size(), 2U);
  EXPECT_FALSE(samples[0].is_active);
  EXPECT_EQ(samples[0].pressure, 0.0);
  EXPECT_TRUE(samples[1].is_active);
}

/// Of tools so small that 4 mm are more than a window holds, and of long ones: what fits.
TEST(ClayScene, AsksForNoLargerWindowThanTheServoReads) {
  for (const Vec3& radii : {Vec3{0.1, 0.1, 0.1}, Vec3{0.5, 0.5, 0.5}, Vec3{12.0, 2.0, 2.0}}) {
    ClaySceneOptions options = ball_options();
    options.tool.radii_mm = radii;
    Rig rig(options);
    rig.scene.begin_tick(clay_handle_at({}, 0.0));
    rig.scene.end_tick(clay_handle_at({}, 0.0));
    const std::vector<ToolSample> samples = rig.taken();
    ASSERT_EQ(samples.size(), 1U);
    const Lattice lattice = choose_lattice(options.tool);
    EXPECT_LE(samples[0].reach_mm, kMostWindowReachVoxels * lattice.voxel_mm);
    EXPECT_GE(samples[0].reach_mm, window_reach_mm(options.tool, lattice, 0.0));
  }
}

TEST(ClayScene, CountsWhatAFullRingDropsWithoutAFault) {
  Rig rig(ball_options(), 4);
  const ForceTool tool = ball_tool(4.0, {0, 0, 1});
  std::uint32_t faults = 0;
  for (int i = 0; i < 10; ++i) {
    rig.publisher.publish(plane({0, 0, 1}), tool, 4.0, rig.scene.samples(), 0.005 * (i - 1));
    const HandleState handle = clay_handle_at(tool.position_mm, 0.005 * i);
    rig.scene.begin_tick(handle);
    rig.scene.end_tick(handle);
    faults |= rig.scene.force_at(handle).faults;
  }
  EXPECT_EQ(rig.scene.dropped(), 6U);
  EXPECT_EQ(rig.scene.samples(), 10U);
  EXPECT_EQ(faults, 0U);
  EXPECT_EQ(rig.taken().size(), 4U);
}

TEST(ClayScene, SeesThatTheClayStopped) {
  ClayHeartbeat heartbeat;
  ClaySceneOptions options = ball_options();
  options.heartbeat = &heartbeat;
  Rig rig(options);
  const ForceTool tool = ball_tool(4.0, {0, 0, 1});
  rig.publisher.publish(plane({0, 0, 1}), tool);
  const HandleState handle = clay_handle_at(tool.position_mm, 0.0);
  heartbeat.alive = true;
  rig.scene.begin_tick(handle);
  rig.scene.end_tick(handle);
  EXPECT_EQ(rig.scene.force_at(handle).faults, 0U);
  heartbeat.alive = false;
  rig.scene.begin_tick(handle);
  rig.scene.end_tick(handle);
  EXPECT_EQ(rig.scene.force_at(handle).faults, static_cast<std::uint32_t>(kSceneClayStopped));
}

TEST(ClayScene, SaysWhenTheToolHasLeftTheWindow) {
  Rig rig;
  rig.publisher.publish(plane({0, 0, 1}), ball_tool(4.0, {0, 0, 1}));
  const HandleState far = clay_handle_at({100, 0, 1}, 0.0);
  rig.scene.begin_tick(far);
  rig.scene.end_tick(far);
  EXPECT_EQ(rig.scene.force_at(far).faults, static_cast<std::uint32_t>(kSceneOutsideWindow));
}

/// Fine windows are what a small tool has, and each of their millimetres costs much.
TEST(ClayScene, AsksForADiameterMoreThanItsTool) {
  for (const auto& [radius_mm, margin_mm] :
       {std::pair{0.7, 1.4}, {1.0, 2.0}, {4.0, 4.0}, {16.0, 4.0}}) {
    const ClaySceneOptions options = ball_options(radius_mm);
    Rig rig(options);
    HandleState rest;
    rig.scene.begin_tick(rest);
    rig.scene.end_tick(rest);
    ToolSample sample;
    ASSERT_TRUE(rig.ring.pop(sample));
    EXPECT_NEAR(sample.reach_mm,
                window_reach_mm(options.tool, choose_lattice(options.tool), margin_mm), 1e-12)
        << "R = " << radius_mm << " mm";
  }
}

/// Under the thread sanitizer: samples go one way and windows the other, while the heartbeat is
/// read.
TEST(ClaySceneStress, TalksToAnotherThread) {
  ClayHeartbeat heartbeat;
  heartbeat.alive = true;
  ClaySceneOptions options = ball_options(2.0);
  options.heartbeat = &heartbeat;
  options.margin_mm = 1.0;
  Rig rig(options);
  std::atomic<bool> done = false;
  std::uint64_t last = 0;
  bool in_order = true;
  std::thread clay([&] {
    ToolSample sample;
    while (!done) {
      if (!rig.ring.pop(sample)) continue;
      in_order = in_order && sample.index > last;
      last = sample.index;
      rig.publisher.publish(plane({0, 0, 1}), ball_tool(2.0, sample.position_mm), 1.0, sample.index,
                            sample.time_s);
      heartbeat.beats.fetch_add(1, std::memory_order_relaxed);
    }
    heartbeat.alive = false;
  });
  bool finite = true;
  int tick = 0;
  const int ticks = test::effort(6'000, 20'000);
  for (; tick < ticks || rig.scene.window().sequence < 20; ++tick) {
    const HandleState handle = clay_handle_at({0, 0, std::sin(1e-3 * tick)}, 1e-3 * tick);
    rig.scene.begin_tick(handle);
    rig.scene.end_tick(handle);
    finite = finite && is_finite(rig.scene.force_at(handle).force_n);
  }
  done = true;
  clay.join();
  EXPECT_TRUE(finite);
  EXPECT_TRUE(in_order);
  const HandleState handle = clay_handle_at({}, 1e-3 * tick);
  rig.scene.begin_tick(handle);
  rig.scene.end_tick(handle);
  EXPECT_NE(rig.scene.force_at(handle).faults & kSceneClayStopped, 0U);
}

}  // namespace
}  // namespace argil::haptics
