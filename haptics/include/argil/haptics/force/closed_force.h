// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/vec3.h"
#include "argil/haptics/force/tool_force.h"

namespace argil::haptics {

// The volume force where it has a closed form: the kernel is that of a ball or an ellipsoid and the
// field is the distance to a primitive. The integral over the kernel then becomes one over the
// distance alone. No window, no lattice, no viscosity; on a distance field both laws of ForceLaw
// are the same integral. Scenes of primitives should use these, and the lattice is tested against
// them.
//
// Accuracy exact for a whole exponent, piece by piece between the kinks of the law; 1e-5 for a
//          fractional one (ClosedForce.*).
// Threads  Realtime.
// Cost     0.5 us; 3 us with a fractional exponent.
// Source   own: a slice of (1 - r^2)^4 at height z weighs (1 - z^2)^5.

/// Force of the half space dot(normal, x) < offset_mm on a ball or an ellipsoid.
///
/// Units  normal: unit length, out of the clay. offset_mm: mm along it.
ForceResult plane_force(const Vec3& normal, double offset_mm, const ForceTool& tool,
                        const ForceMaterial& material) noexcept;

/// Force of a solid ball of clay on a ball that does not reach its centre: |position - center| must
/// be greater than 1.61 radii of the tool.
///
/// Units  radius_mm: > 0.
ForceResult ball_force(const Vec3& center_mm, double radius_mm, const ForceTool& tool,
                       const ForceMaterial& material) noexcept;

}  // namespace argil::haptics
