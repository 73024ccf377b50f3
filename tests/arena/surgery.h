// SPDX-License-Identifier: GPL-3.0-or-later
// What faults are made with: parts of meshes chosen, cut, joined and moved.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "argil/core/triangle_mesh.h"

#include "scene/random.h"

namespace argil::arena {

using evaluation::Random;

/// A whole number from 0 to `below` - 1; `below` at least 1.
std::size_t pick(Random& random, std::size_t below);

/// So many different numbers below `below`, in random order; all of them where there are no more.
std::vector<std::size_t> pick_some(Random& random, std::size_t below, std::size_t count);

/// `from` after all of `mesh`, sharing nothing.
void append(TriangleMesh& mesh, const TriangleMesh& from);

void turn_over(Triangle& t);
void turn_over(TriangleMesh& mesh);

/// Turned about its middle, scaled and moved.
TriangleMesh placed(const TriangleMesh& mesh, const Quat& by, double scale, const Vec3& move);

/// Unit normals at the vertices, by the areas of their triangles.
std::vector<Vec3> vertex_normals(const TriangleMesh& mesh);

/// Mean length of the edges at each vertex.
std::vector<double> edge_lengths(const TriangleMesh& mesh);

/// The triangles that hang together, by edges, with `first` and have their middle within `radius`
/// of that of `first`.
std::vector<std::size_t> patch_around(const TriangleMesh& mesh, std::size_t first, double radius);

/// Without the triangles whose numbers are set.
void erase_triangles(TriangleMesh& mesh, const std::vector<bool>& goes);

/// What a plane makes of a closed mesh.
struct Cut {
  TriangleMesh below;  ///< open at the plane
  TriangleMesh above;
  TriangleMesh cap;  ///< in the plane, faces as `normal`; its corners have the bits of the rims'
};

/// None where a vertex lies within a thousandth of a percent of the plane, where the plane meets
/// nothing, or where a rim lies in another.
std::optional<Cut> cut_by_plane(const TriangleMesh& mesh, const Vec3& at, const Vec3& normal);

/// A point within the mesh and how far it is from the surface, about the farthest.
struct InnerBall {
  Vec3 center;
  double radius = 0.0;
};
InnerBall inner_ball(const TriangleMesh& mesh, Random& random);

}  // namespace argil::arena
