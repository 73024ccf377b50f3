// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/engine/clay.h"
#include "argil/io/session.h"

namespace argil::cli {

/// One line on stderr for each, whatever was asked for: they tell what was recovered or put aside.
void print_notes(const std::vector<std::string>& notes);

/// A project with the strokes of a journal that a killed session left; prints the notes.
Result<io::OpenedProject> open_project(const std::filesystem::path& file,
                                       const Progress& progress = {});

/// Saves over a project that is not being sculpted; prints what became of its journal.
Result<void> replace_project(const std::filesystem::path& file, const Clay& clay);

}  // namespace argil::cli
