// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/rig/rig.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "argil/haptics/analysis/hold_test.h"
#include "argil/haptics/scene/scene_catalogue.h"
#include "argil/haptics/scene/scene_wall.h"

#include "haptics/force/analytic_publisher.h"
#include "haptics/force/fields.h"
#include "support/scratch.h"

namespace argil::haptics {
namespace {

constexpr double kBallMm = 30.0;

/// Stands for the clay's thread: answers samples with windows of a ball of clay.
class BallOfClay {
 public:
  explicit BallOfClay(HapticRig& rig) : rig_(rig), publisher_(rig.channel()) {
    heartbeat.alive = true;
    thread_ = std::thread(&BallOfClay::run, this);
  }
  ~BallOfClay() {
    stop_ = true;
    thread_.join();
  }
  ClayHeartbeat heartbeat;
  std::atomic<bool> is_open = false;  ///< a stroke
  std::atomic<bool> wants_detail = false;

 private:
  void run() {
    while (!stop_) {
      ToolSample sample;
      bool has_sample = false;
      while (rig_.ring().pop(sample)) {
        has_sample = true;
        is_open = sample.is_active;
        wants_detail = sample.wants_detail;
      }
      if (has_sample) {
        publisher_.publish(fields::ball(kBallMm), fields::ball_tool(4.0, sample.position_mm), 4.0,
                           sample.index, sample.time_s);
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }
  HapticRig& rig_;
  fields::AnalyticPublisher publisher_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

/// The device's 0 on the top of the ball.
RigOptions on_the_ball(double scale = 1.0) {
  RigOptions options;
  options.placement = {scale, {0.0, kBallMm, 0.0}};
  options.start_mm = {0.0, 20.0 / scale, 0.0};
  return options;
}

/// Looks until it is so; false when it is not within many seconds, whatever the machine does.
bool until(HapticRig& rig, const std::function<bool(const RigSnapshot&)>& is_so) {
  for (int n = 0; n < 20'000; ++n) {
    if (is_so(rig.look())) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}
/// After late ticks the hand is softer for a while.
bool until_pushed(HapticRig& rig) {
  return until(rig, [](const RigSnapshot& now) { return now.tick.force_n.y > 0.8; });
}
/// And near the surface: late ticks and late clay let it sink deeper for a while.
bool until_held(HapticRig& rig, double depth_mm) {
  return until(rig, [=](const RigSnapshot& now) {
    return now.tick.force_n.y > 0.8 && std::abs(now.tool_mm.y - kBallMm) < depth_mm;
  });
}
bool until_ticks_pass(HapticRig& rig, std::uint64_t ticks) {
  const std::uint64_t from = rig.look().tick.number;
  return until(rig, [&](const RigSnapshot& now) { return now.tick.number >= from + ticks; });
}

/// Once the servo has ramped in: from `from_mm` down to a height, slowly enough for the clay to
/// follow on any machine. A hand that goes faster passes through what it does not feel yet.
bool press_rig(HapticRig& rig, const Vec3& from_mm, double to_y_mm) {
  if (!until(rig, [](const RigSnapshot& now) { return now.tick.time_s > 0.6; })) return false;
  constexpr int kSteps = 60;
  for (int n = 1; n <= kSteps; ++n) {
    Vec3 place = from_mm;
    place.y += (to_y_mm - from_mm.y) * n / kSteps;
    rig.lead({place});
    if (!until_ticks_pass(rig, 25)) return false;
  }
  const double from_s = rig.look().tick.time_s;
  return until(rig, [=](const RigSnapshot& now) {
    return now.tick.time_s > from_s + 0.3 && length(now.tick.velocity_mm_per_s) < 0.5 &&
           now.tick.force_n.y > 0.5;
  });
}

#define ASSERT_SUCCESS(result)                            \
  do {                                                    \
    const auto outcome = (result);                        \
    ASSERT_TRUE(outcome.ok()) << outcome.error().message; \
  } while (false)

TEST(HapticRig, FeelsTheClayThatTheHandIsLedInto) {
  HapticRig rig;
  BallOfClay clay(rig);
  RigOptions options = on_the_ball();
  options.heartbeat = &clay.heartbeat;
  ASSERT_SUCCESS(rig.start(options));
  EXPECT_TRUE(rig.is_running());
  ASSERT_TRUE(press_rig(rig, options.start_mm, -20.0));
  EXPECT_TRUE(until_held(rig, 8.0));
  const RigSnapshot& now = rig.look();
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  constexpr double kLeast = 10.0;  // a late servo holds less: some 45 N/m
#else
  constexpr double kLeast = 50.0;
#endif
  EXPECT_GT(now.tick.most_stiffness_n_per_m, kLeast);
  EXPECT_LT(now.tick.most_stiffness_n_per_m, 1950.0);
  EXPECT_GT(now.lateness.count(), 0U);
  ASSERT_SUCCESS(rig.stop());
  EXPECT_EQ(rig.look().tick.force_n, Vec3{});
  EXPECT_NE(rig.look().tick.faults & kStopping, 0U);
  ASSERT_SUCCESS(rig.stop());
}

TEST(HapticRig, KeepsTheLastFiveSecondsOfPoints) {
  HapticRig rig;
  RigOptions options;
  options.scene = "spring";
  options.period_s = 2.5e-4;
  options.start_mm = {5.0, 0.0, 0.0};
  ASSERT_SUCCESS(rig.start(options));
  ASSERT_TRUE(until(rig, [](const RigSnapshot& now) { return now.tick.time_s > 5.5; }));
  const auto& points = rig.points();
  ASSERT_GT(points.size(), 10U);
  EXPECT_LE(points.size(), 512U);
  EXPECT_LE(points.back().time_s - points.front().time_s, HapticRig::kPlottedS);
  for (std::size_t n = 1; n < points.size(); ++n) {
    EXPECT_GT(points[n].time_s, points[n - 1].time_s);
    EXPECT_GT(points[n].rate_hz, 0.0);
    EXPECT_LE(points[n].rate_hz, 4.0e4);
  }
}

TEST(HapticRig, HaltsAtOnceAndResumesGently) {
  HapticRig rig;
  BallOfClay clay(rig);
  ASSERT_SUCCESS(rig.start(on_the_ball()));
  ASSERT_TRUE(press_rig(rig, on_the_ball().start_mm, -20.0));
  test::ScratchFolder folder;
  ASSERT_SUCCESS(rig.start_recording(folder / "halt.csv", "halt"));
  ASSERT_TRUE(until_ticks_pass(rig, 30));
  rig.halt();
  EXPECT_TRUE(rig.is_halted());
  ASSERT_TRUE(until_ticks_pass(rig, 100));
  EXPECT_EQ(rig.look().tick.force_n, Vec3{});
  EXPECT_NE(rig.look().tick.faults & kHalted, 0U);
  rig.resume();
  ASSERT_TRUE(until_pushed(rig));
  ASSERT_SUCCESS(rig.stop_recording());
  const auto recording = read_recording(folder / "halt.csv");
  ASSERT_TRUE(recording.ok()) << recording.error().message;
  const std::vector<ServoTick>& ticks = recording.value().ticks;
  EXPECT_EQ(ticks.front().number, 1U);
  bool was_halted = false;
  for (std::size_t n = 1; n < ticks.size(); ++n) {
    const bool is_halted = (ticks[n].faults & kHalted) != 0;
    if (is_halted) {
      EXPECT_EQ(ticks[n].force_n, Vec3{}) << n;
    } else if (was_halted) {
      EXPECT_LE(length(ticks[n].force_n), 0.5);
    }
    was_halted = is_halted;
  }
}

TEST(HapticRig, StaysHaltedOverAStart) {
  HapticRig rig;
  RigOptions options;
  options.scene = "spring";
  options.start_mm = {20.0, 0.0, 0.0};
  rig.halt();
  ASSERT_SUCCESS(rig.start(options));
  ASSERT_TRUE(until_ticks_pass(rig, 50));
  ASSERT_SUCCESS(rig.start(options));
  ASSERT_TRUE(until_ticks_pass(rig, 50));
  EXPECT_EQ(rig.look().tick.force_n, Vec3{});
  for (const RigPoint& point : rig.points()) EXPECT_EQ(point.force_n, Vec3{});
  rig.resume();
  EXPECT_TRUE(until(rig, [](const RigSnapshot& now) { return now.tick.force_n.x < -1.0; }));
}

TEST(HapticRig, ClutchMovesTheHandleAndNotTheTool) {
  HapticRig rig;
  BallOfClay clay(rig);
  test::ScratchFolder folder;
  ASSERT_SUCCESS(rig.start(on_the_ball()));
  ASSERT_TRUE(press_rig(rig, on_the_ball().start_mm, -12.0));
  ASSERT_SUCCESS(rig.start_recording(folder / "clutch.csv", "clutch"));
  rig.set_clutched(true);
  ASSERT_TRUE(until(rig, [](const RigSnapshot& now) { return now.is_clutched; }));
  const Vec3 tool = rig.look().tool_mm;
  rig.lead({{15.0, 10.0, 0.0}});
  ASSERT_TRUE(until(rig, [](const RigSnapshot& now) {
    return now.tick.position_mm.x > 13.0 && length(now.tick.velocity_mm_per_s) < 0.5;
  }));
  EXPECT_EQ(rig.look().tick.force_n, Vec3{});
  EXPECT_EQ(rig.look().tool_mm, tool);
  rig.set_clutched(false);
  EXPECT_TRUE(until(rig, [](const RigSnapshot& now) { return now.tick.force_n.y > 0.2; }));
  const Placement placement = rig.look().placement;
  EXPECT_LT(placement.offset_mm.x, -10.0);
  ASSERT_SUCCESS(rig.stop_recording());
  const auto recording = read_recording(folder / "clutch.csv");
  ASSERT_TRUE(recording.ok()) << recording.error().message;
  const std::vector<ServoTick>& ticks = recording.value().ticks;
  for (std::size_t n = 1; n < ticks.size(); ++n) {
    // What the ramp out of 20 ms asks for, the faster of the two.
    const double elapsed_ms = 1e3 * (ticks[n].time_s - ticks[n - 1].time_s);
    EXPECT_LE(length(ticks[n].force_n - ticks[n - 1].force_n), 0.05 * 8.0 * elapsed_ms + 0.05);
    const bool was_clutched = (ticks[n - 1].faults & kClutched) != 0;
    if (!was_clutched || (ticks[n].faults & kClutched) != 0) continue;
    EXPECT_LE(length(placement.to_scene(ticks[n].position_mm) - tool), 1e-9);
    EXPECT_LE(length(ticks[n].force_n), 0.5);
  }
}

TEST(HapticRig, EndsTheStrokeWhenItStops) {
  HapticRig rig;
  BallOfClay clay(rig);
  ASSERT_SUCCESS(rig.start(on_the_ball()));
  rig.lead({{0.0, 0.0, 0.0}, true, true});
  ASSERT_TRUE(until(rig, [&](const RigSnapshot&) { return clay.is_open.load(); }));
  ASSERT_SUCCESS(rig.stop());
  EXPECT_TRUE(until(rig, [&](const RigSnapshot&) { return !clay.is_open; }));
}

TEST(HapticRig, KnowsAtOnceWhetherItHasPriority) {
  HapticRig rig;
  RigOptions options;
  options.scene = "workspace";
  ASSERT_SUCCESS(rig.start(options));
  const std::string refusal = rig.priority_refusal();
  if (!refusal.empty()) {
    EXPECT_NE(refusal.find("/etc/security/limits.d"), std::string::npos) << refusal;
  }
  EXPECT_TRUE(until_ticks_pass(rig, 10));  // it runs in either case
}

TEST(HapticRig, ScaledClayIsFeltAtScaledPlaces) {
  HapticRig rig;
  BallOfClay clay(rig);
  ASSERT_SUCCESS(rig.start(on_the_ball(2.0)));
  ASSERT_TRUE(press_rig(rig, on_the_ball(2.0).start_mm, -15.0));
  ASSERT_TRUE(until_held(rig, 10.0));
  const RigSnapshot& now = rig.look();
  EXPECT_NEAR(now.tool_mm.y, kBallMm + 2.0 * now.tick.proxy_mm.y, 1e-9);
}

TEST(HapticRig, StartsAnotherDeviceSceneOrToolWhileTheClayGoesOn) {
  HapticRig rig;
  BallOfClay clay(rig);
  test::ScratchFolder folder;
  RigOptions sim = on_the_ball();
  sim.heartbeat = &clay.heartbeat;
  ASSERT_SUCCESS(rig.start(sim));
  rig.lead({{0.0, 10.0, 0.0}, true, true});
  ASSERT_SUCCESS(rig.start_recording(folder / "run.csv", "a ball"));
  ASSERT_TRUE(until_ticks_pass(rig, 300));
  EXPECT_TRUE(rig.is_recording());

  RigOptions replay = sim;
  replay.device = RigDevice::replay;
  replay.replay_file = folder / "missing.csv";
  EXPECT_FALSE(rig.start(replay).ok());
  EXPECT_TRUE(rig.is_running());  // as before
  EXPECT_TRUE(rig.is_recording());
  ASSERT_SUCCESS(rig.stop_recording());
  replay.replay_file = folder / "run.csv";
  ASSERT_SUCCESS(rig.start(replay));
  ASSERT_TRUE(until(rig, [&](const RigSnapshot&) { return rig.is_replay_over(); }));

  RigOptions other = sim;
  other.hand = Hand::firm;
  ASSERT_SUCCESS(rig.start(other));
  EXPECT_FALSE(rig.is_replay_over());
  ASSERT_TRUE(press_rig(rig, other.start_mm, 0.0));

  RigOptions sphere;
  sphere.scene = "sphere";
  sphere.start_mm = {0.0, 55.0, 0.0};
  ASSERT_SUCCESS(rig.start(sphere));
  ASSERT_TRUE(press_rig(rig, sphere.start_mm, 35.0));
}

TEST(HapticRig, RecordsAsLongAsItIsTold) {
  HapticRig rig;
  test::ScratchFolder folder;
  EXPECT_FALSE(rig.start_recording(folder / "none.csv", "nothing runs").ok());
  RigOptions options;
  options.scene = "workspace";
  ASSERT_SUCCESS(rig.start(options));
  for (const char* name : {"a.csv", "b.csv"}) {
    ASSERT_TRUE(until_ticks_pass(rig, 20));
    ASSERT_SUCCESS(rig.start_recording(folder / name, "a part"));
    EXPECT_FALSE(rig.start_recording(folder / "c.csv", "twice").ok());
    ASSERT_TRUE(until_ticks_pass(rig, 50));
    if (std::string(name) == "a.csv") {
      ASSERT_SUCCESS(rig.stop_recording());
    } else {
      ASSERT_SUCCESS(rig.stop());
    }
    EXPECT_FALSE(rig.is_recording());
    const auto recording = read_recording(folder / name);
    ASSERT_TRUE(recording.ok()) << recording.error().message;
    EXPECT_GE(recording.value().ticks.size(), 20U);
  }
  ASSERT_SUCCESS(rig.stop_recording());
}

/// A wall that cycled, given again: the positions swing whatever the rig does.
TEST(HapticRig, DampsASwingWhenItIsAskedTo) {
  test::ScratchFolder folder;
  HoldTest swing;
  swing.device = frictionless_falcon();
  swing.hand = hand_model(Hand::push);
  swing.servo = bare_servo(1e-3);
  swing.plan = press_plan({0.0, -21.0, 0.0}, {0.0, -1.0, 0.0}, 3.0);
  WallOptions wall_options;
  wall_options.stiffness_n_per_m = 3000.0;
  wall_options.damping_n_s_per_m = 0.0;
  WallScene wall(wall_options);
  HoldTestResult run = run_hold_test(wall, swing);
  ASSERT_EQ(run.judgement.verdict, Verdict::limit_cycle);
  RigOptions options;
  options.replay_file = folder / "swing.csv";
  ASSERT_SUCCESS(write_recording(options.replay_file, {"a swing", std::move(run.ticks)}));
  options.device = RigDevice::replay;
  options.scene = "wall-linear";
  options.scene_settings = {{"k", 3000.0}, {"c", 0.0}};
  options.coupling = CouplingKind::direct;
  HapticRig rig;
  for (const DampingKind damping : {DampingKind::fixed, DampingKind::adaptive}) {
    options.damping = damping;
    ASSERT_SUCCESS(rig.start(options));
    double most = 0.0;
    EXPECT_TRUE(until(rig, [&](const RigSnapshot& now) {
      most = std::max(most, now.tick.added_damping_n_s_per_m);
      return now.tick.number > 1500 || most > 1.0;
    }));
    EXPECT_EQ(most > 1.0, damping == DampingKind::adaptive);
  }
}

TEST(HapticRig, AsksForTheDetailThatItsTextureIsMadeOf) {
  for (const bool has_vibro : {false, true}) {
    HapticRig rig;
    BallOfClay clay(rig);
    RigOptions options = on_the_ball();
    options.has_vibro = has_vibro;
    ASSERT_SUCCESS(rig.start(options));
    ASSERT_TRUE(until_ticks_pass(rig, 50));
    ASSERT_SUCCESS(rig.stop());
    EXPECT_EQ(clay.wants_detail, has_vibro);
  }
}

/// Under the thread sanitizer, with a window that looks and a hand that is led all the while.
TEST(HapticRigStress, StartsAndStopsFiftyTimes) {
  HapticRig rig;
  BallOfClay clay(rig);
  for (int n = 0; n < 50; ++n) {
    RigOptions options = on_the_ball(n % 3 == 0 ? 2.0 : 1.0);
    if (n % 5 == 4) {
      options = {};
      options.scene = scene_catalogue()[static_cast<std::size_t>(n / 5)].name;
    }
    options.heartbeat = &clay.heartbeat;
    ASSERT_SUCCESS(rig.start(options));
    for (int look = 0; look < 10; ++look) {
      rig.lead({{0.0, 10.0 - 3.0 * look, 0.0}, true, look % 3 == 0});
      rig.set_clutched(look % 4 == 1);
      if (look == 5) rig.halt();
      if (look == 6) rig.resume();
      EXPECT_TRUE(is_finite(rig.look().tick.force_n));
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    if (n % 2 == 0) {
      ASSERT_SUCCESS(rig.stop());
    }
  }
}

TEST(HapticRigOptions, RefusesWhatIsOutOfRangeAndNamesIt) {
  struct Wrong {
    const char* named;
    std::function<void(RigOptions&)> make;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Wrong all[] = {
      {"period", [](RigOptions& o) { o.period_s = 1e-4; }},
      {"coupling stiffness", [](RigOptions& o) { o.coupling_stiffness_n_per_m = 10.0; }},
      {"coupling stiffness", [](RigOptions& o) { o.coupling_stiffness_n_per_m = 1e4; }},
      {"hand", [](RigOptions& o) { o.hand = Hand::push; }},
      {"start y", [](RigOptions& o) { o.start_mm.y = 81.0; }},
      {"recording", [](RigOptions& o) { o.device = RigDevice::replay; }},
      {"device", [](RigOptions& o) { o.device = static_cast<RigDevice>(7); }},
      {"scene", [](RigOptions& o) { o.scene = "marble"; }},
      {"R", [](RigOptions& o) { o.scene = "sphere", o.scene_settings["R"] = 4.0; }},
      {"'q'", [](RigOptions& o) { o.scene = "sphere", o.scene_settings["q"] = 4.0; }},
      {"'k'", [](RigOptions& o) { o.scene_settings["k"] = 4.0; }},
      {"scale", [](RigOptions& o) { o.scene = "sphere", o.placement.scale = 2.0; }},
      {"turn", [](RigOptions& o) { o.scene = "sphere", o.placement.is_z_up = true; }},
      {"scale", [](RigOptions& o) { o.placement.scale = 0.0; }},
      {"place", [=](RigOptions& o) { o.placement.offset_mm.x = nan; }},
      {"radius", [](RigOptions& o) { o.tool.radii_mm.z = 0.0; }},
      {"capsule",
       [](RigOptions& o) {
         o.tool = {ToolShape::capsule, {4, 4, 3}, {}, {}, {}, {}};
       }},
      {"orientation", [](RigOptions& o) { o.tool.orientation.w = 2.0; }},
      {"surface force", [](RigOptions& o) { o.material.surface_force_n = 9.0; }},
      {"exponent", [](RigOptions& o) { o.material.exponent = 0.5; }},
      {"skin", [=](RigOptions& o) { o.material.skin_mm = nan; }},
      {"clamp", [](RigOptions& o) { o.material.clamp_ratio = 1.0; }},
      {"viscosity force", [](RigOptions& o) { o.material.viscosity_force_n = -1.0; }},
      {"viscosity rate", [](RigOptions& o) { o.material.viscosity_s_per_mm = 2.0; }},
      {"path", [](RigOptions& o) { o.guidance.kind = GuidanceKind::direct; }},
      {"guidance's stiffness",
       [](RigOptions& o) {
         o.guidance.kind = GuidanceKind::hybrid;
         o.guidance.path_mm = {{}};
         o.guidance.stiffness_n_per_m = -60.0;
       }},
  };
  HapticRig rig;
  for (const Wrong& wrong : all) {
    RigOptions options;
    ASSERT_TRUE(check_rig(options).ok());
    wrong.make(options);
    const Result<void> checked = rig.start(options);
    ASSERT_FALSE(checked.ok()) << wrong.named;
    EXPECT_EQ(checked.error().kind, ErrorKind::bad_input);
    EXPECT_NE(checked.error().message.find(wrong.named), std::string::npos)
        << checked.error().message;
    EXPECT_FALSE(rig.is_running());
  }
}

/// Beside a path in the air over the clay: the hand is drawn there, by mm of the hand.
TEST(HapticRig, GuidesTheHandAlongAPathOnTheClay) {
  HapticRig rig;
  BallOfClay clay(rig);
  RigOptions options = on_the_ball(2.0);
  options.heartbeat = &clay.heartbeat;
  options.guidance.kind = GuidanceKind::direct;
  // 20 mm of the clay and 10 mm of the hand to the right of where it begins.
  options.guidance.path_mm = {{20.0, kBallMm + 20.0, -50.0}, {20.0, kBallMm + 20.0, 50.0}};
  ASSERT_TRUE(rig.start(options).ok());
  ASSERT_TRUE(until(rig, [](const RigSnapshot& now) { return now.tick.force_n.x > 0.2; }));
  const RigSnapshot& seen = rig.look();
  EXPECT_LE(seen.guidance.distance_mm, 10.1);
  EXPECT_GT(seen.guidance.distance_mm, 3.0) << "an arm is stiffer than its guide";
  EXPECT_EQ(seen.guidance.share, 1.0);
  EXPECT_GT(seen.tick.aid_n.x, 0.2);
}

TEST(HapticRigOptions, CouplesSoftMaterialOnlyDirectly) {
  RigOptions options;
  options.coupling = CouplingKind::direct;
  EXPECT_TRUE(check_rig(options).ok());
  options.placement.scale = 2.0;  // 2450 N/m in the hand
  EXPECT_FALSE(check_rig(options).ok());
  options.material.skin_mm = 16.0;
  EXPECT_TRUE(check_rig(options).ok());
  options.coupling = CouplingKind::indirect;
  options.material.skin_mm = 1.0;
  EXPECT_TRUE(check_rig(options).ok());
}

/// The closed form is the steepest slope that a point feels.
TEST(HapticRigOptions, KnowsTheStiffestOfAMaterial) {
  for (const double exponent : {1.0, 2.0, 4.0}) {
    ForceMaterial material;
    material.exponent = exponent;
    ForceTool tool = fields::ball_tool(1.0, {});
    const fields::Window window = fields::sampled(fields::plane({0, 0, 1}), {}, 12.0, 0.5);
    double steepest = 0.0;
    double before = 0.0;
    for (int n = 0; n < 1000; ++n) {
      tool.position_mm.z = 8.0 - 0.016 * n;
      const double force = point_force(window.view, tool, material).contact_n.z;
      if (n > 0) steepest = std::max(steepest, (force - before) / 0.016);
      before = force;
    }
    EXPECT_NEAR(most_stiffness_n_per_m(material), 1e3 * steepest, 0.03e3 * steepest) << exponent;
  }
}

}  // namespace
}  // namespace argil::haptics
