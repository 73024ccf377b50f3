// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "argil/core/result.h"

namespace argil::viewer {

/// What a person chose once for all sculptures.
struct Settings {
  bool has_number_views = false;  ///< the number row is taken for the numpad, for keyboards without
  std::string printer;            ///< profile that prints are checked for, by name; "": none
  std::filesystem::path firmware;  ///< that a Falcon without one is sent; "": of the environment
  friend bool operator==(const Settings&, const Settings&) = default;
};

/// Reads HOME/settings.txt, a line "NAME VALUE" for each. What is not there, or cannot be read, is
/// as above.
Settings read_settings(const std::filesystem::path& home);

/// Errors  as io::replace_file.
Result<void> write_settings(const std::filesystem::path& home, const Settings& settings);

}  // namespace argil::viewer
