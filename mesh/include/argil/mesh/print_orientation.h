// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "argil/core/pace.h"
#include "argil/core/triangle_mesh.h"
#include "argil/core/vec3.h"

namespace argil::mesh {

/// What stands on the bed: lower than this above the lowest point. check_print has it so.
inline constexpr double kOnBedMm = 0.1;

/// What an orientation costs is the sum of these, each times a share between 0 and about 1.
struct OrientationWeights {
  double overhang = 1.0;  ///< overhanging area, of the whole surface
  double scars = 1.0;     ///< what supports touch and eyes see, of the whole surface
  double support = 0.15;  ///< volume of the supports, of the piece's own
  double height = 0.3;    ///< of the diagonal: time, and what shakes
  double contact = 0.2;   ///< 1 minus the contact's width in quarters of the diagonal, if positive
  double tipping = 1.0;   ///< 1 where the centre of mass is over the edge of what it stands on, 0
                          ///< where it is a twentieth of the height within
};

struct OrientationOptions {
  double max_overhang_deg = 50.0;  ///< from the vertical, above 0, below 90: Printer has it
  /// So much is cut off below before it stands, 0 or more: contact is what the cut shows.
  double cut_mm = 0.0;
  OrientationWeights weights = {};
};

/// A way to put a piece on the bed and what it would cost.
struct PrintOrientation {
  Vec3 up{0.0, 0.0, 1.0};  ///< in the mesh's own frame, unit
  double overhang_mm2 = 0.0;
  /// Air under overhangs down to the bed or the piece, by lines a 128th of the diagonal apart.
  double support_mm3 = 0.0;
  /// What supports hang on and stand on, each place by the share of directions it is seen from.
  double scars_mm2 = 0.0;
  double height_mm = 0.0;
  double contact_mm2 = 0.0;  ///< solid at the cut, or at half of kOnBedMm
  /// How far within the hull of the contact the centre of mass is; negative: it tips.
  double footing_mm = 0.0;
  double cost = 0.0;  ///< OrientationWeights
};

/// The shortest turn that brings a unit vector to z.
Quat turn_up(const Vec3& up) noexcept;

/// What one orientation costs.
/// Shapes       closed, outward, with volume; `up` of unit length.
/// Determinism  same bits for any number of threads.
/// Errors       throws Interrupted and std::bad_alloc, as best_orientations.
/// Cost         1.5 us for each triangle, most of it for what is seen.
PrintOrientation orientation_at(const TriangleMesh& mesh, const Vec3& up,
                                const OrientationOptions& options, const Pace& pace);

/// The cheapest orientations, at least 25 degrees from one another, best first: the largest facings
/// of the surface, 200 directions all around, and what each of these comes to rest on, the best
/// dozen refined to a degree. All are judged on a copy that keeps an 80th of the diagonal, the
/// best again on the mesh itself.
///
/// Shapes       as orientation_at; count from 1.
/// Determinism  as orientation_at.
/// Errors       throws Interrupted and std::bad_alloc: to be called within no_throw.
/// Threads      any; spreads over TBB. `pace` is told on the one that called this.
/// Cost         some 3 s of CPU time and 20 us for each triangle.
std::vector<PrintOrientation> best_orientations(const TriangleMesh& mesh,
                                                const OrientationOptions& options,
                                                std::size_t count, const Pace& pace);

/// How a piece stands on the bed as it is, z up, with so much cut off below.
struct BedContact {
  double area_mm2 = 0.0;
  double footing_mm = 0.0;  ///< as PrintOrientation
};
BedContact bed_contact(const TriangleMesh& mesh, double cut_mm);

/// What is up when the piece, put down with `up` up, has rolled until it rests on a flat side or on
/// three points or more. The same shapes; ten passes over the vertices.
Vec3 laid_flat(const TriangleMesh& mesh, const Vec3& up);

/// What is up when the piece rests on the largest of its sides: of what it comes to rest on when it
/// is put down from 200 directions all around and as it is (`up`), the facet of the convex hull
/// with the largest area. Where no other is larger by a thousandth, the one that it comes to rest
/// on as it is.
///
/// Shapes       closed, outward, with volume; `up` of unit length. `slack_mm`, 0 or more: points as
///              near as that to the plane lie on it, so that a side which is flat but for the
///              roughness of its surface counts as a whole; usually a voxel.
/// Determinism  same bits every time.
/// Errors       throws Interrupted and std::bad_alloc: to be called within no_throw. `pace` is
///              asked before each direction and each side, a few passes over the vertices apart.
/// Cost         some 0.3 s of CPU time, and two passes over the vertices for each side that it can
///              rest on.
Vec3 lying_on_most(const TriangleMesh& mesh, const Vec3& up, double slack_mm, const Pace& pace);

}  // namespace argil::mesh
