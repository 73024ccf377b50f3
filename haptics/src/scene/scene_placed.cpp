// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene/scene_placed.h"

#include <cassert>
#include <cmath>

namespace argil::haptics {
namespace {

/// Longer than the safety gate takes to fade out (20 ms), or the force would jump.
constexpr double kLeastClutchS = 0.05;

}  // namespace

HandleState PlacedScene::in_scene(const HandleState& handle) const noexcept {
  HandleState in = handle;
  in.position_mm = place_in_scene(handle.position_mm);
  in.velocity_mm_per_s = placement_.scale * placement_.turned(handle.velocity_mm_per_s);
  if (!is_clutched_) return in;
  in.velocity_mm_per_s = {};
  in.is_active = false;
  return in;
}

void PlacedScene::turn_clutch(const HandleState& handle) noexcept {
  assert(is_finite(handle.position_mm) && is_finite(placement_.offset_mm));
  const bool wants = wants_clutch_.load(std::memory_order_relaxed);
  if (wants && !is_clutched_) {
    if (!has_tool_) tool_mm_ = placement_.to_scene(handle.position_mm);
    is_clutched_ = true;
    clutched_since_s_ = handle.time_s;
  }
  if (wants || !is_clutched_) return;
  // A clock that went back has nothing to wait for: the servo felt its jump as a fault.
  if (std::abs(handle.time_s - clutched_since_s_) < kLeastClutchS) return;
  is_clutched_ = false;
  placement_.offset_mm = tool_mm_ - placement_.scale * placement_.turned(handle.position_mm);
}

void PlacedScene::begin_tick(const HandleState& handle) noexcept {
  turn_clutch(handle);
  scene_.begin_tick(in_scene(handle));
}

SceneForce PlacedScene::force_at(const HandleState& handle) const noexcept {
  SceneForce felt = scene_.force_at(in_scene(handle));
  felt.force_n = placement_.turned_back(felt.force_n);
  felt.stiffness_n_per_m *= placement_.scale;
  if (!is_clutched_) return felt;
  return {{}, 0.0, felt.faults | kSceneClutched};
}

Vec3 PlacedScene::touch_n(const HandleState& handle) const noexcept {
  return is_clutched_ ? Vec3{} : placement_.turned_back(scene_.touch_n(in_scene(handle)));
}

Vec3 PlacedScene::aid_n(const HandleState& tool, const AidTick& tick) noexcept {
  AidTick in = tick;
  in.handle_mm = place_in_scene(tick.handle_mm);
  const Vec3 aid_n = scene_.aid_n(in_scene(tool), in);
  return is_clutched_ ? Vec3{} : placement_.turned_back(aid_n);
}

void PlacedScene::end_tick(const HandleState& tool) noexcept {
  const HandleState in = in_scene(tool);
  tool_mm_ = in.position_mm;
  has_tool_ = true;
  scene_.end_tick(in);
}

/// Where the tool is stays known while the clutch is held: that does not depend on the handle.
void PlacedScene::forget_motion() noexcept {
  has_tool_ = is_clutched_;
  scene_.forget_motion();
}

}  // namespace argil::haptics
