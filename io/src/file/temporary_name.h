// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace argil::io {

/// A name in the folder of `target` that no other save uses; the ending stays, since writers choose
/// their format by it, and the leading dot keeps it out of listings.
std::filesystem::path temporary_name(const std::filesystem::path& target);

/// What a file that is written calls itself: its name without the ending, of a temporary one that
/// of its target (the first 100 bytes).
std::string title_of(const std::filesystem::path& file);

}  // namespace argil::io
