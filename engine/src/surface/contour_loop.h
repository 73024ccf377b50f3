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

/// How a loop was closed, for whoever must decide whether to test it.
enum class LoopFill { triangles, centre };

/// Fills a loop with triangles. Up to five corners: of the triangulations without a diagonal in a
/// plane of the body the one whose worst triangle is best; otherwise a fan about a centre vertex.
/// Shapes  at least 3 corners; they wind counter-clockwise seen from outside the clay.
LoopFill fill_loop(std::span<const LoopCorner> loop, const LoopBody& body, ContourMesh& mesh);

/// Whether two of the triangles from `first` on touch in more than the vertices they share, in
/// double precision or after rounding positions to float. Errs toward true. Quadratic.
/// `size_mm`: the extent of the cell, which sets what counts as zero.
bool triangles_cross(const ContourMesh& mesh, std::size_t first, double size_mm);

}  // namespace argil
