// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "argil/core/result.h"
#include "argil/io/stroke_script.h"

namespace argil::test {

/// Writes what read_stroke_script reads back bit for bit (shortest round-trip numbers). The meshes
/// and clays that steps work with are written beside it first: NAME.solid-HASH.ply or .vdb.
/// Errors  disk; bad_input as validate_step.
Result<void> write_stroke_script(const std::filesystem::path& file, const io::StrokeScript& script);

}  // namespace argil::test
