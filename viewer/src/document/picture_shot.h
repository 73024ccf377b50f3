// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/core/vec3.h"
#include "argil/engine/display_surface.h"
#include "argil/engine/render.h"
#include "argil/engine/sculpture.h"

namespace argil::viewer {

/// What a small picture of a sculpture is drawn from, a copy that any thread may keep: the visible
/// pieces where they stand.
struct PictureShot {
  TriangleMesh mesh;
  std::vector<Vec3> colors;  ///< of each triangle; empty where no piece has a colour
  Vec3 toward;               ///< the eye, from the middle; never along `up`
  Vec3 up;
};

/// As a window sees it that looks from there; without a view, from the front and above. Of a large
/// clay the coarse levels alone, in which a picture of 256 pixels loses nothing. Nothing where no
/// piece is visible or has a surface.
/// Threads  the clay's. Cost  10 to 25 ms of a core, of 8 million vertices 90 (bench_pictures).
/// Errors   memory: nothing.
std::optional<PictureShot> shoot(const Sculpture& sculpture,
                                 const std::optional<DisplayView>& view);

/// Drawn by the renderer of `argil render`, as large as thumbnails are. Any thread; spreads over
/// TBB. Errors  as render.
Result<Image> draw(const PictureShot& shot, const Progress& progress);

}  // namespace argil::viewer
