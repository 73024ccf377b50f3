// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include <gtest/gtest.h>

#include "argil/engine/render.h"

namespace argil::test {

/// The 8-bit RGB picture in a PNG; without pixels when it cannot be read.
Image read_picture(const std::filesystem::path& png);

/// Whether a person takes two pictures for the same. Both are averaged over blocks of 8 x 8 pixels,
/// which forgives another rounding along edges and other digits in a status line. The blocks'
/// mean absolute difference may be 6 of 255, and one block in fifty may differ by more than 40.
/// Where they are not alike, says by how much and where the block that differs most begins.
testing::AssertionResult are_alike(const Image& made, const Image& committed);

/// Compares a picture that a test made with the committed one. With ARGIL_RENEW_PICTURES=1 in the
/// environment it becomes the committed one instead, and this fails, so that nobody takes a run
/// that renews for one that passes: look at the picture, then commit it.
testing::AssertionResult is_as_committed(const std::filesystem::path& made,
                                         const std::filesystem::path& committed);

}  // namespace argil::test
