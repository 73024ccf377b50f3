// SPDX-License-Identifier: GPL-3.0-or-later
// An outline in a picture, and what of it can matter to a box of that picture: the edges that come
// near, and those that a line to the right meets. Boxes within boxes ask only what mattered to the
// outer one, so that what they cost together follows the boxes and the edges, not their product.
// Notation: x to the right, y up.
#pragma once

#include <vector>

#include "argil/engine/mask_outline.h"

namespace argil {

inline constexpr double kMostPicture = 1e6;  ///< no point lies farther from its middle

/// An edge; or, where it is beyond the box that it was kept for, a chain of them of which only the
/// heights of its ends count: a line from the box to the right meets it an odd number of times
/// where they lie on either side of the line.
struct OutlineEdge {
  PicturePoint a{};
  PicturePoint b{};
  bool is_beyond = false;
};

/// Those of one loop that can matter within a box of the picture, in their order.
using LoopPart = std::vector<OutlineEdge>;
using LoopParts = std::vector<LoopPart>;

struct PictureBox {
  double x0 = 0.0, x1 = 0.0, y0 = 0.0, y1 = 0.0;
};

/// All of it.
LoopParts parts_of(const std::vector<std::vector<PicturePoint>>& loops);

PictureBox box_of(const LoopParts& parts);

/// What matters to a box within the one that `parts` matter to.
LoopParts parts_in(const LoopParts& parts, const PictureBox& box);

/// Whether any edge comes into the box: else all points in it are on one side.
bool has_border(const LoopParts& parts);

/// How deep a point of the box lies within one of the loops, as far as an edge is near; outside it
/// is negative.
double depth_within(const LoopParts& parts, double x, double y);

}  // namespace argil
