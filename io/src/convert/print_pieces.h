// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "argil/core/pace.h"
#include "argil/core/result.h"
#include "argil/engine/clay.h"
#include "argil/io/print_preparation.h"

#include "convert/print_frame.h"

namespace argil::io {

/// A grid of equal boxes that a piece on the bed is cut into, as few as fit the bed.
struct PieceGrid {
  std::array<int, 3> counts{1, 1, 1};
  Box3 box;  ///< of the whole

  bool is_whole() const noexcept { return counts == std::array<int, 3>{1, 1, 1}; }
  Box3 cell(const std::array<int, 3>& at) const noexcept;
};
PieceGrid pieces_for(const Box3& box, const Vec3& bed_mm) noexcept;

/// A pin across a cut, half of it in either piece.
struct Plug {
  Vec3 middle_mm;  ///< on the cut, on the bed's frame
  std::size_t axis = 0;
  std::array<int, 3> cell{};  ///< the piece before the cut; the other is the next along the axis
};

struct PlugPlan {
  std::vector<Plug> plugs;
  double radius_mm = 0.0;  ///< half of a plug is twice that long
  int joints_without = 0;
};

/// Two plugs for each cut between two pieces, as far apart as its section allows; one where there
/// is room for one only. All of the same radius, the largest of 4, 3, 2, 1.5 and 1 mm that has room
/// in every joint, or else in some.
PlugPlan plugs_for(const Clay& clay, const PrintFrame& frame, const PieceGrid& grid,
                   double tolerance_mm);

/// One piece of the grid, with the holes of its plugs, on the bed where it was in the whole.
/// `plugs_for` and this leave the clay as it is.
/// Errors  as Clay::apply; throws Interrupted.
Result<TriangleMesh> cut_piece(const Clay& clay, const PrintFrame& frame, const PieceGrid& grid,
                               const std::array<int, 3>& at, const PlugPlan& plan,
                               double tolerance_mm, const Pace& pace);

/// The piece turned so that a cut face is below, where it has one and fits the bed so.
TriangleMesh laid_on_cut(TriangleMesh piece, const PieceGrid& grid, const std::array<int, 3>& at,
                         const Vec3& bed_mm);

/// All plugs side by side, standing on z = 0.
TriangleMesh plugs_to_print(const PlugPlan& plan);

}  // namespace argil::io
