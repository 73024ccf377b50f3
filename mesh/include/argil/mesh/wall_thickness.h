// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "argil/core/pace.h"
#include "argil/core/triangle_mesh.h"

namespace argil::mesh {

/// What was found about the thickness at a triangle.
struct TriangleThickness {
  /// The thinnest of its places; infinite where nothing lies opposite.
  double least_mm = std::numeric_limits<double>::infinity();
  Vec3 at_mm{};           ///< that place
  double thin_mm2 = 0.0;  ///< of its area, what is thinner than asked
};

/// How thick the solid is under the surface: the diameter of the largest ball that touches the
/// surface at a place from within and reaches no surface that faces the other way, to 60 degrees.
/// So the sides of a wedge of up to 60 degrees are a wall, thinner and thinner towards its edge,
/// and those of a blunter edge are none. Where that ball is larger than `asked_mm`, the way along
/// the inward normal of the triangle's middle to the first triangle that faces away stands for it.
///
/// Shapes       any triangles, in mm; `asked_mm` above 0. One entry for each triangle; those
///              without area have nothing opposite, and what repeats another triangle is asked
///              no more than where a ray ends.
/// Accuracy     a place that holds a disc as wide as `asked_mm` is never missed, whatever the
///              triangles: those longer than half of that are looked at in parts. Where all long
///              triangles together would have more than four million (at 0.8 mm: 70 000 mm^2) parts
///              and disc grow. Thickness within a thousandth (KnownWalls.*).
/// Determinism  same bits for any number of threads and order of triangles.
/// Errors       throws Interrupted and std::bad_alloc: to be called within no_throw.
/// Threads      any thread; spreads over TBB. `pace` is told on the one that called this.
/// Cost         1 us of CPU time for each triangle or part that is thick enough, 3 for one that is
///              not; 20 where what is asked is 50 triangles wide.
/// Source       maximal inscribed balls: T. Hildebrand, P. Ruegsegger, "A new method for the
///              model-independent assessment of thickness in three-dimensional images", J.
///              Microscopy 185 (1997); shrinking a ball at a place: J. Ma, S. W. Bae, S. Choi, "3D
///              medial axis point approximation using nearest neighbors and the normal field",
///              Visual Computer 28 (2012).
std::vector<TriangleThickness> wall_thickness(const TriangleMesh& mesh, double asked_mm,
                                              const Pace& pace);

/// The same on the outside: how wide the gap is between the surface and what faces it.
std::vector<TriangleThickness> gap_width(const TriangleMesh& mesh, double asked_mm,
                                         const Pace& pace);

/// What measures walls for a check: the triangles, as above, or the field of the clay that they
/// were extracted from.
using WallMeasure = std::function<std::vector<TriangleThickness>(const TriangleMesh&,
                                                                 double asked_mm, const Pace&)>;

}  // namespace argil::mesh
