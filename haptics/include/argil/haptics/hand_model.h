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

/// Where a hand's intent comes from: a plan (HandPlan), or a person at another thread (GuidedHand).
///
/// Threads  Realtime: `at` is for the servo's thread; noexcept, no allocation, lock, system call.
class HandSource {
 public:
  virtual ~HandSource() = default;

  /// The intent at a time of the servo's clock; asked with times that do not fall, several times in
  /// a tick.
  virtual HandIntent at(double time_s) noexcept = 0;

  /// Where the hand begins, before the first `at`.
  virtual Vec3 start_mm() const noexcept = 0;

 protected:
  HandSource() = default;
  HandSource(const HandSource&) = default;
  HandSource& operator=(const HandSource&) = default;
};

/// A series of keys. Before the first and after the last the hand stays as there.
class HandPlan final : public HandSource {
 public:
  /// `keys`: at least one, times ascending (asserted).
  explicit HandPlan(std::vector<HandKey> keys);
  HandIntent at(double time_s) noexcept override;
  Vec3 start_mm() const noexcept override { return keys_.front().place_mm; }

 private:
  std::vector<HandKey> keys_;
};

}  // namespace argil::haptics
