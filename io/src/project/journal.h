// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "argil/core/result.h"

#include "file/file_bytes.h"
#include "script/script_line.h"

namespace argil::io {

/// What a journal holds: the header's hash, the steps and the marks up to the first line that is
/// not whole.
struct Journal {
  std::string base_hash;       ///< empty when not even the header is whole
  bool keeps_history = false;  ///< as its header says, or a closing mark

  /// Those before `first_read` are only counted: each is an empty stroke.
  std::vector<ScriptStep> steps;
  std::size_t first_read = 0;
  std::string hole;  ///< what is wrong with a line among those; empty: nothing that shows

  std::vector<HashMark> marks;
  std::size_t closed_after = 0;       ///< steps when a session last ended in order; 0: none has
  std::set<std::string> solids;       ///< files that the steps that were read name, as they do
  std::vector<std::uint64_t> begins;  ///< bytes of the file before each step's line
  std::uint64_t whole_bytes = 0;      ///< bytes up to the end of the last whole line
  bool torn = false;                  ///< the last line is not whole: the program ended writing it
  std::string damage;                 ///< what is wrong with a line before the last; empty: nothing

  /// After how many steps the clay had this hash, ascending; none when never.
  std::vector<std::size_t> positions_of(const std::string& hash) const;
  /// The latest of them.
  std::optional<std::size_t> position_of(const std::string& hash) const;
  /// The same for the hash of the journal's project. Nothing also where a session has ended in
  /// order since: then the file was replaced by an older one, and no steps were left.
  std::optional<std::size_t> position_of_project(const std::string& hash) const;
};

/// The bytes of a journal, nothing of which is read yet; none when there is no such file.
/// Errors  disk; memory.
Result<std::optional<UnwrittenBytes>> read_journal_bytes(const std::filesystem::path& file);

/// What the bytes of `file` tell, and the solids that its steps name. With the hash of a clay that
/// a mark names, steps before the latest such mark are only counted: they may be thousands that
/// nobody wants to repeat, and what is damaged of them takes nothing from those behind. Damage
/// behind, and a solid that is missing or was changed, is told in the journal, not an error.
/// Errors  disk; memory.
/// Cost    a hash over the bytes, and some 0.5 ms for a step of 1000 samples that is read.
Result<Journal> parse_journal(const std::filesystem::path& file, std::string_view text,
                              const std::string& known_hash = {});

/// Both, with every step; nothing when there is no such file. Errors  as the two.
Result<std::optional<Journal>> read_journal(const std::filesystem::path& file);

/// As parse_journal takes it.
inline std::string_view text_of(const UnwrittenBytes& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace argil::io
