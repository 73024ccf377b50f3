// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "argil/core/result.h"

#include "keys/key_map.h"

namespace argil::viewer {

/// Reads HOME/keys.json; Argil's own keys where there is none.
///
///   {
///     "argil_keys": 1,
///     "set": "blender",                      argil, blender or zbrush; argil where it is missing
///     "commands": {"view_front": "Num1"},    names of command_rows.h; "" takes the key away
///     "tools": {"smooth": "Shift+S"}         names of actions, and stamp
///   }
///
/// Errors  as io::read_settings_file; bad_input "FILE:LINE: ..." with the remedy for an unknown
///         format, set, section, command, tool or key, for one that cannot be given, and for one
///         that the file gives twice. Nothing of such a file is taken.
Result<KeyMap> read_keys(const std::filesystem::path& home);

/// Writes it: the set, and what differs from it. A file there that cannot be read is kept
/// aside (unread_file.h). Errors  as io::replace_file and set_aside().
Result<void> write_keys(const std::filesystem::path& home, const KeyMap& keys);

}  // namespace argil::viewer
