// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>

#include "argil/core/result.h"

namespace argil::io {

// A sealed file ends in 24 bytes that say what stands before them: the letters "ArgilSea", the
// number of bytes before the seal and their xxh64, both as little-endian 64-bit numbers. OpenVDB
// reads from the front and never looks that far, so every OpenVDB program still opens the file;
// Argil checks the seal before it hands damaged bytes to a library that trusts them.
inline constexpr std::size_t kSealBytes = 24;

/// Appends the seal to a file.
/// Errors  disk.
Result<void> seal_file(const std::filesystem::path& file);

/// What stands before the seal, or nothing when the seal is absent or does not fit the bytes.
std::optional<std::span<const std::byte>> unsealed(std::span<const std::byte> bytes) noexcept;

}  // namespace argil::io
