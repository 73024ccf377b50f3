// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "argil/core/vec3.h"

namespace argil::mesh {

/// What is up when a solid has come to rest on a plane, after it was put down on it with `up` up
/// and rolled, without slipping or gathering speed, about the point and then the edge that it stood
/// on: a facet of its convex hull is then below with the centre of mass above it.
///
/// Shapes       points: the vertices, not all in a plane; `up` of unit length.
/// Returns      a unit vector; `up` itself where the solid already rests.
/// Cost         some ten passes over the points.
Vec3 rested_up(std::span<const Vec3> points, const Vec3& centre, const Vec3& up);

}  // namespace argil::mesh
