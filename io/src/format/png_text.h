// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "argil/io/png.h"

namespace argil::io {

// The simplified interface of libpng, which png.cpp and png_read.cpp use, knows no texts: they are
// put into, found in and kept out of the chunks of a whole PNG.

/// Whether a tEXt chunk can keep it.
bool is_png_text(const PngText& text) noexcept;

/// The same PNG with these texts behind its header. `png` is one that libpng made, the texts are
/// is_png_text (assert).
std::vector<std::byte> with_texts(std::vector<std::byte> png, const std::vector<PngText>& texts);

/// All texts of a PNG, whatever its bytes are; nothing where a chunk is cut off or a text's sum is
/// wrong.
std::optional<std::vector<PngText>> texts_of(std::span<const std::byte> png);

/// The bytes that the pixels need, in order: all but the chunks that are about something else. Of
/// what is damaged all from there on, for its reader to judge.
std::vector<std::span<const std::byte>> pixel_parts(std::span<const std::byte> png);

}  // namespace argil::io
