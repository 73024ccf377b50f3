// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <limits>

#include "argil/haptics/analysis/hold_test.h"
#include "argil/haptics/scene/scene.h"

namespace argil::haptics::scenes {

inline constexpr Vec3 kDown{0.0, -1.0, 0.0};

/// The plainest wall there is, y < 0: of the loop's tests, so that they do not lean on the scenes.
class PlainWall final : public ForceScene {
 public:
  explicit PlainWall(double stiffness_n_per_m) : stiffness_(stiffness_n_per_m) {}
  SceneForce force_at(const HandleState& place) const noexcept override {
    SceneForce felt;
    felt.faults = faults;
    if (place.position_mm.y < 0.0) {
      felt.force_n.y =
          bad ? std::numeric_limits<double>::quiet_NaN() : -1e-3 * stiffness_ * place.position_mm.y;
      felt.stiffness_n_per_m = stiffness_;
    }
    return felt;
  }
  void forget_motion() noexcept override { ++forgotten; }
  int forgotten = 0;
  bool bad = false;  ///< gives NaN
  std::uint32_t faults = kSceneSound;

 private:
  double stiffness_;
};

/// Another scene felt along y only, as on a rail: where a hand would slide off what is round.
class OnRail final : public ForceScene {
 public:
  explicit OnRail(const ForceScene& scene) : scene_(scene) {}
  SceneForce force_at(const HandleState& place) const noexcept override {
    HandleState on_rail = place;
    on_rail.position_mm = {0.0, place.position_mm.y, 0.0};
    on_rail.velocity_mm_per_s = {0.0, place.velocity_mm_per_s.y, 0.0};
    SceneForce felt = scene_.force_at(on_rail);
    felt.force_n = {0.0, felt.force_n.y, 0.0};
    return felt;
  }

 private:
  const ForceScene& scene_;
};

/// A hold of 3 N at a plain wall whose stiffness in series with the coupling is `seen_n_per_m`.
inline HoldTest press_wall(Hand hand, double seen_n_per_m, const ServoOptions& servo) {
  HoldTest test;
  test.device.encoder = Encoder::uniform;
  test.hand = hand_model(hand);
  test.servo = servo;
  test.plan = press_plan({0.0, -3000.0 / seen_n_per_m, 0.0}, kDown, 3.0);
  return test;
}

}  // namespace argil::haptics::scenes
