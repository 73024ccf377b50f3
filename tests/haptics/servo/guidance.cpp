// SPDX-License-Identifier: GPL-3.0-or-later
// Guidance along a path: its law, its energy against an account of the test's own, and its loop.
#include "argil/haptics/servo/guidance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "argil/haptics/scene/scene_placed.h"
#include "argil/haptics/servo/guided_scene.h"

namespace argil::haptics {
namespace {

constexpr double kTickS = 1e-3;
constexpr std::array kKinds{GuidanceKind::direct, GuidanceKind::indirect, GuidanceKind::hybrid};

GuidanceOptions bent(GuidanceKind kind) {
  GuidanceOptions options;
  options.kind = kind;
  options.path_mm = {{-20.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 20.0, 0.0}};
  return options;
}

/// A tick of a hand that is where its tool is.
Vec3 follow(Guidance& guidance, const Vec3& at_mm, double given_part = 1.0, int delay_ticks = 1) {
  return guidance.tick(at_mm, {kTickS, given_part, at_mm, delay_ticks});
}

Vec3 felt_at(GuidanceKind kind, const Vec3& place_mm) {
  Guidance guidance(bent(kind));
  return follow(guidance, place_mm);
}

TEST(Guidance, FindsTheNearestPointOfThePath) {
  const auto path = bent(GuidanceKind::direct).path_mm;
  EXPECT_EQ(nearest_on_path(path, {-10.0, -3.0, 0.0}), (Vec3{-10.0, 0.0, 0.0}));
  EXPECT_EQ(nearest_on_path(path, {4.0, 12.0, 1.0}), (Vec3{0.0, 12.0, 0.0}));
  EXPECT_EQ(nearest_on_path(path, {0.0, 30.0, 0.0}), (Vec3{0.0, 20.0, 0.0}));
  EXPECT_EQ(nearest_on_path({}, {1.0, 2.0, 3.0}), (Vec3{1.0, 2.0, 3.0}));
  EXPECT_EQ(nearest_on_path({{1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}, {5.0, 0.0, 0.0}),
            (Vec3{1.0, 0.0, 0.0}))
      << "a side of no length is a point";
}

TEST(Guidance, YieldsToThePathOrHasToBeResisted) {
  const Vec3 off{-10.0, -5.0, 0.0};
  const Vec3 pull = felt_at(GuidanceKind::direct, off);
  EXPECT_NEAR(pull.y, 60.0 * 0.005, 1e-12);
  EXPECT_LT(length(felt_at(GuidanceKind::indirect, off) + pull), 1e-12);
  EXPECT_EQ(felt_at(GuidanceKind::none, off), Vec3{});
  EXPECT_LT(length(felt_at(GuidanceKind::hybrid, off)), 1e-3) << "it begins between the two";
  EXPECT_EQ(felt_at(GuidanceKind::direct, {-5.0, 0.0, 0.0}), Vec3{});
  const Vec3 far = felt_at(GuidanceKind::direct, {-10.0, -900.0, 0.0});
  EXPECT_NEAR(length(far), 1.5, 1e-12) << "a hand can always override it";
}

/// On a path that is scaled the hand feels what it would without: lengths are its own.
TEST(Guidance, IsTheSameInTheHandAtAnyScale) {
  for (const GuidanceKind kind : kKinds) {
    GuidanceOptions large = bent(kind);
    for (Vec3& point : large.path_mm) point *= 4.0;
    large.scale = 4.0;
    Guidance of_large(large);
    Guidance of_usual(bent(kind));
    for (int n = 0; n < 3000; ++n) {
      const Vec3 at{-10.0, 8.0 * std::sin(0.005 * n), 1.0};
      const Vec3 usual = follow(of_usual, at);
      EXPECT_LT(length(follow(of_large, 4.0 * at) - usual), 1e-9);
    }
    EXPECT_NEAR(of_large.state().given_mj, of_usual.state().given_mj, 1e-9);
  }
}

/// How hybrid stands after so long at a distance from the path.
GuidanceState after(double seconds, double off_mm) {
  GuidanceOptions options = bent(GuidanceKind::hybrid);
  Guidance guidance(options);
  const Vec3 at{-10.0, -off_mm, 0.0};
  for (int n = 0; n < static_cast<int>(seconds / kTickS); ++n) follow(guidance, at);
  return guidance.state();
}

TEST(Guidance, DrawsBackAHandThatStraysAndPushesOneThatFollows) {
  EXPECT_LT(after(5.0, 0.2).share, 0.1) << "follows well: pushed";
  EXPECT_GT(after(5.0, 8.0).share, 0.99) << "strays by more than the tolerance: pulled";
  const GuidanceState between = after(20.0, 1.0);
  EXPECT_GT(between.share, 0.2 - 1e-3) << "a fifth of the tolerance, and what the push costs";
  EXPECT_LT(between.share, 0.4);
  EXPECT_NEAR(between.error_mm, 1.0, 1e-3);
  EXPECT_GT(between.effort_n, 0.0);
}

/// A hand that keeps to the path only by holding off a strong push is relieved of it.
TEST(Guidance, RelievesAHandThatHasToWorkHard) {
  GuidanceOptions options = bent(GuidanceKind::hybrid);
  options.tolerance_mm = 1000.0;  // performance has no say
  options.effort_n = 0.1;
  Guidance guidance(options);
  const Vec3 at{-10.0, -6.0, 0.0};
  double least = 1.0;
  for (int n = 0; n < 20'000; ++n) {
    follow(guidance, at);
    least = std::min(least, guidance.state().share);
  }
  EXPECT_LT(least, 0.5) << "it was pushed";
  // Where the share that is sought is the one that is: s = 0.1 e with a push of 0.36 (1 - 2 s).
  const double effort_n = guidance.state().effort_n;
  EXPECT_NEAR(guidance.state().share, effort_n / 0.1 + 6e-3, 0.02);
  EXPECT_LT(effort_n, 0.1) << "and is pushed less than 0.36 N";
}

TEST(GuidanceProperty, ChangesItsShareNoFasterThanItMay) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-30.0, 30.0);
  GuidanceOptions options = bent(GuidanceKind::hybrid);
  options.most_change_per_s = 0.8;
  Guidance guidance(options);
  double before = guidance.state().share;
  for (int n = 0; n < 20'000; ++n) {
    const Vec3 at = n / 500 % 2 == 0 ? Vec3{} : Vec3{place(random), place(random), place(random)};
    follow(guidance, at);
    EXPECT_LE(std::abs(guidance.state().share - before), 0.8 * kTickS + 1e-12);
    before = guidance.state().share;
    EXPECT_GE(before, 0.0);
    EXPECT_LE(before, 1.0);
  }
}

/// A slow way round and back, through places that are equally near to two parts of the path.
TEST(Guidance, GainsNothingByAPullOnAWayRoundWhateverThePath) {
  GuidanceOptions options = bent(GuidanceKind::direct);
  options.most_given_mj = 1000.0;  // so that nothing fades
  Guidance guidance(options);
  double most_mj = 0.0;
  constexpr int kSteps = 200'000;
  for (int n = 0; n <= kSteps; ++n) {
    const double angle = 2.0 * std::numbers::pi * n / kSteps;
    const Vec3 at{-8.0 + 12.0 * std::cos(angle), 8.0 + 12.0 * std::sin(angle), 3.0};
    follow(guidance, at, 1.0, 0);
    most_mj = std::max(most_mj, std::abs(guidance.state().given_mj));
  }
  EXPECT_GT(most_mj, 1.0);
  EXPECT_LT(std::abs(guidance.state().given_mj), 2e-3);
}

/// A circle of 15 mm in so many sides.
std::vector<Vec3> loop_of(int sides) {
  std::vector<Vec3> path;
  for (int n = 0; n <= sides; ++n) {
    const double angle = 2.0 * std::numbers::pi * (n % sides) / sides;
    path.push_back({15.0 * std::cos(angle), 15.0 * std::sin(angle), 0.0});
  }
  return path;
}

/// Nothing in the middle, as much as ever near the path, and nowhere stiffer than a few times the
/// spring: it turns round nowhere.
TEST(Guidance, FadesAPushInTheMiddle) {
  for (const int sides : {6, 24, 120}) {
    GuidanceOptions options;
    options.kind = GuidanceKind::indirect;
    options.path_mm = loop_of(sides);
    Guidance guidance(options);
    const auto push_at = [&](const Vec3& at) { return follow(guidance, at, 0.0); };
    EXPECT_LT(length(push_at({})), 1e-9) << sides;
    const double apothem_mm = 15.0 * std::cos(std::numbers::pi / sides);
    const Vec3 out{std::cos(std::numbers::pi / sides), std::sin(std::numbers::pi / sides), 0.0};
    EXPECT_NEAR(length(push_at((apothem_mm - 0.5) * out)), 0.03, 0.005) << sides;
    EXPECT_NEAR(length(push_at((apothem_mm + 5.0) * out)), 0.3, 0.02) << sides;
    constexpr double kStepMm = 0.01;
    double steepest = 0.0;
    for (int n = 0; n < 3000; ++n) {
      // A spiral through the loop, past every corner.
      const double angle = 0.05 * n;
      const double radius_mm = 0.005 * n;
      const Vec3 at{radius_mm * std::cos(angle), radius_mm * std::sin(angle), 0.0};
      for (const Vec3& way : {Vec3{kStepMm, 0.0, 0.0}, Vec3{0.0, kStepMm, 0.0}}) {
        steepest = std::max(steepest, 1e3 * length(push_at(at + way) - push_at(at)) / kStepMm);
      }
    }
    EXPECT_LT(steepest, 4.0 * 60.0) << sides << " sides, N/m";
  }
}

/// Finely divided or not, a path is the same path.
TEST(Guidance, PushesTheSameHoweverThePathIsDivided) {
  const GuidanceOptions coarse = bent(GuidanceKind::indirect);
  for (const int parts : {20, 400}) {
    GuidanceOptions fine = coarse;
    fine.path_mm.clear();
    for (int n = 0; n <= 2 * parts; ++n) {
      const double mm = 20.0 * (n - parts) / parts;
      fine.path_mm.push_back(n < parts ? Vec3{mm, 0.0, 0.0} : Vec3{0.0, mm, 0.0});
    }
    Guidance of_coarse(coarse);
    Guidance of_fine(fine);
    for (const Vec3& at : {Vec3{-6.0, 5.0, 1.0}, Vec3{-3.0, 3.0, 0.0}, Vec3{2.0, -4.0, 0.0},
                           Vec3{-25.0, 2.0, 0.0}, Vec3{-1.0, 22.0, 3.0}}) {
      EXPECT_LT(length(follow(of_coarse, at, 0.0) - follow(of_fine, at, 0.0)), 1e-3) << parts;
    }
  }
}

/// What guidance is allowed to have given: in the test's own words.
class GuidanceAccount {
 public:
  void add(const Vec3& force_that_acted_n, const Vec3& moved_mm) {
    given_mj += dot(force_that_acted_n, moved_mm);
    const double speed = length(moved_mm) / kTickS;
    income_mj += kTickS * (1.0 + 1e-3 * speed * speed);
  }
  double given_mj = 0.0;
  double income_mj = 0.0;
};

/// Hands that do whatever they like, ramps that take away what they like: the energy stays bounded.
TEST(GuidanceProperty, NeverGivesMoreThanItMay) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  std::normal_distribution<double> step(0.0, 1.0);
  for (int run = 0; run < 60; ++run) {
    const GuidanceKind kind = kKinds[static_cast<std::size_t>(run) % kKinds.size()];
    GuidanceOptions options = bent(kind);
    options.most_given_mj = 1.0 + 30.0 * part(random);
    options.most_change_per_s = run % 2 == 0 ? 0.5 : 50.0;
    options.tolerance_mm = 1.0 + 10.0 * part(random);
    options.stiffness_n_per_m = 30.0 + 200.0 * part(random);
    Guidance guidance(options);
    GuidanceAccount account;
    Vec3 at{20.0 * step(random), 20.0 * step(random), 5.0 * step(random)};
    Vec3 velocity;
    const double first_mm = length(nearest_on_path(options.path_mm, at) - at);
    const double spring = 1e-3 * options.stiffness_n_per_m;
    const double linear_mm = options.most_force_n / spring;
    // What a pull has stored when it begins: a spring that saturates.
    const double stored_mj = kind != GuidanceKind::direct ? 0.0
                             : first_mm < linear_mm
                                 ? 0.5 * spring * first_mm * first_mm
                                 : options.most_force_n * (first_mm - 0.5 * linear_mm);
    std::array<Vec3, 2> given{};  // newest first; the older one acts
    double given_part = 1.0;
    double fastest_mm = 0.0;  // in a tick
    for (int n = 0; n < 20'000; ++n) {
      const Vec3 before = at;
      if (n > 0) {
        // Restless, or led by the force itself: the hand that takes the most.
        const double lead = run % 4 < 2 ? 0.3 : 0.0;
        velocity += Vec3{step(random), step(random), step(random)} * 2.0 + lead * given[0];
        velocity *= 0.99;
        if (length(at) > 60.0) velocity -= 0.5 * at;
        at += kTickS * velocity;
        account.add(given[1], at - before);
      }
      const Vec3 force_n = follow(guidance, at, given_part);
      given_part = run % 3 == 0 ? part(random) : 1.0;
      given = {given_part * force_n, given[0]};
      ASSERT_LE(length(force_n), options.most_force_n + 1e-9);
      // What is on its way to the device when it was the last that might be given.
      fastest_mm = std::max(fastest_mm, length(at - before));
      const double slack_mj = 3.0 * options.most_force_n * fastest_mm + 1e-6;
      ASSERT_LE(account.given_mj, stored_mj + options.most_given_mj + account.income_mj + slack_mj)
          << guidance_name(kind) << " run " << run << " tick " << n;
    }
    EXPECT_NEAR(guidance.state().given_mj, account.given_mj, 1e-6 + 1e-9 * account.income_mj);
  }
}

/// A hand that lets itself be pushed off is let go: what flows in is all that is left of the push.
TEST(Guidance, FadesWhereItsEnergyIsSpent) {
  Guidance guidance(bent(GuidanceKind::indirect));
  double off_mm = 0.5;
  double at_20_n = 0.0;
  double last_n = 0.0;
  constexpr double kSeconds = 20.0;
  for (int n = 0; n < static_cast<int>(kSeconds / kTickS); ++n) {
    const Vec3 at{-10.0, -off_mm, 0.0};
    last_n = length(follow(guidance, at));
    if (off_mm < 20.0) at_20_n = last_n;
    off_mm += 20.0 * kTickS * last_n;  // a hand that is nothing but a damper, 50 N s/m
  }
  EXPECT_NEAR(at_20_n, 1.2, 0.01) << "60 N/m, and nothing faded yet";
  EXPECT_GT(off_mm, 29.0);
  // 1 mW into 50 N s/m.
  EXPECT_NEAR(last_n, std::sqrt(1e-3 * 50.0), 0.02);
  EXPECT_LT(guidance.state().given_mj, 25.0 + kSeconds * 1.5);
}

/// A hand that is pushed off, lost, and found again beside the path has not been given less.
TEST(Guidance, KeepsWhatIsOwedOverALoss) {
  Guidance guidance(bent(GuidanceKind::indirect));
  const auto push_off = [&] {
    for (double off_mm = 1.0; off_mm < 20.0; off_mm += 0.02) {
      follow(guidance, {-10.0, -off_mm, 0.0});
    }
    return guidance.state().left_mj;
  };
  const double once_mj = push_off();
  // The spring's energy at 20 mm, less 1.4 mW for a second.
  EXPECT_NEAR(once_mj, 25.0 - 12.0 + 1.3, 1.0);
  guidance.forget_motion();
  guidance.forget_motion();
  follow(guidance, {-10.0, -1.0, 0.0});
  EXPECT_NEAR(guidance.state().left_mj, once_mj, 0.1);
  EXPECT_LT(push_off(), 5.0) << "less as much again";
  EXPECT_GT(guidance.state().given_mj, 22.0) << "counted on";
}

/// What a pull has stored where the hand is found again it may give, and no more than that.
TEST(Guidance, PullsAgainAfterALoss) {
  Guidance guidance(bent(GuidanceKind::direct));
  for (int round = 0; round < 3; ++round) {
    for (double off_mm = 40.0; off_mm > 0.05; off_mm -= 0.1) {
      const double force_n = length(follow(guidance, {-10.0, -off_mm, 0.0}));
      ASSERT_NEAR(force_n, std::min(1.5, 0.06 * off_mm), 1e-9) << round << " at " << off_mm;
    }
    guidance.forget_motion();
  }
}

/// A filter moves the tool and not the hand: the energy is the hand's.
TEST(Guidance, CountsTheHandsOwnMotion) {
  Guidance guidance(bent(GuidanceKind::direct));
  double given_mj = 0.0;
  Vec3 force_n;
  for (int n = 0; n < 500; ++n) {
    const Vec3 hand{-10.0, -20.0 + 0.02 * n, 0.0};
    const Vec3 tool{-10.0, -20.0 + 0.002 * n, 0.0};  // hardly follows
    if (n > 0) given_mj += dot(force_n, Vec3{0.0, 0.02, 0.0});
    force_n = guidance.tick(tool, {kTickS, 1.0, hand, 0});
  }
  EXPECT_NEAR(guidance.state().given_mj, given_mj, 1e-9);
  EXPECT_NEAR(given_mj, 1.2 * 9.98, 0.3);
}

TEST(Guidance, IsNoStifferThanTheTickAllows) {
  GuidanceOptions options = bent(GuidanceKind::direct);
  options.stiffness_n_per_m = 400.0;
  Guidance guidance(options);
  AidTick tick;
  tick.handle_mm = {-10.0, -1.0, 0.0};
  tick.most_stiffness_n_per_m = 150.0;
  EXPECT_NEAR(length(guidance.tick(tick.handle_mm, tick)), 0.15, 1e-9);
  EXPECT_EQ(guidance.state().stiffness_n_per_m, 150.0);
  tick.most_stiffness_n_per_m = 1000.0;
  EXPECT_NEAR(length(guidance.tick(tick.handle_mm, tick)), 0.4, 1e-9);
  tick.most_stiffness_n_per_m = 0.0;  // a device without damping
  EXPECT_EQ(guidance.tick(tick.handle_mm, tick), Vec3{});
}

TEST(GuidanceOptions, AreRefusedByName) {
  const auto refusal = [](auto change) {
    GuidanceOptions options = bent(GuidanceKind::hybrid);
    change(options);
    const auto good = check_guidance(options);
    return good ? std::string() : good.error().message;
  };
  EXPECT_EQ(refusal([](GuidanceOptions&) {}), "");
  EXPECT_EQ(refusal([](GuidanceOptions& o) { o = {}; }), "") << "none needs no path";
  const auto expect_named = [&](const char* name, auto change) {
    EXPECT_NE(refusal(change).find(name), std::string::npos) << name;
  };
  expect_named("at least one point", [](GuidanceOptions& o) { o.path_mm.clear(); });
  expect_named("1001 points", [](GuidanceOptions& o) { o.path_mm.resize(1001); });
  expect_named("reach", [](GuidanceOptions& o) { o.path_mm[0].x = 1e7; });
  expect_named("reach", [](GuidanceOptions& o) {
    o.path_mm[0].x = std::numeric_limits<double>::quiet_NaN();
  });
  expect_named("stiffness is 501 N/m", [](GuidanceOptions& o) { o.stiffness_n_per_m = 501.0; });
  expect_named("most force is 0 N", [](GuidanceOptions& o) { o.most_force_n = 0.0; });
  expect_named("scale", [](GuidanceOptions& o) { o.scale = -1.0; });
  expect_named("tolerance", [](GuidanceOptions& o) { o.tolerance_mm = 0.0; });
  expect_named("effort", [](GuidanceOptions& o) { o.effort_n = 0.0; });
  expect_named("settling time", [](GuidanceOptions& o) { o.settle_s = 0.0; });
  expect_named("change of share", [](GuidanceOptions& o) { o.most_change_per_s = 0.0; });
  expect_named("energy is nan", [](GuidanceOptions& o) {
    o.most_given_mj = std::numeric_limits<double>::quiet_NaN();
  });
}

/// Nothing to touch.
class EmptyScene final : public ForceScene {
 public:
  SceneForce force_at(const HandleState&) const noexcept override { return {}; }
};

/// A clay's z is up: the device's z, towards the hand, is the clay's -y.
TEST(PlacedScene, TurnsGuidanceIntoTheDevicesFrame) {
  EmptyScene empty;
  GuidanceOptions options;
  options.kind = GuidanceKind::direct;
  options.path_mm = {{100.0, 0.0, 50.0}};
  options.scale = 2.0;
  GuidedScene guided(empty, options);
  PlacedScene placed(guided, {2.0, {100.0, 0.0, 50.0}, true});
  HandleState handle;
  handle.position_mm = {0.0, 0.0, -5.0};  // the clay's y + 10
  placed.begin_tick(handle);
  AidTick tick;
  tick.handle_mm = handle.position_mm;
  const Vec3 pull = placed.aid_n(handle, tick);
  EXPECT_NEAR(pull.z, 0.3, 1e-12);
  EXPECT_NEAR(std::hypot(pull.x, pull.y), 0.0, 1e-12);
  placed.set_clutched(true);
  placed.begin_tick(handle);
  EXPECT_EQ(placed.aid_n(handle, tick), Vec3{}) << "the clutch lets go of it too";
}

/// A floor: y < 0 pushes up by 1 N/mm.
class FloorScene final : public ForceScene {
 public:
  SceneForce force_at(const HandleState& handle) const noexcept override {
    return {{0.0, std::max(0.0, -handle.position_mm.y), 0.0}, 1000.0};
  }
};

/// The scene's y is the device's -z where the scene's z is up.
TEST(PlacedScene, TurnsTheSurfacesPushIntoTheDevicesFrame) {
  FloorScene floor;
  PlacedScene placed(floor, {2.0, {}, true});
  HandleState handle;
  handle.position_mm = {0.0, 0.0, 1.5};
  placed.begin_tick(handle);
  EXPECT_LT(length(placed.touch_n(handle) - Vec3{0.0, 0.0, -3.0}), 1e-12);
  placed.set_clutched(true);
  placed.begin_tick(handle);
  EXPECT_EQ(placed.touch_n(handle), Vec3{}) << "the clutch lets go of it";
}

/// The middle of a tool rides over a path on the surface, or is pressed under it.
TEST(GuidedScene, GuidesAlongTheSurfaceThatIsTouched) {
  FloorScene floor;
  GuidanceOptions options;
  options.kind = GuidanceKind::direct;
  options.path_mm = {{-50.0, 4.0, 0.0}, {50.0, 4.0, 0.0}};
  const auto aid_at = [&](const Vec3& place_mm) {
    GuidedScene guided(floor, options);
    HandleState handle;
    handle.position_mm = place_mm;
    guided.begin_tick(handle);
    AidTick tick;
    tick.handle_mm = place_mm;
    const Vec3 aid_n = guided.aid_n(handle, tick);
    return std::pair(aid_n, guided.guidance().distance_mm);
  };
  const auto [touching_n, touching_mm] = aid_at({0.0, -2.0, 3.0});
  EXPECT_NEAR(touching_mm, 3.0, 1e-9) << "beside it, and not the 6 mm under it";
  EXPECT_NEAR(touching_n.z, -0.18, 1e-9);
  EXPECT_NEAR(touching_n.y, 0.0, 1e-9);
  const auto [free_n, free_mm] = aid_at({0.0, 1.0, 4.0});
  EXPECT_NEAR(free_mm, 5.0, 1e-9) << "in the air all of it counts";
  EXPECT_GT(free_n.y, 0.1);
  const auto [grazing_n, grazing_mm] = aid_at({0.0, -0.1, 3.0});
  EXPECT_GT(grazing_mm, 3.0) << "0.1 N are half a touch";
  EXPECT_LT(grazing_mm, std::hypot(3.0, 4.1));
}

/// A floor that drags at the tool as well.
class DraggingFloor final : public ForceScene {
 public:
  SceneForce force_at(const HandleState& handle) const noexcept override {
    if (!(handle.position_mm.y < 0.0)) return {};
    return {Vec3{0.0, -handle.position_mm.y, 0.0} - 0.05 * handle.velocity_mm_per_s, 1000.0};
  }
};

/// However fast the tool is dragged along, what it is guided along is the floor.
TEST(GuidedScene, TakesTheSurfacesNormalAndNotTheDrags) {
  DraggingFloor floor;
  GuidanceOptions options;
  options.kind = GuidanceKind::direct;
  options.path_mm = {{-50.0, 4.0, 0.0}, {50.0, 4.0, 0.0}};
  GuidedScene guided(floor, options);
  HandleState tool;
  tool.position_mm = {0.0, -2.0, 3.0};
  tool.velocity_mm_per_s = {0.0, 0.0, 100.0};
  AidTick tick;
  tick.handle_mm = tool.position_mm;
  EXPECT_LT(length(guided.aid_n(tool, tick) - Vec3{0.0, 0.0, -0.18}), 1e-9);
}

}  // namespace
}  // namespace argil::haptics
