// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "argil/core/vec3.h"

namespace argil::mesh {

/// What a printer, or a print service, takes. z is up. A number of 0 asks for nothing; none is
/// negative. `io::read_printer` reads one from a file and holds it to these ranges; printers/ of
/// the sources has one for filament, one for resin and one for a service.
struct Printer {
  /// What people call it; no check reads it.
  std::string name;
  /// Largest part, x, y and z; one may be turned by a quarter about z. All three or none.
  Vec3 bed_mm{};
  /// Thinner walls break or vanish: usually 0.5 for resin, 0.8 for filament. A thin place counts
  /// where it covers at least the square of this.
  double min_wall_mm = 0.0;
  /// What faces each other across less air melts or cures together: usually 0.3 for filament. It is
  /// told and does not count: a crease of a sculpture is such a gap.
  double min_gap_mm = 0.0;
  /// From the vertical that prints without support, below 90: usually 50 for filament.
  double max_overhang_deg = 0.0;
  /// Closed cavities keep resin or powder in.
  bool needs_drains = false;
  /// Components with less are too small to print; a part that is all there is never counts.
  double min_part_mm3 = 0.0;
  std::int64_t max_triangles = 0;
  /// In units of 2^20 bytes, of a file whose size is given to check_print.
  double max_file_mb = 0.0;
};

}  // namespace argil::mesh
