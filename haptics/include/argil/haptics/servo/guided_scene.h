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
/// Cost     that of the other scene's force_at, once more in a tick.
class GuidedScene final : public ForceScene {
 public:
  /// `scene` must outlive this, and nobody else may call its begin_tick. `options` and
  /// `delay_ticks` as Guidance takes them.
  GuidedScene(ForceScene& scene, GuidanceOptions options, int delay_ticks = 1)
      : scene_(scene), guidance_(std::move(options), delay_ticks) {}

  void begin_tick(const HandleState& handle) noexcept override {
    handle_mm_ = handle.position_mm;
    scene_.begin_tick(handle);
  }
  SceneForce force_at(const HandleState& handle) const noexcept override {
    return scene_.force_at(handle);
  }
  /// That of the other scene too.
  Vec3 aid_n(const HandleState& tool, double elapsed_s, double given_part) noexcept override {
    return scene_.aid_n(tool, elapsed_s, given_part) +
           guidance_.tick(on_surface(tool), handle_mm_, elapsed_s, given_part);
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

  /// The tool, moved along the normal of what it touches to as near to the path as that goes.
  Vec3 on_surface(const HandleState& tool) const noexcept {
    if (guidance_.options().kind == GuidanceKind::none) return tool.position_mm;
    const Vec3 push_n = scene_.force_at(tool).force_n;
    const double size_n = length(push_n);
    if (!(size_n > 0.0)) return tool.position_mm;
    const Vec3 off_mm =
        tool.position_mm - nearest_on_path(guidance_.options().path_mm, tool.position_mm);
    const Vec3 normal = push_n / size_n;
    return tool.position_mm - std::min(1.0, size_n / kTouchN) * dot(off_mm, normal) * normal;
  }

  ForceScene& scene_;
  Guidance guidance_;
  Vec3 handle_mm_;
};

}  // namespace argil::haptics
