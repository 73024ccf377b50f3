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
/// phi is linear: through each such edge once, at the place of one vertex of the extracted surface.
/// A piece all of whose edges have vertices that were left out was left out. Pieces are told apart
/// by the boxes of a cell cut in 16 along each axis that phi = 0 passes through: what those of
/// different clusters hold is not connected within the cell. What is not told apart, or where a
/// vertex is not at its edge, counts as kept.
///
/// Units        places within a cell as fractions of it.
/// Threads      any, once made.
/// Cost         the surface's size times the logarithm of how many vertices were left out; 0.2 ms
/// and
///              1 kB for each cell that has both.
class LeftOutParts {
 public:
  /// `cells` of the surface without what was left out. Throws Interrupted.
  LeftOutParts(const TriangleMesh& surface, const TriangleMesh& left_out,
               const std::vector<SurfaceCell>& cells, double voxel_mm, const Pace& pace);

  /// Whether all of phi = 0 in the box from `low` to `low + side` of a cell was left out for sure;
  /// side 0 for a point of it.
  bool has_all(std::uint32_t cell, const Vec3& low, double side) const;

  static constexpr int kBoxes = 16;  ///< along each axis of a cell

 private:
  using Boxes = std::bitset<std::size_t{kBoxes} * kBoxes * kBoxes>;
  class Pieces;
  struct Mixed {
    std::uint32_t cell = 0;
    Boxes left_out;  ///< that phi = 0 passes through, with nothing of it that is kept
    Boxes kept;      ///< the others that it passes through
  };

  template <class IsLeftOut>
  static Mixed mixed_in(const SurfaceCell& cell, const IsLeftOut& is_left_out);

  std::vector<Mixed> mixed_;  ///< cells with something left out, ascending
};

}  // namespace argil::io
