// SPDX-License-Identifier: GPL-3.0-or-later
#include "stability/late/late_block.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace argil::evaluation {
namespace {

constexpr double kVoxelMm = 0.5;
constexpr std::size_t kRingSamples = 1024;
/// Later than any window here, so that being late is the only thing wrong.
constexpr double kNeverStaleS = 10.0;
/// How far a hand that slides goes, and one that carves sinks.
constexpr double kSlideMm = 40.0;
constexpr double kDeepMm = 45.0;
/// What makes a blend without an account: one that pays whatever is asked.
constexpr haptics::EnergyAccountOptions kPaysAll{1e12, 1e12, 0.0};

/// Of a hollow; its bottom is hardly bent under a tool, and its rim out of the tool's reach.
double hollow_radius_mm(double tool_mm) { return 3.0 * tool_mm; }
double hollow_depth_mm(double tool_mm) { return 0.5 * tool_mm + 0.5; }

Action work_of(LateAction action) {
  if (action == LateAction::add) return Action::add;
  return action == LateAction::smooth ? Action::smooth : Action::carve;
}

Vec3 size_mm(const LateCase& what) {
  const double reach_mm = haptics::kKernelSupport * what.tool.radius_mm + what.tool.skin_mm;
  const double side_mm = 2.0 * std::ceil(reach_mm + 4.0);
  Vec3 size{side_mm, side_mm, side_mm};
  if (what.action == LateAction::slide) size.x += kSlideMm;
  if (what.action == LateAction::carve) size.y += kDeepMm;
  return size;
}

/// The top is at half of its height.
Result<Clay> make_block(const LateCase& what) {
  ClayOptions options;
  options.voxel_mm = kVoxelMm;
  const Vec3 size = size_mm(what);
  if (what.action != LateAction::smooth) return Clay::block(size, options);
  const double radius_mm = hollow_radius_mm(what.tool.radius_mm);
  const double depth_mm = hollow_depth_mm(what.tool.radius_mm);
  const Vec3 middle{0.0, 0.5 * size.y - depth_mm + radius_mm, 0.0};
  const Vec3 half = 0.5 * size;
  const auto distance_mm = [=](const Vec3& p) {
    const double block =
        std::max({std::abs(p.x) - half.x, std::abs(p.y) - half.y, std::abs(p.z) - half.z});
    return std::max(block, radius_mm - length(p - middle));
  };
  return Clay::from_distance(distance_mm, {-half, half}, options);
}

ClayWorkerOptions worker_of(const LateCase& what) {
  ClayWorkerOptions worker;
  const double radius_mm = what.tool.radius_mm;
  worker.tool = {work_of(what.action), Shape::ball, {radius_mm, radius_mm, radius_mm}, 1.0};
  // A tool that rests goes on working.
  worker.style.hold_s = 0.05;
  return worker;
}

haptics::ClaySceneOptions scene_of(const LateCase& what, const Vec3& offset_mm) {
  const double radius_mm = what.tool.radius_mm;
  haptics::ClaySceneOptions scene;
  scene.tool.radii_mm = {radius_mm, radius_mm, radius_mm};
  scene.material = material_of(what.tool);
  scene.offset_mm = offset_mm;
  scene.stale_after_s = kNeverStaleS;
  if (what.remedy == LateRemedy::stamped) scene.own_cut_mm = radius_mm;
  if (what.remedy == LateRemedy::blended) scene.account = kPaysAll;
  return scene;
}

}  // namespace

Result<std::unique_ptr<LateBlock>> LateBlock::make(const LateCase& what, double surface_mm) {
  assert(!what.tool.is_spring() && what.remedy != LateRemedy::at_once);
  auto clay = make_block(what);
  if (!clay) return clay.error();
  double top_mm = 0.5 * size_mm(what).y;
  if (what.action == LateAction::smooth) top_mm -= hollow_depth_mm(what.tool.radius_mm);
  return std::unique_ptr<LateBlock>(
      new LateBlock(std::move(clay).value(), what, {0.0, top_mm - surface_mm, 0.0}));
}

LateBlock::LateBlock(Clay clay, const LateCase& what, const Vec3& offset_mm)
    : late_(what.late),
      clay_(std::move(clay)),
      ring_(kRingSamples),
      worker_(clay_, worker_of(what), ring_, made_),
      scene_(scene_of(what, offset_mm), ring_, felt_) {}

void LateBlock::begin_tick(const haptics::HandleState& handle) noexcept {
  scene_.begin_tick(handle);
}

haptics::SceneForce LateBlock::force_at(const haptics::HandleState& handle) const noexcept {
  return scene_.force_at(handle);
}

void LateBlock::end_tick(const haptics::HandleState& tool) noexcept { scene_.end_tick(tool); }

void LateBlock::forget_motion() noexcept { scene_.forget_motion(); }

double LateBlock::energy_at(const haptics::HandleState& handle) const noexcept {
  return scene_.energy_at(handle);
}

void LateBlock::after_tick(const haptics::ServoTick& tick) {
  if (worked_ && tick.time_s + 1e-9 >= next_s_) {
    next_s_ += late_.period_s;
    if (auto stepped = worker_.step(); !stepped) worked_ = stepped.error();
    if (made_.fetch()) coming_.push_back({tick.time_s + late_.age_s, made_.read_slot()});
  }
  while (!coming_.empty() && coming_.front().time_s <= tick.time_s + 1e-9) {
    felt_.write_slot() = coming_.front().window;
    felt_.publish();
    coming_.pop_front();
  }
}

}  // namespace argil::evaluation
