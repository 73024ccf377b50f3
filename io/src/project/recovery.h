// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/engine/sculpture.h"

#include "project/journal.h"
#include "project/session_files.h"

namespace argil::io {

/// A project and what its journal adds. Nothing was written.
struct Recovery {
  Sculpture sculpture;
  std::optional<Journal> journal;  ///< none, or one whose steps belong to this project
  bool is_foreign = false;         ///< there is a journal that does not
  std::size_t project_steps = 0;   ///< steps of the journal that the project file holds
  std::size_t steps = 0;           ///< and that the clay holds; all, unless `damage`
  std::string damage;              ///< why the clay does not hold all; empty
  std::vector<std::string> notes;
};

/// Repeats the journal's steps from the latest state that is stored: project, autosave or origin.
/// Errors  as load_project; interrupted, memory.
Result<Recovery> recover(const SessionFiles& files, const Progress& progress);

}  // namespace argil::io
