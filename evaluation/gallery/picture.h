// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/engine/render.h"

#include "gallery/figures.h"
#include "gallery/plate.h"

namespace argil::evaluation {

/// One column of a plate: what somebody made of it.
struct Column {
  std::string maker;            ///< "level 0", "Blender 3.4.1"
  std::string with;             ///< below it: voxels, or brush and strength
  std::optional<Image> image;   ///< none where there is nothing to show,
  std::string reason;           ///< and why; lines parted by |
  std::vector<Figure> figures;  ///< likewise
};

/// The middle of a plate, by the renderer of `argil render`. A mesh without normals gets those that
/// Blender's smooth shading has: the mean of the faces around a vertex by their angles.
/// Errors  as render.
Result<Image> plate_image(const Plate& plate, TriangleMesh mesh, const Progress& progress);

/// The columns side by side as one SVG that carries its pictures, figures below each.
/// Errors  as io::pack_png.
Result<std::string> plate_svg(const Plate& plate, const std::vector<Column>& columns,
                              const Progress& progress);

}  // namespace argil::evaluation
