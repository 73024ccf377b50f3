// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "argil/core/result.h"
#include "argil/core/vec3.h"

namespace argil::io {

/// What a printer, or a print service, takes. z is up. A number of 0 asks for nothing.
struct Printer {
  std::string name;
  Vec3 bed_mm{};                  ///< largest part; one may be turned by a quarter about z
  double min_wall_mm = 0.0;       ///< thinner walls break or vanish
  double max_overhang_deg = 0.0;  ///< from the vertical that prints without support, below 90
  bool needs_drains = false;      ///< closed cavities keep resin or powder in
  double min_part_mm3 = 0.0;      ///< parts with less are crumbs
  std::int64_t max_triangles = 0;
  double max_file_mb = 0.0;  ///< of 2^20 bytes
};

/// Reads a printer profile, a JSON object with "argil_printer": 1, a "name" and any of the numbers
/// above by their names (docs/printing.md; three generic ones are in `printers/`).
///
/// Errors  bad_input naming the file, and the key with its value and range where it is at fault:
///         not JSON, a key that is unknown or out of its range, another format; disk when it cannot
///         be read.
Result<Printer> read_printer(const std::filesystem::path& file);

}  // namespace argil::io
