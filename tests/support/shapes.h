// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/triangle_mesh.h"

namespace argil::test {

/// Six sides, 12 triangles, outward, centred at `center_mm`.
TriangleMesh box_mesh(const Vec3& size_mm, const Vec3& center_mm = {});

/// A closed grid of `rings` x `segments` quads around an axis, outward; genus 1.
TriangleMesh torus_mesh(double radius_mm, double tube_mm, int segments, int rings);

/// A tube twice around, through its own side as a Klein bottle goes; 20 mm across.
TriangleMesh self_crossing_mesh();

/// An octahedron split `splits` times and pushed onto the sphere: 8 * 4^splits triangles, outward.
TriangleMesh ball_mesh(double radius_mm, int splits, const Vec3& center_mm = {});

/// Both meshes in one, sharing nothing.
TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b);

/// The same surface seen from the other side.
TriangleMesh inside_out(TriangleMesh mesh);

/// The mesh without triangle number `index`.
TriangleMesh without(TriangleMesh mesh, std::size_t index);

/// The triangles of `mesh` whose middle has at least that z.
TriangleMesh cut_above(const TriangleMesh& mesh, double z_mm);

}  // namespace argil::test
