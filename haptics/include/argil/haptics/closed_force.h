// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/vec3.h"
#include "argil/haptics/tool_force.h"

namespace argil::haptics {

// The volume force where it has a closed form: the kernel is a ball's or an ellipsoid's and the
// distance that of a primitive. The integral is then one over the distance alone, done exactly
// piece by piece where the exponent is whole (to 1e-5 where it is not). On a distance both laws are
// the same integral. No window, no lattice, no error: what scenes of primitives should use, and
// what the lattice is tested against. No viscosity.
//
// Threads  Realtime. Cost about 0.5 us (a fractional exponent 3 us).
// Source   a slice of (1 - r^2)^4 at height z has the share (1 - z^2)^5.

/// The half space dot(normal, x) < offset_mm, normal of unit length. A ball or an ellipsoid.
ForceResult plane_force(const Vec3& normal, double offset_mm, const ForceTool& tool,
                        const ForceMaterial& material) noexcept;

/// A solid ball of clay. The tool must be a ball and must not reach its centre: |position - center|
/// greater than 1.61 radii of the tool.
ForceResult ball_force(const Vec3& center_mm, double radius_mm, const ForceTool& tool,
                       const ForceMaterial& material) noexcept;

}  // namespace argil::haptics
