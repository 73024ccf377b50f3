// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cassert>

#include "argil/haptics/bridge/bridge_session.h"
#include "argil/haptics/scene/scene.h"
#include "argil/haptics/scene/scene_placed.h"

namespace argil::haptics {

/// Clay that a simulator shows: the clay's own force is felt, whatever the simulator says and
/// however long it is silent. Only the simulator's STOP counts: no force at once, and the tool does
/// not work, until the simulator says something else or leaves.
///
/// Placed as by PlacedScene without the clutch: the force is the clay's own in newtons, and the
/// stiffness grows by the scale.
///
/// Threads  as ForceScene; the session is the servo thread's while it runs.
class BridgeClayScene final : public ForceScene {
 public:
  /// Session and clay must outlive it. `place`: scale > 0.
  BridgeClayScene(BridgeSession& session, ForceScene& clay, const Placement& place) noexcept
      : session_(session), clay_(clay), place_(place) {
    assert(place.scale > 0.0);
  }

  void begin_tick(const HandleState& handle) noexcept override;
  SceneForce force_at(const HandleState& handle) const noexcept override;
  Vec3 touch_n(const HandleState& handle) const noexcept override;
  Vec3 aid_n(const HandleState& tool, const AidTick& tick) noexcept override;
  void end_tick(const HandleState& tool) noexcept override;
  void forget_motion() noexcept override { clay_.forget_motion(); }
  int most_queries() const noexcept override { return clay_.most_queries(); }
  WindowStamp window_stamp() const noexcept override { return clay_.window_stamp(); }

 private:
  HandleState in_clay(const HandleState& handle) const noexcept;
  bool is_stopped() const noexcept;

  BridgeSession& session_;
  ForceScene& clay_;
  Placement place_;
};

}  // namespace argil::haptics
