// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>

namespace argil::io {

/// How an image lies in its file, by the tag Orientation of Exif: 1 as it is seen, 2 mirrored left
/// to right, 3 upside down, 4 mirrored top to bottom, 5 mirrored at its falling diagonal, 6 to be
/// turned clockwise by a quarter, 7 mirrored at its rising diagonal, 8 to be turned back by a
/// quarter. 1 where nothing else is said, or not as Exif has it.
///
/// Shapes  `segment`: the content of a JPEG's marker APP1, without the marker and its length.
/// Source  Exif 2.32 (CIPA DC-008), 4.6.4 and 4.6.2 (TIFF 6.0).
int exif_orientation(std::span<const std::byte> segment) noexcept;

}  // namespace argil::io
