// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "argil/core/vec3.h"

namespace argil::haptics {

/// A hand as mass, damper and spring between the handle and where the person means it to be. The
/// models are brackets, not people: what is quiet for all of them is quiet for a person. `arm` is
/// measured (docs/theory.md, "Hands").
struct HandModel {
  const char* name = "none";
  /// Moves with the handle; >= 0.
  double mass_kg = 0.0;
  /// Of the damper to the intended position; >= 0.
  double damping_n_s_per_m = 0.0;
  /// Of the spring to the intended position; >= 0.
  double stiffness_n_per_m = 0.0;
  /// Pushes with a force that nothing resists or damps along its direction, the worst case; across
  /// it, and while it does not press, it guides like the light hand.
  bool is_push = false;
};

/// From the least stable to the most: `push` is the worst case.
enum class Hand { none, push, light, arm, firm };
/// Its mass, damping and stiffness.
HandModel hand_model(Hand hand) noexcept;

/// What the hand means to do, from one time on. Between keys positions, forces and directions are
/// interpolated linearly.
struct HandKey {
  /// Ascending from key to key.
  double time_s = 0.0;
  /// Where the handle should be.
  Vec3 place_mm;
  /// How hard the hand presses there, along `direction`.
  double press_n = 0.0;
  /// Unit length.
  Vec3 direction{0.0, -1.0, 0.0};
  /// False: lets go, from this key to the next.
  bool holds = true;
  /// Holds the button, from this key to the next.
  bool is_active = false;
};

/// What the hand means to do at a time.
struct HandIntent {
  Vec3 place_mm;
  /// Of place_mm.
  Vec3 velocity_mm_per_s;
  double press_n = 0.0;
  /// Unit length.
  Vec3 direction{0.0, -1.0, 0.0};
  bool holds = false;
  bool is_active = false;
};

/// Where a hand's intent comes from: a plan (HandPlan), or a person on another thread (GuidedHand).
///
/// Threads  Realtime: `at` is for the servo's thread; noexcept, no allocation, lock, system call.
class HandSource {
 public:
  virtual ~HandSource() = default;

  /// The intent at a time of the servo's clock. It is asked several times in a tick, with times
  /// that never fall.
  virtual HandIntent at(double time_s) noexcept = 0;

  /// Where the hand begins, before the first `at`.
  virtual Vec3 start_mm() const noexcept = 0;

 protected:
  HandSource() = default;
  HandSource(const HandSource&) = default;
  HandSource& operator=(const HandSource&) = default;
};

/// A series of keys. Before the first and after the last the hand does what that key says.
class HandPlan final : public HandSource {
 public:
  /// `keys`: at least one, times ascending, positions within kMaxReachMm.
  explicit HandPlan(std::vector<HandKey> keys);
  HandIntent at(double time_s) noexcept override;
  Vec3 start_mm() const noexcept override { return keys_.front().place_mm; }

 private:
  std::vector<HandKey> keys_;
};

}  // namespace argil::haptics
