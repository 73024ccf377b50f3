// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "argil/core/vec3.h"

namespace argil::evaluation {

/// A signed distance in mm, negative inside; callable from several threads.
using Distance = std::function<double(const Vec3&)>;

// Exact everywhere, inside and outside.

Distance ball(double radius_mm);
/// A ring about z.
Distance torus(double ring_mm, double tube_mm);
/// A box about the origin with its edges rounded by `rounding_mm`, less than its halves.
Distance box(const Vec3& half_mm, double rounding_mm);

/// A box with its top at z = 0 and the height field z = amplitude sin(kx) sin(ky), k = 2 pi /
/// wavelength, in place of that top. Exact but above the rim of the top.
///
/// Accuracy  within 0.005 finest voxels of the chart (0.00125 mm) but next to medial sheets: near
///           the surface interpolated from a table of closest points, above and below from the
///           nearest crest or trough, which is a paraboloid there.
Distance rough_box(double half_side_mm, double depth_mm, double amplitude_mm, double wavelength_mm);

/// The same body turned about the origin.
Distance turned(const Quat& by, Distance body);

/// The unit gradient by the distances at the corners of a tetrahedron, `probe_mm` (above 0) from
/// the centre along each axis.
Vec3 direction(const Distance& distance, const Vec3& point, double probe_mm);

}  // namespace argil::evaluation
