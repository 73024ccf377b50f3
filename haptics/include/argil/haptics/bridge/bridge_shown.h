// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cassert>

#include "argil/haptics/bridge/bridge_session.h"
#include "argil/haptics/scene/scene.h"
#include "argil/haptics/scene/scene_placed.h"

namespace argil::haptics {

/// A scene of Argil's own that a simulator only shows, such as clay: its own force is felt,
/// whatever the simulator says and however long it is silent. Only the simulator's STOP counts: no
/// force at once, and the tool does not work, until the simulator says something else or leaves.
///
/// Placed as by PlacedScene without the clutch: the force is the scene's own in newtons, and the
/// stiffness grows by the scale.
///
/// Threads  as ForceScene; the session is the servo thread's while it runs.
class BridgeShownScene final : public ForceScene {
 public:
  /// Session and scene must outlive it. `place`: scale > 0.
  BridgeShownScene(BridgeSession& session, ForceScene& scene, const Placement& place) noexcept
      : session_(session), scene_(scene), place_(place) {
    assert(place.scale > 0.0);
  }

  void begin_tick(const HandleState& handle) noexcept override;
  SceneForce force_at(const HandleState& handle) const noexcept override;
  Vec3 aid_n(const HandleState& tool, double elapsed_s, double given_part) noexcept override;
  void end_tick(const HandleState& tool) noexcept override;
  void forget_motion() noexcept override { scene_.forget_motion(); }
  int most_queries() const noexcept override { return scene_.most_queries(); }
  WindowStamp window_stamp() const noexcept override { return scene_.window_stamp(); }

 private:
  HandleState in_scene(const HandleState& handle) const noexcept;
  bool is_stopped() const noexcept;

  BridgeSession& session_;
  ForceScene& scene_;
  Placement place_;
};

}  // namespace argil::haptics
