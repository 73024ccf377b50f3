// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "argil/engine/alpha_image.h"

namespace argil::test {

/// An image by the grey, 0 to 1, of the pixel in each column and row, the first row at the top.
template <class Grey>
std::shared_ptr<const AlphaImage> image_of(int width, int height, const Grey& grey) {
  std::vector<std::uint16_t> pixels;
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const double held = std::clamp(static_cast<double>(grey(column, row)), 0.0, 1.0);
      pixels.push_back(static_cast<std::uint16_t>(std::lround(65535.0 * held)));
    }
  }
  return AlphaImage::make(width, height, std::move(pixels)).value();
}

/// Black to white from left to right.
inline std::shared_ptr<const AlphaImage> ramp_image(int side) {
  return image_of(side, side, [side](int column, int) { return (column + 0.5) / side; });
}

/// Squares of so many pixels.
inline std::shared_ptr<const AlphaImage> checker_image(int side, int square) {
  return image_of(side, side,
                  [square](int column, int row) { return (column / square + row / square) % 2; });
}

/// A letter L, which is its own image in no turn or mirror: smooth enough for 16 pixels a side.
inline std::shared_ptr<const AlphaImage> letter_image() {
  return image_of(16, 16, [](int column, int row) {
    const bool is_stem = column >= 4 && column < 7 && row >= 3 && row < 13;
    const bool is_foot = column >= 4 && column < 12 && row >= 10 && row < 13;
    return is_stem ? 1.0 : is_foot ? 0.6 : 0.0;
  });
}

}  // namespace argil::test
