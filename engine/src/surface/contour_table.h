// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

namespace argil {

/// The loops of a cell none of whose faces and edges is divided, for one of the 256 patterns of
/// inside corners. Corner c lies at (c >> 2, c >> 1 & 1, c & 1).
struct ContourCase {
  std::uint8_t loops = 0;                 ///< 0 to 4
  std::array<std::uint8_t, 4> lengths{};  ///< corners of each loop, 3 to 12
  std::array<std::uint8_t, 12> cuts{};    ///< edges of all loops, one loop after the other
};

/// A cell's edge, numbered axis * 4 + 2 * i + j with i, j the low corner's coordinates along the
/// two other axes in their order x, y, z.
struct ContourEdge {
  std::uint8_t axis = 0;
  std::array<std::uint8_t, 3> low{};  ///< its low corner
  std::uint8_t planes = 0;            ///< as ContourCut::planes
};

/// Made once by tracing every pattern with ContourCell, so that table and general cells agree.
const std::array<ContourCase, 256>& contour_cases();
const std::array<ContourEdge, 12>& contour_edges();

}  // namespace argil
