// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "argil/core/result.h"

#include "base/theme.h"
#include "settings/pressure_curve.h"

namespace argil::viewer {

/// What Settings::panel_percent may be chosen from.
inline constexpr std::array kPanelPercents{75, 100, 125, 150, 175, 200, 250, 300};

/// What the user chose once for all sculptures.
struct Settings {
  bool has_number_views = false;  ///< the number row is taken for the numpad, for keyboards without
  std::string printer;            ///< profile that prints are checked for, by name; "": none
  std::filesystem::path firmware;  ///< that a Falcon without one is sent; "": of the environment
  /// Projects of killed windows that are not asked about any more, as LeftProject::state.
  std::vector<std::string> unasked = {};
  int panel_percent = 100;  ///< size of panels and letters, of what the screen asks for; 75 to 300
  PressureCurve pressure;   ///< of a pen
  Theme theme = Theme::dark;
  friend bool operator==(const Settings&, const Settings&) = default;
};

/// Reads HOME/settings.txt, a line "NAME VALUE" for each. What is not there, or cannot be read, is
/// as above.
Settings read_settings(const std::filesystem::path& home);

/// Writes what differs between the two into HOME/settings.txt; the rest stays as it is there, for
/// another window may have written it meanwhile. Errors  as io::replace_file.
Result<void> write_changes(const std::filesystem::path& home, const Settings& before,
                           const Settings& after);

/// HOME/recent.txt: the files that were open last, newest first, at most 10.
std::vector<std::filesystem::path> read_recent(const std::filesystem::path& home);

/// Puts a file at its head, as it is now: another window may have written it. What it holds then
/// is in `recent` also where it could not be written. Errors  as io::replace_file.
Result<void> add_recent(const std::filesystem::path& home, const std::filesystem::path& file,
                        std::vector<std::filesystem::path>& recent);
/// Takes a file out of it, in the same way.
Result<void> remove_recent(const std::filesystem::path& home, const std::filesystem::path& file,
                           std::vector<std::filesystem::path>& recent);

}  // namespace argil::viewer
