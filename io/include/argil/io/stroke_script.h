// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "argil/core/result.h"
#include "argil/engine/clay.h"
#include "argil/engine/stroke.h"

namespace argil::io {

/// What a script may start from, so that it needs no project file.
struct StartShape {
  enum class Kind { ball, block } kind = Kind::ball;
  Vec3 size_mm;  ///< ball: the radius in x; block: the three sides
  ClayOptions options;
};

struct StrokeScript {
  std::optional<StartShape> start;
  std::vector<Stroke> strokes;
};

/// Reads JSON Lines: one header line, then one stroke per line (DESIGN section 6; docs/files.md).
/// Errors  bad_input "FILE:LINE: key 'radius_mm' is -4; must be greater than 0": names line and
/// key.
Result<StrokeScript> read_stroke_script(const std::filesystem::path& file);

/// Writes what read_stroke_script reads back bit for bit (shortest round-trip numbers).
/// Errors  disk.
Result<void> write_stroke_script(const std::filesystem::path& file, const StrokeScript& script);

}  // namespace argil::io
