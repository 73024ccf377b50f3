// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/bridge/bridge_shown.h"

namespace argil::haptics {

/// A simulator that has left stops nothing.
bool BridgeShownScene::is_stopped() const noexcept {
  return session_.newest() != nullptr && session_.is_stopped();
}

HandleState BridgeShownScene::in_scene(const HandleState& handle) const noexcept {
  HandleState in = handle;
  in.position_mm = place_.to_scene(handle.position_mm);
  in.velocity_mm_per_s = place_.scale * place_.turned(handle.velocity_mm_per_s);
  in.is_active = handle.is_active && !is_stopped();
  return in;
}

void BridgeShownScene::begin_tick(const HandleState& handle) noexcept {
  session_.receive(handle.time_s);
  session_.watch().tick(handle.time_s);
  scene_.begin_tick(in_scene(handle));
}

SceneForce BridgeShownScene::force_at(const HandleState& handle) const noexcept {
  SceneForce felt = scene_.force_at(in_scene(handle));
  if (is_stopped()) return {{}, 0.0, felt.faults | kSceneStopped};
  felt.force_n = place_.turned_back(felt.force_n);
  felt.stiffness_n_per_m *= place_.scale;
  return felt;
}

Vec3 BridgeShownScene::aid_n(const HandleState& tool, double elapsed_s,
                             double given_part) noexcept {
  const Vec3 aid_n = scene_.aid_n(in_scene(tool), elapsed_s, given_part);
  return is_stopped() ? Vec3{} : place_.turned_back(aid_n);
}

void BridgeShownScene::end_tick(const HandleState& tool) noexcept {
  scene_.end_tick(in_scene(tool));
}

}  // namespace argil::haptics
