// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/vec3.h"
#include "argil/engine/display_surface.h"
#include "argil/engine/pick.h"
#include "argil/engine/sculpture.h"
#include "argil/engine/stroke.h"

#include "picture/camera.h"

// Between the frame of the sculpture, in which the window looks and points, and that of a piece, in
// which its clay is stored and worked (placed and unplaced of sculpture.h, for more than points).
// Lengths stay what they are. Placements are of unit length, as a sculpture keeps them.
namespace argil::viewer {

/// A direction of the piece's frame in the sculpture, and back.
Vec3 turned(const Placement& placement, const Vec3& direction) noexcept;
Vec3 turned_back(const Placement& placement, const Vec3& direction) noexcept;

/// What stays the same picture, as the piece sees it.
Lens unplaced(const Placement& placement, const Lens& lens) noexcept;
DisplayView unplaced(const Placement& placement, DisplayView view) noexcept;
Ray unplaced(const Placement& placement, const Ray& ray) noexcept;
StrokeSample unplaced(const Placement& placement, StrokeSample sample) noexcept;

Pick placed(const Placement& placement, Pick pick) noexcept;
/// The box around a piece's box where it stands; an empty one stays empty.
Box3 placed(const Placement& placement, const Box3& box_mm) noexcept;

bool are_same(const Placement& a, const Placement& b) noexcept;
Placement moved(Placement placement, const Vec3& by_mm) noexcept;
/// Turned about an axis of unit length of the sculpture, through a point there, as by the right
/// hand.
Placement turned_about(const Placement& placement, const Vec3& point_mm, const Vec3& axis,
                       double angle_deg) noexcept;

/// Where a piece stands that became so many times as large about a point of the sculpture.
Placement scaled_about(const Placement& placement, const Vec3& point_mm, double factor) noexcept;

/// What a lens sees where all lengths are divided by `scale`, above 0: the same picture.
Lens shrunk(Lens lens, double scale) noexcept;

/// A piece's colour in linear light, as renderers take it.
Vec3 linear_of(const Rgb8& color) noexcept;

/// Turns about the sculpture's x, then y, then z, in degrees (Blender's XYZ), and back: x and z
/// from -180 to 180, y from -90 to 90; where y is 90 either way, z is 0.
Quat orientation_of(const Vec3& turns_deg) noexcept;
Vec3 turns_of(const Quat& orientation) noexcept;

}  // namespace argil::viewer
