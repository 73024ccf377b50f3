// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "argil/core/vec3.h"
#include "argil/haptics/bridge/bridge_message.h"

namespace argil::haptics {

/// How what a slow simulator says becomes a force at the servo's rate. The values are those of
/// BridgeWelcome::law.
enum class BridgeLaw : std::uint32_t {
  /// The simulator computes the force, which is held until its next one (eq. 4.1).
  direct = 0,
  /// A spring and damper from the handle to the simulator's proxy (eq. 4.2).
  indirect = 1,
  /// The simulator sends the plane of contact, on which the servo projects (default).
  plane = 2,
  /// The force is that of Argil's own clay; the simulator only shows it.
  clay = 3,
  /// The same of a scene of the Falcon report (scene_catalogue.h).
  scene = 4,
};
inline constexpr BridgeLaw kLastBridgeLaw = BridgeLaw::scene;
const char* bridge_law_name(BridgeLaw law) noexcept;  ///< as in BridgeLaw

/// The force is Argil's own, through a coupling of its own: nothing of what the simulator says is
/// felt (BridgeShownScene).
constexpr bool is_own_force(BridgeLaw law) noexcept {
  return law == BridgeLaw::clay || law == BridgeLaw::scene;
}

struct BridgeSpring {
  /// k; usual 1500, > 0.
  double stiffness_n_per_m = 1500.0;
  /// c; usual 0, >= 0.
  double damping_n_s_per_m = 0.0;
};

/// The force on the handle by the simulator's newest message.
///
/// direct    what it says, while it says that it touches.
/// indirect  k (x_proxy - x) + c (v_proxy - v), with the sign that acts on the handle (the Falcon
///           report prints the proxy's); zero while the proxy does not touch, and where the force
///           would pull the handle into the surface: a handle that lifts off between two frames is
///           free at once.
/// plane     k d - c v_n along the normal, d the depth of the handle behind the plane; zero where d
///           <= 0, never an attraction, and nothing across the normal: sliding feels no drag.
/// clay, scene  zero: what the simulator says is not felt.
///
/// Threads   Realtime; pure.
/// Source    eq. 4.1 and 4.2 of the Falcon report (docs/equations.md).
Vec3 bridge_force(BridgeLaw law, const BridgeSpring& spring, const Vec3& position_mm,
                  const Vec3& velocity_mm_per_s, const BridgeProxy& proxy) noexcept;

/// The period at which a law closes its loop: the simulator's for `direct`, else the servo's. Both
/// arguments > 0.
double bridge_period_s(BridgeLaw law, double servo_period_s, double simulator_rate_hz) noexcept;

/// Whether k T < 2 b: the rule of a sampled spring against a device of damping b that no hand
/// holds. It knows no delay, which lowers the limit, nor the damping of a hand, which raises it:
/// docs/charts/bridge.svg.
bool is_bridge_stable(double stiffness_n_per_m, double period_s,
                      double device_damping_n_s_per_m) noexcept;

}  // namespace argil::haptics
