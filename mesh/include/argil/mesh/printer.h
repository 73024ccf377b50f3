// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "argil/core/vec3.h"

namespace argil::mesh {

/// What a printer, or a print service, takes. z is up. A number of 0 asks for nothing; none is
/// negative. `io::read_printer` reads one from a file and holds it to these ranges.
struct Printer {
  std::string name;
  Vec3 bed_mm{};                  ///< largest part; one may be turned by a quarter about z
  double min_wall_mm = 0.0;       ///< thinner walls break or vanish
  double max_overhang_deg = 0.0;  ///< from the vertical that prints without support, below 90
  bool needs_drains = false;      ///< closed cavities keep resin or powder in
  double min_part_mm3 = 0.0;      ///< components with less are too small to print
  std::int64_t max_triangles = 0;
  double max_file_mb = 0.0;  ///< of 2^20 bytes
};

}  // namespace argil::mesh
