// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "argil/core/result.h"
#include "argil/core/vec3.h"

namespace argil::io {

/// More points than that are thinned out (read_path).
inline constexpr std::size_t kMostPathPoints = 1000;

/// Reads a path, straight from point to point, mm: the positions of the first stroke of a script
/// (`.jsonl`), or lines of x, y and z parted by commas or blanks, of which empty ones and those
/// that begin with # are left out, and the mark with which some editors begin a text (any other
/// ending). Neighbours in one place are one point. More
/// than kMostPathPoints are thinned to steps of one length, which cuts corners by half a step at
/// most.
///
/// Errors  bad_input naming file and line, or that there is no point or no stroke in it; as
///         read_stroke_script; disk when it cannot be read.
Result<std::vector<Vec3>> read_path(const std::filesystem::path& file);

/// A path of at most kMostPathPoints, thinned out as read_path does it; one that has no more stays
/// as it is. A path whose points are all in one place becomes one point.
std::vector<Vec3> thinned_path(std::vector<Vec3> path_mm);

}  // namespace argil::io
