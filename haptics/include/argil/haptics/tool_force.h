// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/field_window.h"
#include "argil/core/vec3.h"

namespace argil::haptics {

// Notation (../shared/facts/theory.md section C): phi signed distance, negative inside; u = max(0,
// 1 - phi / skin) the density, 1 on the surface; w the tool's kernel, integral 1; kappa the clamp.

enum class ForceLaw {
  energy,  ///< F = integral of grad(w) Phi(u): conservative, commutes with level averaging
           ///< (default)
  blanch,  ///< F = -f0 integral of w g min(u^e, kappa), g the unit gradient of u: the report's eq.
           ///< 2
};

/// The clay as felt. Every field says its unit, its usual value and its limits.
struct ForceMaterial {
  double surface_force_n = 3.0;    ///< f_c0: the point force on the surface; 0 to 8
  double exponent = 2.0;           ///< e: 1 to 8; larger is softer outside and harder inside
  double skin_mm = 8.0;            ///< l: where u falls from 1 to 0; > 0; small is stiff
  double clamp_ratio = 8.0 / 3.0;  ///< kappa: the force saturates at kappa * f_c0; > 1
  double viscosity_force_n =
      1.0;  ///< f_v0 of eq. 1: drag on the surface at speed 1 / alpha; 0 to 8
  double viscosity_s_per_mm = 0.01;  ///< alpha of eq. 1; >= 0
};

enum class ToolShape {
  ellipsoid,  ///< a ball when its radii are equal
  box,
  capsule,  ///< along its z axis, radius radii_mm.x, which radii_mm.y equals; z at least as much
};

/// The tool as felt: a smooth kernel that feels as the uniform body of this shape does.
struct ForceTool {
  ToolShape shape = ToolShape::ellipsoid;
  Vec3 radii_mm{1.0, 1.0, 1.0};  ///< half its extent along each of its axes, each > 0
  Vec3 position_mm;
  Quat orientation;  ///< unit length
  Vec3 velocity_mm_per_s;
  Vec3 angular_velocity_rad_per_s;
};

struct ForceResult {
  Vec3 contact_n;    ///< what the clay pushes the tool with
  Vec3 viscosity_n;  ///< drag, opposing the motion
  Vec3 contact_nmm;  ///< torque about the tool's centre
  Vec3 viscosity_nmm;
  double energy_nmm = 0.0;          ///< stored energy of the energy law (0 for blanch)
  double stiffness_n_per_mm = 0.0;  ///< how fast the force grows with depth; only LatticeForce
  double error_n = 0.0;             ///< bound of the error of contact_n; only LatticeForce
  int samples = 0;                  ///< nodes summed over
  bool outside_window = false;      ///< the kernel's support left the window: the result is partial
};

/// The volume force on one window: sums over the window's own nodes under the kernel, first moment
/// renormalised so that a linear Phi gives the exact force at any placement of the lattice. The
/// energy law gives a ball no contact torque. Where fewer than 32 nodes lie under the kernel, or it
/// is thinner than the lattice resolves, the result is that of `point_force`.
///
/// Accuracy the energy law at N nodes across the diameter, p95 against 3N and more: N = 8 0.04 % on
///          smooth fields, 0.4 % at an edge; N = 16 0.002 % and 0.11 %. blanch at N = 8 0.8 % and
///          7 %: a unit gradient jumps at an edge. VolumeForce.DoesNotDependOnTheResolution.
/// Threads  Realtime: noexcept, no allocation, no lock; cost linear in `samples`, about 22 ns each
///          (energy) or 35 ns (blanch).
/// Source   ../shared/facts/theory.md C.1, C.5.
ForceResult volume_force(const FieldWindowView& window, const ForceTool& tool,
                         const ForceMaterial& material, ForceLaw law) noexcept;

/// The force at the tool's centre alone: eq. 2 and eq. 1 of the report, trilinear phi and central
/// differences of it. No torque; `samples` is 1, or 0 outside the window, where all is zero.
/// Threads  Realtime.
ForceResult point_force(const FieldWindowView& window, const ForceTool& tool,
                        const ForceMaterial& material) noexcept;

/// phi in mm at a place, trilinear; 0 outside the window.
double distance_at(const FieldWindowView& window, const Vec3& place_mm) noexcept;

/// How far the kernel reaches along each axis for these radii: 1.61 times the radius.
inline constexpr double kKernelSupport = 1.61;
/// The same for a box, along its own axes: the square root of 3.
inline constexpr double kBoxSupport = 1.7320508075688772;

/// True when on flat clay the point force equals the integral within 1 %: R <= skin * u * sqrt(0.1
/// / (e (e-1))), and no kink of the law (u = 0, or where the clamp sets in) under the kernel.
bool point_is_enough(double radius_mm, double phi_mm, const ForceMaterial& material) noexcept;

/// The same for the tool on the clay of a window that holds its support: also false where the
/// distance bends so much under the kernel that this would show (edges, slots, small balls).
bool point_is_enough(const FieldWindowView& window, const ForceTool& tool,
                     const ForceMaterial& material) noexcept;

}  // namespace argil::haptics
