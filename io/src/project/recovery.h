// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
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
  std::size_t first_step = 0;      ///< of these, that the clay can take back: those from here on
  std::string damage;              ///< why the clay does not hold all; empty
  std::vector<std::string> notes;
};

/// Applies the steps of a journal from `first` on, all of which were read, under the name of a
/// stage. Returns how many the sculpture has then, and why not all; empty.
struct Repeated {
  std::size_t steps = 0;
  std::string stopped_by;
};
/// Errors  interrupted, memory, internal: the sculpture is of no further use.
Result<Repeated> repeat_steps(Sculpture& sculpture, const Journal& journal, std::size_t first,
                              std::string_view stage, const Progress& progress);

/// Repeats the journal's steps from the latest state that is stored: project, autosave or origin.
/// Steps that the project has are not even read where the others can be repeated on it.
/// Errors  as load_project; interrupted, memory.
Result<Recovery> recover(const SessionFiles& files, const Progress& progress);

}  // namespace argil::io
