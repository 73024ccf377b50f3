// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <utility>

#include "argil/haptics/scene/scene.h"
#include "argil/haptics/servo/guidance.h"

namespace argil::haptics {

/// Another scene, and guidance along a path in its frame: what is touched is felt as it is, and the
/// hand is pulled or pushed besides, by where the tool is. A tool that touches something is guided
/// along its surface: how far it lies over or under the path there, by its size and the press, is
/// not looked at (GuidedScene.GuidesAlongTheSurfaceThatIsTouched).
///
/// Threads  as ForceScene.
/// Cost     that of the other scene's touch_n, once in a tick, and Guidance's.
class GuidedScene final : public ForceScene {
 public:
  /// `scene` must outlive this, and nobody else may call its begin_tick. `options` as Guidance
  /// takes them.
  GuidedScene(ForceScene& scene, GuidanceOptions options)
      : scene_(scene), guidance_(std::move(options)) {}

  void begin_tick(const HandleState& handle) noexcept override { scene_.begin_tick(handle); }
  SceneForce force_at(const HandleState& handle) const noexcept override {
    return scene_.force_at(handle);
  }
  Vec3 touch_n(const HandleState& handle) const noexcept override { return scene_.touch_n(handle); }
  /// That of the other scene too.
  Vec3 aid_n(const HandleState& tool, const AidTick& tick) noexcept override {
    return scene_.aid_n(tool, tick) + guidance_.tick(tool.position_mm, tick, touch_of(tool));
  }
  void end_tick(const HandleState& tool) noexcept override { scene_.end_tick(tool); }
  void forget_motion() noexcept override {
    guidance_.forget_motion();
    scene_.forget_motion();
  }
  int most_queries() const noexcept override { return scene_.most_queries(); }
  WindowStamp window_stamp() const noexcept override { return scene_.window_stamp(); }

  /// Of the last tick; for the servo's thread.
  const GuidanceState& guidance() const noexcept { return guidance_.state(); }

 private:
  /// Below this a touch counts in part, so that the guiding force does not jump where one begins.
  static constexpr double kTouchN = 0.2;

  SurfaceTouch touch_of(const HandleState& tool) const noexcept {
    if (guidance_.options().kind == GuidanceKind::none) return {};
    const Vec3 push_n = scene_.touch_n(tool);
    const double size_n = length(push_n);
    if (!(size_n > 0.0)) return {};
    return {push_n / size_n, std::min(1.0, size_n / kTouchN)};
  }

  ForceScene& scene_;
  Guidance guidance_;
};

}  // namespace argil::haptics
