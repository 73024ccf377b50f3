// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/field_window.h"
#include "argil/core/vec3.h"

namespace argil::haptics {

// Notation (docs/forces.md): phi signed distance in mm, negative inside; u = max(0, 1 - phi / skin)
// the density, 1 on the surface; w the tool's kernel, integral 1; kappa the clamp.

/// Which integral over the tool's body is the contact force.
enum class ForceLaw {
  /// F = integral of grad(w) Phi(u): conservative, and commutes with averaging levels (default).
  energy,
  /// F = -f_c0 integral of w g min(u^e, kappa), g the unit gradient of u: eq. 2 of Blanch et al.
  /// 2004 over the body. Not conservative: closed paths gain work (docs/forces.md).
  blanch,
};

/// The clay as it is felt.
struct ForceMaterial {
  /// f_c0, N: the point force on the surface; usual 3, 0 to 8.
  double surface_force_n = 3.0;
  /// e, no unit; usual 2, 1 to 8. Larger is softer outside the surface and harder inside.
  double exponent = 2.0;
  /// l, mm: where u falls from 1 to 0; usual 8, > 0. Small is stiff; the stiffness on the surface
  /// is e f_c0 / l.
  double skin_mm = 8.0;
  /// kappa, no unit: the force saturates at kappa f_c0; usual 8/3, > 1.
  double clamp_ratio = 8.0 / 3.0;
  /// f_v0 of eq. 1, N: drag on the surface at speed 1 / alpha; usual 1, 0 to 8.
  double viscosity_force_n = 1.0;
  /// alpha of eq. 1, s/mm; usual 0.01, >= 0. From alpha f_v0 = 0.38 N s/mm on a free handle is
  /// unstable at 1 kHz (docs/theory.md, "Damping").
  double viscosity_s_per_mm = 0.01;
};

enum class ToolShape {
  /// A ball when its radii are equal.
  ellipsoid,
  box,
  /// Along its z axis; radius radii_mm.x, which radii_mm.y equals, half length radii_mm.z >= x.
  capsule,
};

/// The tool as it is felt: a smooth kernel with the second moment of the uniform body of this
/// shape.
struct ForceTool {
  ToolShape shape = ToolShape::ellipsoid;
  /// Half its extent along each of its axes, mm; each > 0.
  Vec3 radii_mm{1.0, 1.0, 1.0};
  /// Of its centre, in the window's frame.
  Vec3 position_mm;
  /// From the tool's axes to the window's; unit length.
  Quat orientation;
  Vec3 velocity_mm_per_s;
  Vec3 angular_velocity_rad_per_s;
};

/// Forces on the tool, torques about its centre, in the window's frame.
struct ForceResult {
  /// What the clay pushes the tool with.
  Vec3 contact_n;
  /// Drag, against the motion.
  Vec3 viscosity_n;
  Vec3 contact_nmm;
  Vec3 viscosity_nmm;
  /// Stored energy of the energy law; 0 for blanch.
  double energy_nmm = 0.0;
  /// How fast the force grows with depth; LatticeForce only.
  double stiffness_n_per_mm = 0.0;
  /// Bound of the error of contact_n, which 99 % of poses keep; LatticeForce only.
  double error_n = 0.0;
  /// Nodes summed over.
  int samples = 0;
  /// The kernel's support left the window: the result is partial.
  bool outside_window = false;
};

/// The volume force summed over the window's own nodes under the kernel, first moment renormalised
/// so that a linear Phi gives the exact force wherever the lattice lies. The reference that
/// LatticeForce is checked against: its cost grows with the window's resolution.
///
/// A ball has no contact torque under the energy law. Where fewer than 32 nodes lie under the
/// kernel, or it is thinner than the lattice resolves, the result is that of `point_force`.
///
/// Accuracy the energy law at N nodes across the diameter, p95 against 3 N and more: N = 8 0.04 %
///          on smooth fields, 0.4 % at an edge; N = 16 0.002 % and 0.11 %. blanch at N = 8 0.8 %
///          and 7 %: a unit gradient jumps at an edge
///          (VolumeForce.DoesNotDependOnTheResolution).
/// Threads  Realtime: noexcept, no allocation, no lock.
/// Cost     linear in `samples`: 22 ns each (energy) or 35 ns (blanch).
/// Source   docs/forces.md, "The laws" and "The plain sum".
ForceResult volume_force(const FieldWindowView& window, const ForceTool& tool,
                         const ForceMaterial& material, ForceLaw law) noexcept;

/// The force at the tool's centre alone, from the trilinear phi and its central differences. No
/// torque; `samples` is 1, or 0 outside the window, where all is zero.
///
/// Threads  Realtime.
/// Source   eq. 1 (viscosity) and 2 (contact) of Blanch et al. 2004.
ForceResult point_force(const FieldWindowView& window, const ForceTool& tool,
                        const ForceMaterial& material) noexcept;

/// phi in mm at a position, trilinear; 0 outside the window.
double distance_at(const FieldWindowView& window, const Vec3& position_mm) noexcept;

/// How far the kernel of an ellipsoid or a capsule reaches, in radii: 1.61 ~ sqrt(13 / 5), where
/// its second moment is that of the uniform ball.
inline constexpr double kKernelSupport = 1.61;
/// The same for a box, in half sides along its own axes: the square root of 3.
inline constexpr double kBoxSupport = 1.7320508075688772;

/// Whether on flat clay the point force equals the volume force of a ball within 1 %: R <= skin u
/// sqrt(0.1 / (e (e - 1))), and no kink of the law (u = 0, or where the clamp sets in) under the
/// kernel.
bool point_is_enough(double radius_mm, double phi_mm, const ForceMaterial& material) noexcept;

/// The same for a tool on the clay of a window that holds its support: also false where the
/// distance bends so much under the kernel that it would show (edges, slots, small balls).
/// PointEnergyForce.IsTheSumWhereItIsEnough.
bool point_is_enough(const FieldWindowView& window, const ForceTool& tool,
                     const ForceMaterial& material) noexcept;

}  // namespace argil::haptics
