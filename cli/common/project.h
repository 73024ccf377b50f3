// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

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

/// --piece of commands that work with one clay of a project; `piece` outlives the command line.
void add_piece_option(CLI::App& command, std::string& piece);

/// bad_input for a mesh, which has no pieces, where one is named.
Result<void> check_no_piece(const std::filesystem::path& mesh, const std::string& piece);

/// Makes the piece of that name the active one; "" is for a project that has only one.
/// Errors  bad_input: no such piece; several, and no name.
Result<void> select_piece(const std::filesystem::path& file, const std::string& piece,
                          Sculpture& sculpture);

/// One clay of a project, in its own frame.
struct OpenedClay {
  Clay clay;
  std::int64_t recovered_steps = 0;
};
/// Errors  as open_project and select_piece.
Result<OpenedClay> open_clay(const std::filesystem::path& file, const std::string& piece,
                             const Progress& progress = {});

/// Saves over a project that is not being sculpted; prints what became of its journal.
Result<void> replace_project(const std::filesystem::path& file, const Clay& clay);
Result<void> replace_project(const std::filesystem::path& file, const Sculpture& sculpture);

}  // namespace argil::cli
