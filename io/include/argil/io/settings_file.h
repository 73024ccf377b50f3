// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "argil/core/result.h"

namespace argil::io {

/// One value of a settings file: `name` at its top or in one of its sections.
struct SettingsEntry {
  std::string section;  ///< "" at the top
  std::string name;
  std::variant<bool, double, std::string> value;
  int line = 0;  ///< from 1, where `name` stands; 0: not read from a file
  friend bool operator==(const SettingsEntry&, const SettingsEntry&) = default;
};

/// A JSON object of texts, finite numbers, `true` and `false`, and of sections, which are objects
/// of such: what people may write by hand, so that each entry knows its line.
///
/// Returns  the entries in the order of the file.
/// Errors   disk, memory; bad_input "FILE:LINE: ..." with the remedy: not JSON, another kind of
///          value, a section in a section, a name twice in a section or at the top, a number that
///          is not finite; bad_input for a file of more than 1 MB.
Result<std::vector<SettingsEntry>> read_settings_file(const std::filesystem::path& file);

/// The same as text, to be written by replace_text: a line for each entry, the sections where their
/// first entry stands. Numbers are such that they are read as they were; all are finite.
std::string settings_text(std::span<const SettingsEntry> entries);

/// An error about an entry: "FILE:LINE: WHAT".
Error settings_error(const std::filesystem::path& file, const SettingsEntry& entry,
                     const std::string& what);

}  // namespace argil::io
