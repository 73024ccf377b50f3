// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/vec3.h"
#include "argil/haptics/servo/device.h"
#include "argil/haptics/servo/running_decrement.h"

namespace argil::haptics {

enum class DampingKind {
  /// What the scene and the coupling have (default).
  fixed,
  /// More of it while the handle swings in a contact, by the logarithmic decrement of the swing.
  adaptive,
};

struct DampingOptions {
  DampingKind kind = DampingKind::fixed;
  /// zeta that a swing is brought to; usual 0.3, > 0, below 1. More settles sooner and stiffens
  /// what is struck.
  double damping_ratio = 0.3;
  /// Fraction of the damping that a sampled loop can render which may be added; usual 0.5, > 0, at
  /// most 1. The rest is left to the scene's own damper.
  double share = 0.5;
  /// Most that one count of the encoder may change the force by through what is added; usual 1.5 N,
  /// > 0. More damps stiffer contacts and is felt as a grain while it does.
  double most_count_n = 1.5;
  /// Time constant with which it is taken away again once nothing swings; usual 0.3, > 0. With more
  /// the counts of the encoder buzz in it longer, with less a contact that cannot do without begins
  /// to swing more often.
  double release_s = 0.3;
};

/// The most damping that may be added to a contact, N s/m: `share` of what a loop can render that
/// knows velocities so late, and no more than the encoder's counts allow.
///
/// Units     period_s: T, > 0. velocity_lag_s: of VelocityFilter, >= 0.
/// Accuracy  (pi / 2) m / (T + t_d + lag) is 5 % below the exact limit of raw velocities with one
///           tick of delay, 0.83 m / T (AdaptiveDampingBound.*).
/// Threads   Realtime; pure.
/// Source    docs/theory.md, "Damping".
double most_added_damping_n_s_per_m(const DampingOptions& options, const DeviceTraits& traits,
                                    double period_s, double velocity_lag_s) noexcept;

/// Dynamic damping adjustment: adds to the damper of what is touched as much as the swing of the
/// handle there lacks.
///
/// After each stroke of a swing the decrement says the damping ratio zeta of the loop, hand, delay
/// and scene included, and what is missing to the wanted one is 2 m omega (zeta_wanted - zeta):
/// that much is added, or taken away, within 0 and the bound. m is the device's own mass, so that
/// with a hand's beside it the rule comes to its aim in a few strokes from below. Once nothing
/// swings it is released, and at once when nothing has been touched for half a period of the
/// slowest swing.
///
/// The damper acts along the force of the contact only, so that sliding has no drag, and only while
/// there is one, so that neither has free motion; it may make the force zero, but never turns it
/// round. It opposes the velocity that the servo has measured, and so takes energy from the hand
/// but for the lateness of that and the counts of the encoder: a swing faster than the velocity's
/// lag is not damped, and a handle at the edge of a count is shaken by most_count_n.
///
/// Threads  Realtime.
/// Cost     20 ns in a tick, 0.1 us when a stroke ends.
/// Source   sections 3.4.2 and 3.4.3 of the Falcon report, which names the decrement and no rule
///          (docs/equations.md). The rule is ours; docs/stability.md says what it is good for.
class AdaptiveDamping {
 public:
  /// `traits`: of the device at the nominal period.
  AdaptiveDamping(const DampingOptions& options, const DeviceTraits& traits) noexcept;

  /// The force to give instead of `force_n`, that of the contact at the handle (finite; zero where
  /// nothing is touched), in a tick of `period_s` (> 0) after the handle has moved by `moved_mm`
  /// (finite). `most_n_s_per_m`: what may be added now, >= 0.
  Vec3 tick(const Vec3& force_n, const Vec3& moved_mm, const Vec3& velocity_mm_per_s,
            double period_s, double most_n_s_per_m) noexcept;

  /// What is added now.
  double added_n_s_per_m() const noexcept { return added_n_s_per_m_; }
  const RunningDecrement& swing() const noexcept { return swing_; }

  /// Forgets the swing and adds nothing: for a fault or a jump of the handle.
  void reset() noexcept;

 private:
  void follow(const Vec3& direction, const Vec3& moved_mm, double period_s) noexcept;

  DampingOptions options_;
  double mass_kg_;
  RunningDecrement swing_;
  Vec3 axis_;              ///< of the contact's force; zero: nothing is touched
  double along_mm_ = 0.0;  ///< the way of the handle along the axis since the contact began
  double apart_s_ = 0.0;   ///< since something was touched
  double added_n_s_per_m_ = 0.0;
};

}  // namespace argil::haptics
