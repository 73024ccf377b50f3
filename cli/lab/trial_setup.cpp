// SPDX-License-Identifier: GPL-3.0-or-later
// The tasks of `argil lab trial`: scene, goal, what a simulated hand does, and when it is done.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "argil/haptics/analysis/hold_test.h"
#include "argil/haptics/servo/guided_scene.h"

#include "common/output.h"
#include "lab/lab.h"
#include "lab/trial.h"

namespace argil::cli::lab {
namespace {

using haptics::GuidanceKind;
using haptics::HandKey;

/// The servo has ramped in by then.
constexpr double kTrialWaitS = 0.5;
/// Within this of its point a hand has docked, once it has stayed there for so long.
constexpr double kDockMm = 2.0;
constexpr double kDockedS = 0.3;
/// From the end of a line, along it.
constexpr double kEndMm = 2.0;
/// What a hand that searches notices.
constexpr double kNoticesN = 0.45;
/// How far hands stray that hold still, and that move.
constexpr double kStillStrayMm = 1.0;
constexpr double kMovingStrayMm = 2.0;
constexpr double kTrialPressN = 1.5;

/// Nothing to touch.
class EmptyScene final : public haptics::ForceScene {
 public:
  haptics::SceneForce force_at(const haptics::HandleState&) const noexcept override { return {}; }
};

/// From -1 to 1, the same for the same seed and number.
double chance(std::uint64_t seed, std::uint64_t number) noexcept {
  return 2.0 * static_cast<double>(mixed(seed + number) >> 11U) * 0x1p-53 - 1.0;
}

/// Starts where it is and goes to a point, as fast as hands reach.
std::vector<HandKey> reach_plan(const Vec3& from_mm, const Vec3& to_mm) {
  constexpr double kReachS = 0.8;
  constexpr int kParts = 20;
  std::vector<HandKey> plan;
  for (int n = 0; n <= kParts; ++n) {
    const double t = static_cast<double>(n) / kParts;
    // The smoothest way to do it (T. Flash, N. Hogan, J. Neuroscience 5 (1985)).
    const double part = t * t * t * (10.0 + t * (6.0 * t - 15.0));
    HandKey key;
    key.time_s = kTrialWaitS + kReachS * t;
    key.place_mm = from_mm + part * (to_mm - from_mm);
    plan.push_back(key);
  }
  return plan;
}

TrialSetup dock(const Trial& trial) {
  TrialSetup setup;
  setup.scene = std::make_unique<EmptyScene>();
  const Vec3 goal{30.0 * chance(trial.place, 0), 25.0 * chance(trial.place, 1),
                  20.0 * chance(trial.place, 2)};
  setup.goal_mm = {goal};
  setup.plan = reach_plan({}, goal);
  if (trial.condition == "force") {
    haptics::GuidanceOptions guidance;
    guidance.kind = GuidanceKind::direct;
    guidance.path_mm = setup.goal_mm;
    setup.guided = std::make_unique<haptics::GuidedScene>(*setup.scene, std::move(guidance));
  }
  setup.hand.stray_mm = kStillStrayMm;
  setup.told = "bring the grip to the point, and hold it there";
  return setup;
}

/// A scene of the lab, its plan behind the wait, and the line that it goes along.
TrialSetup along_groove(const char* scene, SceneSettings settings, bool has_force) {
  LabOptions options;
  options.scene = scene;
  options.settings = std::move(settings);
  const auto kind =
      std::find_if(scene_kinds().begin(), scene_kinds().end(),
                   [&](const LabSceneKind& each) { return each.name == options.scene; });
  assert(kind != scene_kinds().end());
  // Scenes of the catalogue, with settings in their ranges, can always be made.
  auto made = kind->make(options, {});
  assert(made.ok());
  LabScene lab = std::move(made).value();
  TrialSetup setup;
  setup.scene = has_force ? std::move(lab.scene) : nothing_to_feel();
  setup.plan = std::move(lab.plan);
  // To the groove's end, and not back onto what is in it.
  const auto farthest = std::max_element(
      setup.plan.begin(), setup.plan.end(),
      [](const HandKey& a, const HandKey& b) { return a.place_mm.x < b.place_mm.x; });
  setup.plan.erase(farthest + 1, setup.plan.end());
  for (HandKey& key : setup.plan) {
    key.press_n = has_force ? std::min(key.press_n, kTrialPressN) : 0.0;
  }
  setup.plan = after_wait(std::move(setup.plan), kTrialWaitS);
  setup.goal_mm = {setup.plan[2].place_mm, setup.plan.back().place_mm};
  setup.hand.stray_mm = kMovingStrayMm;
  return setup;
}

TrialSetup groove(const Trial& trial) {
  TrialSetup setup = along_groove("slider", {}, trial.condition == "force");
  setup.normal = {0.0, 0.0, 1.0};
  setup.told = "go to the left end of the groove, then along it to the right end";
  return setup;
}

TrialSetup bump(const Trial& trial) {
  const double x_mm = std::round(10.0 * 18.0 * chance(trial.place, 0)) / 10.0;
  TrialSetup setup = along_groove("click", {{"x", x_mm}}, true);
  setup.bump_x_mm = x_mm;
  setup.is_blindfolded = true;
  setup.hand.is_sighted = false;
  setup.hand.notices_n = kNoticesN;
  setup.told = "close your eyes, go along the groove, and press the button where you feel a bump";
  return setup;
}

/// An S of 50 by 16 mm on the clay's top, in the device's frame, which begins anywhere in its wave.
std::vector<Vec3> curve(std::uint64_t place) {
  constexpr int kParts = 50;
  std::vector<Vec3> points;
  for (int n = 0; n <= kParts; ++n) {
    const double x = -25.0 + 50.0 * n / kParts;
    const double turn = 2.0 * x / 50.0 + chance(place, 0);
    points.push_back({x, 0.0, 8.0 * std::sin(std::numbers::pi * turn)});
  }
  return points;
}

TrialSetup path(const Trial& trial, Clay& clay) {
  haptics::ClaySceneOptions felt;
  felt.tool = haptics::ForceTool{haptics::ToolShape::ellipsoid, {4.0, 4.0, 4.0}, {}, {}, {}, {}};
  felt.offset_mm = {0.0, clay.bounds_mm().max.y, 0.0};
  ClayWorkerOptions worker;
  worker.tool.radii_mm = {4.0, 4.0, 4.0};
  TrialSetup setup;
  setup.clay = std::make_unique<ServedClay>(clay, worker, felt);
  setup.goal_mm = curve(trial.place);
  haptics::GuidanceOptions guidance;
  for (const GuidanceKind kind :
       {GuidanceKind::none, GuidanceKind::direct, GuidanceKind::indirect, GuidanceKind::hybrid}) {
    if (trial.condition == haptics::guidance_name(kind)) guidance.kind = kind;
  }
  guidance.path_mm = setup.goal_mm;
  setup.guided = std::make_unique<haptics::GuidedScene>(setup.clay->scene(), std::move(guidance));
  std::vector<Touch> touches;
  for (const Vec3& point : setup.goal_mm) touches.push_back({point, {0.0, -1.0, 0.0}});
  setup.plan = slide_plan(touches, 4.0);
  for (HandKey& key : setup.plan) key.press_n = std::min(key.press_n, kTrialPressN);
  setup.plan = after_wait(std::move(setup.plan), kTrialWaitS);
  setup.hand.stray_mm = kMovingStrayMm;
  setup.normal = {0.0, 1.0, 0.0};
  setup.told = "go along the curve on the clay from its left end to its right end";
  return setup;
}

}  // namespace

const char* trial_task_name(TrialTask task) noexcept {
  return kTrialTasks[static_cast<std::size_t>(task)];
}

Result<Clay> trial_clay() {
  ClayOptions options;
  options.voxel_mm = 0.5;
  return Clay::block({90.0, 20.0, 60.0}, options);
}

std::unique_ptr<haptics::ForceScene> nothing_to_feel() { return std::make_unique<EmptyScene>(); }

TrialSetup set_up(const Trial& trial, Clay& clay) {
  TrialSetup setup;
  switch (trial.task) {
    case TrialTask::dock:
      setup = dock(trial);
      break;
    case TrialTask::groove:
      setup = groove(trial);
      break;
    case TrialTask::bump:
      setup = bump(trial);
      break;
    case TrialTask::path:
      setup = path(trial, clay);
      break;
  }
  setup.hand.seed = mixed(trial.place + 100);
  return setup;
}

/// Whether the tool is where it should end, long enough or far enough; of bump whether the hand
/// says so.
bool TrialJudge::is_at_end(const haptics::ServoTick& tick) {
  const Vec3& end = setup_.goal_mm.back();
  switch (trial_.task) {
    case TrialTask::dock: {
      const bool is_near = length(end - tick.proxy_mm) <= kDockMm;
      if (!is_near) near_since_s_ = -1.0;
      if (is_near && near_since_s_ < 0.0) near_since_s_ = tick.time_s;
      return is_near && tick.time_s - near_since_s_ >= kDockedS;
    }
    case TrialTask::groove:
    case TrialTask::path:
      return tick.proxy_mm.x >= end.x - kEndMm;
    case TrialTask::bump:
      return (tick.buttons & 1U) != 0;
  }
  return true;
}

void TrialJudge::count_force(const haptics::ServoTick& tick) {
  const Vec3 moved_mm = ticks_ > 0 ? tick.position_mm - last_mm_ : Vec3{};
  worked_mj_ += std::max(0.0, -dot(last_force_n_, moved_mm));
  aid_worked_mj_ += std::max(0.0, -dot(last_aid_n_, moved_mm));
  last_mm_ = tick.position_mm;
  last_force_n_ = tick.force_n;
  last_aid_n_ = tick.aid_n;
  force_sum_ += length(tick.force_n);
  aid_sum_ += length(tick.aid_n);
  ++ticks_;
}

/// Errors count while the line is followed, at a point while it is held.
void TrialJudge::add(const haptics::ServoTick& tick) {
  count_force(tick);
  Vec3 off_mm = tick.proxy_mm - haptics::nearest_on_path(setup_.goal_mm, tick.proxy_mm);
  to_goal_mm_ = -off_mm;
  off_mm -= dot(off_mm, setup_.normal) * setup_.normal;
  if (trial_.task == TrialTask::dock) {
    if (near_since_s_ < 0.0) {
      error_sum_ = 0.0;
      errors_ = 0;
      return;
    }
    error_sum_ += length(off_mm);
  } else if (trial_.task == TrialTask::bump) {
    error_sum_ = std::abs(tick.proxy_mm.x - setup_.bump_x_mm);
    errors_ = 0;
  } else {
    error_sum_ += dot(off_mm, off_mm);
  }
  ++errors_;
}

bool TrialJudge::take(const haptics::ServoTick& tick) {
  if (!tick.is_ready || is_over_) return !is_over_;
  // A line begins where the tool first comes to its start; a point at once.
  if (!has_started_) {
    const bool is_line = setup_.goal_mm.size() > 1;
    const bool is_at_start = !is_line || tick.proxy_mm.x <= setup_.goal_mm.front().x + kEndMm;
    if (tick.time_s < kTrialWaitS || !is_at_start) {
      to_goal_mm_ = setup_.goal_mm.front() - tick.proxy_mm;
      return tick.time_s < 2.0 * kTrialS;
    }
    has_started_ = true;
    start_s_ = tick.time_s;
  }
  now_s_ = tick.time_s;
  is_over_ = is_at_end(tick);
  is_done_ = is_over_ && (trial_.task != TrialTask::bump ||
                          std::abs(tick.proxy_mm.x - setup_.bump_x_mm) <= kBumpMm);
  add(tick);
  return !is_over_ && now_s_ - start_s_ < kTrialS;
}

TrialResult TrialJudge::result() const {
  TrialResult result;
  result.trial = trial_;
  result.has_started = has_started_;
  result.is_done = is_done_;
  result.time_s = now_s_ - start_s_;
  if (ticks_ == 0) return result;
  result.effort_n = force_sum_ / static_cast<double>(ticks_);
  result.worked_mj = worked_mj_;
  result.aid_n = aid_sum_ / static_cast<double>(ticks_);
  result.aid_mj = aid_worked_mj_;
  if (errors_ == 0) {
    result.error_mm = length(to_goal_mm_);  // never came near
    return result;
  }
  const double mean = error_sum_ / static_cast<double>(errors_);
  const bool is_square = trial_.task == TrialTask::groove || trial_.task == TrialTask::path;
  result.error_mm = is_square ? std::sqrt(mean) : mean;
  return result;
}

}  // namespace argil::cli::lab
