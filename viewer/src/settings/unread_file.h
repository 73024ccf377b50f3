// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "argil/core/result.h"

namespace argil::viewer {

/// Moves a file that cannot be read, and would be written over, to FILE.unread or the first free
/// name like it: FILE.unread-2. Errors  disk, with the remedy; the file stands as it was then.
Result<void> set_aside(const std::filesystem::path& file);

}  // namespace argil::viewer
