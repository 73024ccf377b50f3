// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "argil/core/result.h"

#include "commands/brush.h"
#include "input/key_name.h"

namespace argil::viewer {

/// A brush with a name: its tool and all that the brush's panel sets, but for symmetry, the image
/// of Emboss and the mesh of a stamp, which stay as they are.
struct BrushPreset {
  std::string name;  ///< that of its file, without the ending
  std::optional<KeyChord> key;
  Brush brush;
  bool is_built_in = false;  ///< has no file
};

/// Those that come with the program.
std::vector<BrushPreset> built_in_presets();

/// The file of a preset: HOME/brushes/NAME.json. Copying it elsewhere exports it.
std::filesystem::path preset_file(const std::filesystem::path& home, const std::string& name);

/// Why a preset cannot be called so, with the remedy; "" where it can.
std::string why_no_preset_name(const std::string& name);

/// Reads one; its name is the file's. What is not said there is as in Brush.
/// Errors  as io::read_settings_file; bad_input "FILE:LINE: ..." for what is unknown, of another
///         kind or out of range, with the range. Nothing of such a file is taken.
Result<BrushPreset> read_preset(const std::filesystem::path& file);

/// A file there that cannot be read is kept aside (unread_file.h).
/// Errors  as io::replace_file and set_aside().
Result<void> write_preset(const std::filesystem::path& home, const BrushPreset& preset);

/// The built-in ones and those in HOME/brushes, of which one takes the place of a built-in one with
/// its name: by name.
struct PresetList {
  std::vector<BrushPreset> presets;
  std::vector<Error> problems;  ///< of files that could not be read, or whose name is none
};
PresetList read_presets(const std::filesystem::path& home);

/// Copies a preset's file into HOME/brushes, under its name or the first free one like it.
/// Returns  it as it is there. Errors  as read_preset and io::replace_file; nothing is copied then.
Result<BrushPreset> import_preset(const std::filesystem::path& home,
                                  const std::filesystem::path& file);

/// Whether a file is a preset by its first words, which need not be right in all the rest.
bool looks_like_preset(const std::filesystem::path& file);

/// The brush becomes as the preset says.
void apply(const BrushPreset& preset, Brush& brush) noexcept;

/// Whether the brush is as the preset says.
bool is_applied(const BrushPreset& preset, const Brush& brush);

}  // namespace argil::viewer
