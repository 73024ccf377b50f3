// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "argil/core/vec3.h"

namespace argil::haptics {

/// A hand as mass, damper and spring between the handle and where the person means it to be.
/// Brackets, not people: what is quiet for all four is quiet for a person. `arm` is measured
/// (theory A, "Hands used").
struct HandModel {
  const char* name = "none";
  double mass_kg = 0.0;            ///< moves with the handle
  double damping_n_s_per_m = 0.0;  ///< to the place meant
  double stiffness_n_per_m = 0.0;  ///< to the place meant
  /// Pushes with a force that nothing resists or damps along its direction, the worst case; across
  /// it, and while it does not press, it guides like the light hand.
  bool is_push = false;
};

enum class Hand { none, push, light, arm, firm };
HandModel hand_model(Hand hand) noexcept;

/// What the hand means to do, from one time on; between keys all is interpolated linearly.
struct HandKey {
  double time_s = 0.0;             ///< ascending
  Vec3 place_mm;                   ///< where the handle should be
  double press_n = 0.0;            ///< how hard it presses there, along `direction`
  Vec3 direction{0.0, -1.0, 0.0};  ///< unit length
  bool holds = true;               ///< false: lets go, from this key to the next
  bool is_active = false;          ///< holds the button, from this key to the next
};

/// The hand's intent at a time.
struct HandIntent {
  Vec3 place_mm;
  Vec3 velocity_mm_per_s;  ///< of the place
  double press_n = 0.0;
  Vec3 direction{0.0, -1.0, 0.0};
  bool holds = false;
  bool is_active = false;
};

/// A series of keys. Before the first and after the last the hand stays as there.
class HandPlan {
 public:
  /// `keys`: at least one, times ascending (asserted).
  explicit HandPlan(std::vector<HandKey> keys);
  HandIntent at(double time_s) const noexcept;  ///< Realtime
  double end_s() const noexcept { return keys_.back().time_s; }
  const HandKey& first() const noexcept { return keys_.front(); }

 private:
  std::vector<HandKey> keys_;
};

}  // namespace argil::haptics
