// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "argil/core/result.h"

namespace argil::cli {

/// An error of work on `file` with its name in front, where it is not said yet: readers say it, but
/// what is found among triangles or in a clay knows no file. Not where the disk is at fault, which
/// may be that of another file, nor for an interrupt.
Error named(const std::filesystem::path& file, Error error);

}  // namespace argil::cli
