// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cassert>

#include "argil/core/vec3.h"
#include "argil/haptics/scene/scene.h"

namespace argil::haptics {

/// Where a scene lies in a device's workspace: another origin and scale, and the same axes or, for
/// a scene whose z is up, the device's (x right, y up, z towards the hand) as its x, z and -y.
struct Placement {
  /// mm of the scene for each mm of the device; usual 1, > 0.
  double scale = 1.0;
  /// Where in the scene the device's 0 lies; finite.
  Vec3 offset_mm;
  /// The scene's z is up, as the clay's is; false: its y.
  bool is_z_up = false;

  Vec3 to_scene(const Vec3& device_mm) const noexcept {
    return offset_mm + scale * turned(device_mm);
  }
  Vec3 to_device(const Vec3& scene_mm) const noexcept {
    return turned_back(scene_mm - offset_mm) / scale;
  }
  /// A direction, force or velocity of the device in the scene, before the scale; exact.
  Vec3 turned(const Vec3& v) const noexcept { return is_z_up ? Vec3{v.x, -v.z, v.y} : v; }
  /// The inverse of `turned`; exact.
  Vec3 turned_back(const Vec3& v) const noexcept { return is_z_up ? Vec3{v.x, v.z, -v.y} : v; }
};

/// Another scene, turned and scaled to a device's workspace, and a clutch that moves it there.
///
/// Scale  positions and velocities are multiplied by s; the force is the scene's own, in newtons:
///        what weighs 3 N on the tool weighs 3 N in the hand. A stiffness k of the scene is
///        therefore s k in the hand, and a damping s b; a conservative scene stays conservative,
///        its energy divided by s. The coupling and its governor come after this, in the device's
///        frame: what they bound is what the hand feels, and every rule of docs/stability.md holds
///        as it stands. Without them (direct) s k itself must be within the limit.
/// Clutch while it is held the tool stays where it was in the scene (the proxy, so that the handle
///        does not come back behind a thin wall), does not work it, and no force is felt:
///        kSceneClutched, on which the safety gate fades out what was felt. When it is let go the
///        offset changes so that the handle is where the tool is, and the force ramps in. A clutch
///        lasts 50 ms at least, so that the fade ends before it.
///
/// Threads  Realtime: as ForceScene; `set_clutched` from any thread, wait-free.
class PlacedScene final : public ForceScene {
 public:
  /// `scene` must outlive this, and nobody else may call its begin_tick. `placement`: scale > 0.
  PlacedScene(ForceScene& scene, const Placement& placement) noexcept
      : scene_(scene), placement_(placement) {
    assert(placement.scale > 0.0 && is_finite(placement.offset_mm));
  }

  /// Holds the clutch, or lets it go, from the next tick on.
  void set_clutched(bool clutched) noexcept {
    wants_clutch_.store(clutched, std::memory_order_relaxed);
  }

  void begin_tick(const HandleState& handle) noexcept override;
  SceneForce force_at(const HandleState& handle) const noexcept override;
  Vec3 touch_n(const HandleState& handle) const noexcept override;
  /// None while the clutch is held.
  Vec3 aid_n(const HandleState& tool, const AidTick& tick) noexcept override;
  void end_tick(const HandleState& tool) noexcept override;
  void forget_motion() noexcept override;
  int most_queries() const noexcept override { return scene_.most_queries(); }
  WindowStamp window_stamp() const noexcept override { return scene_.window_stamp(); }

  // For the servo's thread.

  /// As the clutch has left it.
  const Placement& placement() const noexcept { return placement_; }
  bool is_clutched() const noexcept { return is_clutched_; }
  const Vec3& tool_mm() const noexcept { return tool_mm_; }  ///< in the scene, of the last tick

 private:
  HandleState in_scene(const HandleState& handle) const noexcept;
  Vec3 place_in_scene(const Vec3& device_mm) const noexcept {
    return is_clutched_ ? tool_mm_ : placement_.to_scene(device_mm);
  }
  void turn_clutch(const HandleState& handle) noexcept;

  ForceScene& scene_;
  Placement placement_;
  std::atomic<bool> wants_clutch_ = false;
  bool is_clutched_ = false;
  double clutched_since_s_ = 0.0;
  Vec3 tool_mm_;
  bool has_tool_ = false;
};

}  // namespace argil::haptics
