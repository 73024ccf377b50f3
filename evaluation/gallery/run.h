// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"

#include "gallery/picture.h"
#include "gallery/plate.h"

namespace argil::evaluation {

/// A plate with all its columns: levels 0, 1 and 2, then Blender's.
struct MadePlate {
  Plate plate;
  std::vector<Column> columns;
};

struct GalleryResult {
  std::vector<MadePlate> plates;
  std::vector<std::string> skipped;  ///< what is not there, and why
};

/// Does, measures and draws these plates. Where Blender is not there or fails its column says so.
/// Errors  interrupted; disk; as Clay and render.
Result<GalleryResult> make_gallery(std::vector<Plate> plates, const Progress& progress);

/// All figures as a table.
std::string gallery_csv(const std::vector<MadePlate>& plates);

}  // namespace argil::evaluation
