// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/engine/tool.h"

namespace argil {

// Of a tool that embosses (brush/alpha_stamp.h), as its fields say.

/// How far before and behind its plane a stamp reaches, in radii: an image that is laid on a ball
/// or along an edge goes down with it, what stands behind does not get one.
inline constexpr double kEmbossDepth = 0.8;

/// How high white stands over black at full strength, in smallest radii.
double emboss_ratio(const Tool& tool) noexcept;
/// How far a tool that embosses reaches from its path, in its largest radii.
double emboss_reach(const Tool& tool) noexcept;
/// The larger side of a tile in mm.
double emboss_tile_mm(const Tool& tool) noexcept;
/// A pixel of the image in mm; of a tool without image its rim's width over 4, which is as fine.
double emboss_pixel_mm(const Tool& tool) noexcept;

}  // namespace argil
