// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace argil::mesh {

/// How an open sheet shows its edge where it was given a thickness.
enum class SheetRim : std::uint8_t {
  square,  ///< the sheet ends where it did
  round    ///< half a circle beyond that
};

/// What is done with open parts that are sheets, not bodies with holes.
struct Thickening {
  double thickness_mm = 0.0;  ///< >= 0; 0: sheets are left as they are
  bool inward = false;        ///< one side stays where the sheet was, else it is in the middle
  SheetRim rim = SheetRim::square;
};

}  // namespace argil::mesh
