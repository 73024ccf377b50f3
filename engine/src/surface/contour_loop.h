// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
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
  std::uint32_t vertex = 0;
  std::uint32_t planes = 0;
};

/// How a loop is closed, whatever its vertices.
struct LoopShape {
  std::uint16_t length = 0;  ///< corners, 3 or more
  std::uint8_t joins = 0;    ///< of 4: bit f for the diagonal from f to f + 2; of 5: bit f for the
                             ///< fan about f. Only those that lie in no plane of the body
  bool is_in_a_plane = false;  ///< of the body

  /// One of six corners or more, and one of four or five without a join.
  bool has_centre() const noexcept { return length > 3 && joins == 0; }
};

/// That of a loop with these LoopCorner::planes.
/// Shapes  at least 3.
LoopShape shape_of(std::span<const std::uint32_t> planes) noexcept;

/// The convex body a loop lies on: where a centre vertex may go.
struct LoopBody {
  Vec3 min;  ///< the box a centre is clamped into, already shrunk
  Vec3 max;
  Vec3 middle;  ///< a point well inside, toward which the centre of a flat loop is drawn
  /// The body is that box, so that a centre may leave the corners' mean.
  bool is_box = true;
};

/// Fills a loop that has no centre: of its triangulations without a diagonal in a plane of the body
/// that whose worst triangle is best.
/// Shapes  vertices of the mesh; they wind counter-clockwise seen from outside the clay.
void fill_plainly(std::span<const std::uint32_t> loop, const LoopShape& shape, ContourMesh& mesh);

/// The same for one of four corners, of which it is known which diagonal it takes.
inline void fill_along(const std::array<std::uint32_t, 4>& loop, bool is_even, Triangle* out) {
  out[0] = is_even ? Triangle{loop[0], loop[1], loop[2]} : Triangle{loop[1], loop[2], loop[3]};
  out[1] = is_even ? Triangle{loop[0], loop[2], loop[3]} : Triangle{loop[1], loop[3], loop[0]};
}

/// Fills a loop with a fan about a new vertex: the mean of the corners, kept inside the body.
void fill_about_centre(std::span<const std::uint32_t> loop, const LoopShape& shape,
                       const LoopBody& body, ContourMesh& mesh);

/// Whether two of the triangles from `first` on touch in more than the vertices they share, in
/// double precision or after rounding positions to float. Errs toward true. Quadratic.
/// `size_mm`: the extent of the cell, which sets what counts as zero.
bool triangles_cross(const ContourMesh& mesh, std::size_t first, double size_mm);

}  // namespace argil
