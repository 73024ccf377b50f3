// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "argil/core/vec3.h"

namespace argil::haptics {

// Frame: the device's own, origin on the base plane of the arms' hinges and on the device's axis; x
// to the right, y up, z out of the device towards the user. Millimetres.
//
// Notation (docs/theory.md, "Falcon"): leg i lies in the plane of u = (cos phi, sin phi, 0) and z,
// and v = z x u is across it. The driven arm a turns by theta, from u towards z, and carries the
// parallelogram b; stubs at both of its ends add L0 along the leg's plane. A tick is a count of the
// encoder; ticks rise as the arm swings outwards, and a positive motor word drives them down.

/// One number for each leg: 1 at the top, 2 right, 3 lower left, as the wire orders them.
using LegValues = std::array<double, 3>;

/// All constants of a Falcon. Sources differ by 5 mm in the radii and by 2 cm in absolute z, so
/// take the set that was measured, and let nothing depend on absolute z (docs/theory.md, "Falcon").
struct FalconGeometry {
  /// a: hinge to knee; > 0.
  double arm_mm = 0.0;
  /// b: side of the parallelogram; > 0.
  double rod_mm = 0.0;
  /// At each end of the parallelogram; >= 0. Both together are L0.
  double stub_mm = 0.0;
  /// r: of the arm's hinge along u.
  double hinge_radial_mm = 0.0;
  /// c: of the platform's joint along u.
  double joint_radial_mm = 0.0;
  /// s: of the arm's hinge along v.
  double hinge_tangential_mm = 0.0;
  /// f: of the platform's joint along v.
  double joint_tangential_mm = 0.0;
  /// phi: directions of the legs.
  LegValues leg_deg{};
  /// Encoder counts of a whole turn of the motor; > 0.
  double counts_per_turn = 0.0;
  /// Turns of the motor for one of the arm; > 0.
  double gear_ratio = 0.0;
  /// theta at count 0.
  double tick_zero_deg = 0.0;
  /// Motor words for one newton metre at the arm; > 0.
  double words_per_nm = 0.0;
};

/// The constants of libnifalcon, whose words per torque are a guess that felt right.
FalconGeometry libnifalcon_geometry() noexcept;

/// Those of S. Martin, N. Hillier, "Characterisation of the Novint Falcon haptic device for
/// application as a robot manipulator", ACRA 2009, as later code cites them, with theta at tick 0
/// as a user measured it again (40 degrees; the paper has 50) and the motors at rest as the paper
/// identified them: their turning, which changes the force by about 2 % at 0.2 m/s, is left out.
FalconGeometry martin_hillier_geometry() noexcept;

/// The middle of the workspace, which is well inside for both sets. Positions about the middle are
/// `position - kFalconCenterMm`.
inline constexpr Vec3 kFalconCenterMm{0.0, 0.0, 130.0};
/// The radius of a ball around it that both sets can reach, far from any singularity.
inline constexpr double kFalconUsableRadiusMm = 40.0;

/// Largest motor word. What the firmware does with a larger one is not known.
inline constexpr int kFalconLargestWord = 4095;

/// Where a Falcon's handle is, by which angles of its arms, and which motor words give a force
/// there.
///
/// Accuracy position_of(angles_of(P)) is P to 1e-12 m (FalconKinematics.PositionOfAnglesIsInverse).
/// Threads  Realtime: all may be called every tick; the constructor takes a few sines.
/// Cost     0.35 us for position_of from a near start, 0.2 us for motor_words.
/// Source   R. E. Stamper, "A three degree of freedom parallel manipulator with only translational
///          degrees of freedom", PhD thesis, University of Maryland (1997), for the mechanism. Ours
///          keeps the stubs exactly, where codes that intersect spheres cannot.
class FalconKinematics {
 public:
  explicit FalconKinematics(const FalconGeometry& geometry) noexcept;

  /// theta in radians for a position of the handle, elbows outward; none where it is out of reach.
  std::optional<LegValues> angles_of(const Vec3& position_mm) const noexcept;

  /// What Newton's method found.
  struct Solution {
    /// Where it did not converge, the last one tried.
    Vec3 position_mm;
    /// Newton steps made, the last one too short to matter.
    int steps = 0;
    bool is_converged = false;
  };

  /// Where the handle is at these angles, by Newton's method from a position near it (usually the
  /// last one), or from kFalconCenterMm where that is out of reach. Steps are bounded to 20 mm and
  /// to where the loops still close, so that it converges from far as well: 4 steps from 1 mm away,
  /// 8 from the middle of the workspace. Not converged after kMostSteps, or on a branch that the
  /// device cannot be on.
  Solution position_of(const LegValues& angles_rad, const Vec3& start_mm) const noexcept;
  static constexpr int kMostSteps = 20;

  LegValues angles_of_ticks(const LegValues& ticks) const noexcept;
  LegValues ticks_of_angles(const LegValues& angles_rad) const noexcept;  ///< not rounded

  /// The inverse Jacobian B by rows: theta_dot = B x_dot, in radians per millimetre. None out of
  /// reach and at singularities (kLeastSine). Forces follow from torques as F = B^T tau.
  std::optional<std::array<Vec3, 3>> rates_of(const Vec3& position_mm) const noexcept;

  struct MotorWords {
    /// The words after scaling, before rounding.
    LegValues exact{};
    /// What goes to the wire.
    std::array<std::int16_t, 3> word{};
    /// Fraction of the force that is given, 1 unless the motors saturate.
    double scale = 1.0;
    /// No force can be made here; words are zero.
    bool is_singular = false;
  };

  /// Motor words for a force on the handle. Beyond what the motors can give, all three words shrink
  /// by one common factor, which keeps the force's direction. Zero where rates_of has no answer,
  /// and for a force that is not finite.
  MotorWords motor_words(const Vec3& force_n, const Vec3& position_mm) const noexcept;

  /// Sine of the smallest angle, between arm and rod of a leg or between the three rods (as the
  /// volume they span), that still counts as regular. In the usable ball they stay above 0.3.
  static constexpr double kLeastSine = 0.02;

 private:
  /// One leg's plane.
  struct Leg {
    Vec3 out;     ///< u
    Vec3 across;  ///< v
  };
  /// One leg's loop at a position: the knee has to be `length` from (along, up) in the leg's plane.
  struct Loop {
    /// X: of the platform's joint from the hinge, along u.
    double along = 0.0;
    /// y.
    double across = 0.0;
    /// Z.
    double up = 0.0;
    /// S: the rod as seen in the leg's plane.
    double rod = 0.0;
    /// L = L0 + S.
    double length = 0.0;
  };
  /// A loop at an angle of its arm.
  struct Closure {
    /// Half the gradient of `error` by the position: where the rod pulls.
    Vec3 pull;
    /// Of the loop, mm^2; zero when it closes.
    double error = 0;
    /// D: the arm's length times the rod's component across the arm, mm^2.
    double lever = 0;
  };
  struct Closures {
    std::array<Vec3, 3> pull;
    LegValues error{};
    LegValues lever{};
    bool is_regular = false;
  };
  std::optional<Loop> loop_of(const Leg& leg, const Vec3& position_mm) const noexcept;
  /// The fraction of a Newton step that may be made from here.
  double allowed_share(const Vec3& position_mm, const Vec3& step) const noexcept;
  /// Where an arm points, in its leg's plane.
  struct Arm {
    double cosine = 1.0;
    double sine = 0.0;
  };
  using Arms = std::array<Arm, 3>;
  std::optional<Arms> arms_at(const Vec3& position_mm) const noexcept;
  Closure closure_of(const Leg& leg, const Loop& loop, const Arm& arm) const noexcept;
  std::optional<Closures> closures_of(const Arms& arms, const Vec3& position_mm) const noexcept;

  std::array<Leg, 3> leg_;
  double arm_mm_;
  double rod_mm_;
  double stubs_mm_;   ///< L0
  double radial_mm_;  ///< rho: from the hinge to the joint of a platform at the origin, along -u
  double across_mm_;  ///< delta: the same along v
  double rad_per_tick_;
  double rad_at_zero_;
  double words_per_nm_;
};

}  // namespace argil::haptics
