// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "argil/core/result.h"
#include "argil/engine/clay.h"
#include "argil/engine/sculpture.h"

namespace argil::io {

/// Saves a clay as `NAME.vdb`: one grid per level (`surface_0` finest, class level set, mm), one
/// more for its mask if it has one, and file metadata (argil_format, units, voxel size, tolerance,
/// hash). Temporary file, sync, rename.
///
/// Errors   disk.
/// Threads  as Clay.
/// Cost     a copy of the levels in memory; docs/files.md.
Result<void> save_project(const std::filesystem::path& file, const Clay& clay);

/// The same of all pieces of a sculpture, each with grids of its own, placed where it stands
/// (`NAME/surface_0`); of a plain one just what save_project writes of its clay.
Result<void> save_sculpture(const std::filesystem::path& file, const Sculpture& sculpture);

/// Whether a file is what save_project wrote, as its head says; its damage is not looked for. False
/// where there is no such file.
bool holds_project(const std::filesystem::path& file);

/// Loads what save_project or save_sculpture wrote; the hash of what is loaded must equal the
/// stored one.
///
/// Errors  bad_input naming what is not ours or damaged (not a VDB, truncated, no argil_format, a
///         format newer than this program, missing level, wrong type, hash differs); disk.
Result<Sculpture> load_sculpture(const std::filesystem::path& file);

/// The clay of a project that has only one, in its own frame.
/// Errors  as load_sculpture; bad_input for several pieces, by name.
Result<Clay> load_project(const std::filesystem::path& file);

}  // namespace argil::io
