// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "argil/core/triangle_mesh.h"

namespace argil {

/// The triangles of one block while they are made, and its vertices so far.
struct ContourMesh {
  std::vector<std::uint64_t> keys;  ///< which lattice edge it lies on; kNoKey: seen by no one else
  std::vector<Vec3> positions;      ///< mm
  std::vector<Vec3> normals;        ///< unit, outward
  std::vector<Triangle> triangles;

  static constexpr std::uint64_t kNoKey = ~std::uint64_t{0};

  std::uint32_t add_vertex(std::uint64_t key, const Vec3& position, const Vec3& normal);
  void clear() noexcept;
};

/// A corner of a loop. `planes` has a bit for every plane of the convex body around the loop (a
/// cell's faces, a pyramid's sides) that the corner lies in.
struct LoopCorner {
  Vec3 position;
  std::uint32_t vertex = 0;
  std::uint32_t planes = 0;
};

/// The convex body a loop lies on: where a centre vertex may go.
struct LoopBody {
  Vec3 min;  ///< the box a centre is clamped into, already shrunk
  Vec3 max;
  Vec3 middle;  ///< a point well inside, toward which the centre of a flat loop is drawn
};

/// Whether a loop is closed about a centre vertex: one of six corners or more, and one of whose
/// diagonals each lies in a plane of the body. Asks for nothing of the corners but their planes.
/// Shapes  at least 3 corners.
bool needs_centre(std::span<const LoopCorner> loop) noexcept;

/// Fills a loop that needs no centre: of its triangulations without a diagonal in a plane of the
/// body that whose worst triangle is best.
/// Shapes  3 to 5 corners; they wind counter-clockwise seen from outside the clay.
void fill_plainly(std::span<const LoopCorner> loop, ContourMesh& mesh);

/// Fills a loop with a fan about the vertex `centre` of the mesh, which is put in its place: the
/// mean of the corners, kept inside the body.
void fill_about_centre(std::span<const LoopCorner> loop, const LoopBody& body, std::uint32_t centre,
                       ContourMesh& mesh);

/// Whether two of the triangles from `first` on touch in more than the vertices they share, in
/// double precision or after rounding positions to float. Errs toward true. Quadratic.
/// `size_mm`: the extent of the cell, which sets what counts as zero.
bool triangles_cross(const ContourMesh& mesh, std::size_t first, double size_mm);

}  // namespace argil
