// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "argil/core/triangle_mesh.h"
#include "argil/core/vec3.h"

namespace argil {

/// The angle of (x, y) in radians, in (-pi, pi] (and -pi itself by rounding), by arithmetic and
/// sqrt alone, so that its bits do not depend on the C library. Absolute error below 1e-13.
/// (0, 0) gives 0. Held to that of std::atan2 by
/// PolarAngle.AgreesWithTheLibraryInAllQuadrants.
double polar_angle(double x, double y) noexcept;

/// Half the solid angle of a triangle as the angle of a complex number (re, im), seen from the
/// origin; positive where the triangle's back is seen (the origin is inside). Products of such
/// numbers add angles up without a function of the C library. Scaled to |re| + |im| = 1, not to
/// unit length: the angle alone counts.
struct HalfAngle {
  double re = 1.0;
  double im = 0.0;
};
/// Corners relative to the origin, which must not overflow when multiplied. A corner at the origin
/// gives the angle 0.
///
/// Source       A. van Oosterom, J. Strackee, "The solid angle of a plane triangle", IEEE Trans.
///              Biomed. Eng. 30 (1983).
HalfAngle half_solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) noexcept;

/// The generalized winding number of a triangle soup: 1 inside a closed outward mesh, 0 outside,
/// between where the soup has gaps, 2 where two closed parts overlap.
///
/// Accuracy     exact (1e-12) for the triangles near a point; whatever is farther than `far_radii`
///              radii of a cluster is its dipole and quadrupole: 0.1 at 2 radii
///              (WindingNumber.TreeAgreesWithTheSum); below 1e-3 at 6.
/// Determinism  same bits for any number of threads: the tree depends on the triangles alone.
/// Threads      `at` from any; built on the caller's alone.
/// Cost         some microseconds per point; 120 bytes a triangle.
/// Source       G. Barill et al., "Fast winding numbers for soups and clouds", SIGGRAPH 2018. Ours
///              differs: near triangles multiply complex numbers, one angle is taken at the end.
class WindingNumber {
 public:
  /// Refers to no argument afterwards: positions are copied into the tree. Every index must exist
  /// and every position be finite; triangles without area are left out. `far_radii` 1.5 to 10: more
  /// is more exact and slower. Throws std::bad_alloc.
  WindingNumber(const std::vector<Vec3>& positions, const std::vector<Triangle>& triangles,
                double far_radii = 2.0);

  /// The winding number at a finite point, in turns; 0 for a soup of nothing.
  double at(const Vec3& point) const noexcept;

  /// At least the size of the winding number at any point of a ball: what the triangles may fill of
  /// the sphere of directions, whichever way they face. Rough: several times too much near them.
  /// At least 1/2 where a triangle is in or beside the ball.
  double most_within(const Vec3& center, double radius) const noexcept;

  /// Whether a triangle comes as near to a point as that.
  bool comes_within(const Vec3& center, double radius) const noexcept;

 private:
  struct Corners {
    Vec3 a, b, c;
  };
  struct Node {
    Vec3 center;          // area-weighted
    double radius = 0.0;  // of the ball around the centre that holds all corners
    double area = 0.0;
    double far2 = 0.0;        // beyond this squared distance from `center` the expansion serves
    Vec3 dipole;              // sum of area * normal
    double quadrupole[3][3];  // sum of area * normal (row) * offset of the centroid (column)
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    std::uint32_t second = 0;  // the second child; the first follows its parent; 0 for a leaf
  };

  void build(std::uint32_t node, std::uint32_t begin, std::uint32_t end,
             std::vector<std::uint32_t>& order, const std::vector<Corners>& all);
  void summarize(Node& node) const noexcept;

  double far_radii_;
  std::vector<Corners> triangles_;  // in tree order
  std::vector<Node> nodes_;
};

/// Triangles that close what is open: each net boundary edge (run along more often one way than the
/// other) joined to the middle of a loop of such edges, turned so that with the input every edge
/// cancels. Loops visit no vertex twice, so that holes that touch are closed each by itself. The
/// apexes are appended to `positions`.
///
/// Returns      one triangle for each time a net boundary edge is run along; none for closed input.
/// Determinism  same triangles every time: edges are taken in the order of their vertices.
/// Cost         n log n in the triangles, for sorting their edges.
std::vector<Triangle> boundary_cones(std::vector<Vec3>& positions,
                                     const std::vector<Triangle>& triangles);

}  // namespace argil
