// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "argil/core/result.h"

#include "script/script_line.h"

namespace argil::io {

/// What a journal holds: the header's hash, the steps and the marks up to the first line that is
/// not whole.
struct Journal {
  std::string base_hash;  ///< empty when not even the header is whole
  std::vector<ScriptStep> steps;
  std::vector<HashMark> marks;
  std::set<std::string> solids;     ///< files that the steps name, as they name them
  std::vector<std::uint64_t> ends;  ///< bytes of the file up to the end of each step's line
  std::uint64_t whole_bytes = 0;    ///< bytes up to the end of the last whole line
  bool torn = false;                ///< the last line is not whole: the program ended writing it
  std::string damage;               ///< what is wrong with a line before the last; empty: nothing

  /// After how many steps the clay had this hash, ascending; none when never.
  std::vector<std::size_t> positions_of(const std::string& hash) const;
  /// The latest of them.
  std::optional<std::size_t> position_of(const std::string& hash) const;
};

/// Reads a journal and the solids that its steps name; nothing when there is no such file. Damage,
/// and a solid that is missing or was changed, is told in it, not an error.
/// Errors  disk; memory.
Result<std::optional<Journal>> read_journal(const std::filesystem::path& file);

}  // namespace argil::io
