// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/bridge/bridge_clay.h"

namespace argil::haptics {

/// A simulator that has left stops nothing.
bool BridgeClayScene::is_stopped() const noexcept {
  return session_.newest() != nullptr && session_.is_stopped();
}

HandleState BridgeClayScene::in_clay(const HandleState& handle) const noexcept {
  HandleState in = handle;
  in.position_mm = place_.to_scene(handle.position_mm);
  in.velocity_mm_per_s = place_.scale * place_.turned(handle.velocity_mm_per_s);
  in.is_active = handle.is_active && !is_stopped();
  return in;
}

void BridgeClayScene::begin_tick(const HandleState& handle) noexcept {
  session_.receive(handle.time_s);
  session_.watch().tick(handle.time_s);
  clay_.begin_tick(in_clay(handle));
}

SceneForce BridgeClayScene::force_at(const HandleState& handle) const noexcept {
  SceneForce felt = clay_.force_at(in_clay(handle));
  if (is_stopped()) return {{}, 0.0, felt.faults | kSceneStopped};
  felt.force_n = place_.turned_back(felt.force_n);
  felt.stiffness_n_per_m *= place_.scale;
  return felt;
}

Vec3 BridgeClayScene::touch_n(const HandleState& handle) const noexcept {
  return is_stopped() ? Vec3{} : place_.turned_back(clay_.touch_n(in_clay(handle)));
}

Vec3 BridgeClayScene::aid_n(const HandleState& tool, const AidTick& tick) noexcept {
  AidTick in = tick;
  in.handle_mm = place_.to_scene(tick.handle_mm);
  const Vec3 aid_n = clay_.aid_n(in_clay(tool), in);
  return is_stopped() ? Vec3{} : place_.turned_back(aid_n);
}

void BridgeClayScene::end_tick(const HandleState& tool) noexcept { clay_.end_tick(in_clay(tool)); }

}  // namespace argil::haptics
