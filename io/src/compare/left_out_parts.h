// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "argil/core/pace.h"
#include "argil/core/triangle_mesh.h"
#include "argil/core/vec3.h"

#include "compare/cell_set.h"

namespace argil::io {

/// Which of phi = 0 in the cells of a surface belongs to components that were left out of it.
///
/// What phi = 0 has in a cell is of pieces, each of which passes through edges of the cell, where
/// phi is linear: through each such edge once. A vertex of the extracted surface that lies on a
/// lattice edge is the edge's own, whatever else is near; so an edge is of what was left out where
/// such a vertex was, and none that is kept lies on it, nor an even number of vertices that were
/// left out, of which one more must be kept where the ends differ in sign (which the levels of a
/// clay, one apart where they meet, do not bring about). A piece all of whose
/// edges are was left out. Pieces are told apart by the boxes of a cell cut in 16 along each axis
/// that phi = 0 passes through: what those of different clusters hold is not connected within the
/// cell. What is not told apart, and an edge whose vertex was moved off it (docs/surface.md),
/// counts as kept.
///
/// Shapes       surface, left_out: as extracted, not rounded to floats: a vertex lies on its edge
///              to a millionth of it.
/// Units        places within a cell as fractions of it.
/// Determinism  same answers for any number of threads.
/// Threads      any, once made.
/// Cost         the surface's size times the logarithm of how many vertices were left out; 0.2 ms
///              and 1 kB for each cell that has both.
class LeftOutParts {
 public:
  /// `cells` of the surface without what was left out. Throws Interrupted.
  LeftOutParts(const TriangleMesh& surface, const TriangleMesh& left_out,
               const std::vector<SurfaceCell>& cells, double voxel_mm, const Pace& pace);

  /// Whether all of phi = 0 in the box from `low` to `low + side` of a cell was left out for sure;
  /// side 0 for a point of it.
  bool has_all(std::uint32_t cell, const Vec3& low, double side) const;

  /// Vertices of what was left out at which phi = 0 is of a piece with something that is kept, as
  /// far as can be told: ascending, each once.
  const std::vector<std::uint32_t>& ambiguous() const noexcept { return ambiguous_; }

  static constexpr int kBoxes = 16;  ///< along each axis of a cell

 private:
  using Boxes = std::bitset<std::size_t{kBoxes} * kBoxes * kBoxes>;
  class Edges;
  class Pieces;
  struct Mixed {
    std::uint32_t cell = 0;
    Boxes left_out;  ///< that phi = 0 passes through, with nothing of it that is kept
    Boxes kept;      ///< the others that it passes through
  };

  static Mixed mixed_in(const SurfaceCell& cell, const Edges& left_out,
                        std::vector<std::uint32_t>& ambiguous);

  std::vector<Mixed> mixed_;  ///< cells with something left out, ascending
  std::vector<std::uint32_t> ambiguous_;
};

}  // namespace argil::io
