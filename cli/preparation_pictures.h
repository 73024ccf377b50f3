// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/io/print_preparation.h"

namespace argil::cli {

/// Pictures of what a preparation found and did, into a folder that is there: the orientations side
/// by side with their overhangs yellow; what is printed with what its verdict marks; where there
/// are any, islands from below in red, and the first piece cut open with its drains in blue.
/// Returns the files. Errors  as render and io::write_png.
Result<std::vector<std::filesystem::path>> write_preparation_pictures(
    const std::filesystem::path& folder, const io::PrintPreparation& made, double max_overhang_deg,
    const Progress& progress);

}  // namespace argil::cli
