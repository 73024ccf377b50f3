// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "argil/core/progress.h"
#include "argil/core/result.h"

#include "command.h"

namespace argil::cli {

/// The field of a project as one grid for other programs (volume_file.h).
Result<Outcome> export_volume(const std::string& project, const std::filesystem::path& file,
                              const Progress& progress);

}  // namespace argil::cli
