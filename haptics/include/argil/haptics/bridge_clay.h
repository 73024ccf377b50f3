// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/haptics/bridge_session.h"
#include "argil/haptics/scene.h"

namespace argil::haptics {

/// Where a clay, whose z is up, lies in a device's workspace, whose y is: a handle at (x, y, z) is
/// the tool at offset_mm + scale (x, -z, y).
struct ClayPlace {
  double scale = 1.0;  ///< mm of the clay for a mm of the hand; > 0
  Vec3 offset_mm;      ///< where in the clay the device's 0 lies

  Vec3 to_clay(const Vec3& device_mm) const noexcept {
    return offset_mm + scale * turned(device_mm);
  }
  /// A direction or a velocity of the device in the clay, before the scale, and back.
  static Vec3 turned(const Vec3& v) noexcept { return {v.x, -v.z, v.y}; }
  static Vec3 turned_back(const Vec3& v) noexcept { return {v.x, v.z, -v.y}; }
};

/// Clay that a simulator shows: its own force, whatever the simulator says and however long it is
/// silent. Only its STOP counts: no force at once, and the tool does not work, until it says
/// something else or leaves.
///
/// As PlacedScene but for the turn: the force is the clay's own in newtons, stiffness grows by the
/// scale.
///
/// Threads  as ForceScene. Both must outlive it; the session is the servo thread's while it runs.
class BridgeClayScene final : public ForceScene {
 public:
  BridgeClayScene(BridgeSession& session, ForceScene& clay, const ClayPlace& place) noexcept
      : session_(session), clay_(clay), place_(place) {}

  void begin_tick(const HandleState& handle) noexcept override;
  SceneForce force_at(const HandleState& place) const noexcept override;
  void end_tick(const HandleState& tool) noexcept override;
  void forget_motion() noexcept override { clay_.forget_motion(); }
  int most_queries() const noexcept override { return clay_.most_queries(); }
  WindowStamp window_stamp() const noexcept override { return clay_.window_stamp(); }

 private:
  HandleState in_clay(const HandleState& place) const noexcept;
  bool is_stopped() const noexcept;

  BridgeSession& session_;
  ForceScene& clay_;
  ClayPlace place_;
};

}  // namespace argil::haptics
