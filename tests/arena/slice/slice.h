// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "arena/slice/pieces.h"

namespace argil::arena {

/// What two programs say of one piece at the same printer.
struct SliceRow {
  std::string piece;
  // argil check with printers/filament.json
  bool printable = false;
  double min_wall_mm = -1.0;  ///< -1: none found
  double min_gap_mm = -1.0;
  bool says_thin = false;  ///< a problem "thin_wall"
  bool says_gap = false;   ///< a problem "narrow_gap"
  // PrusaSlicer, nozzle 0.4 mm, layers of 0.2 mm, solid infill
  std::size_t layers = 0;       ///< in which the solid has a section
  std::size_t empty = 0;        ///< of those: nothing is laid down
  std::size_t lost_walls = 0;   ///< of those: a region of the section gets nothing
  std::size_t fat_walls = 0;    ///< of those: half more area is laid down than the section has
  std::size_t closed_gaps = 0;  ///< of those: parts that are apart become one
  std::size_t lost_floors = 0;  ///< all layers: what lies between their middles gets nothing
  bool has_gcode = true;        ///< false: it found nothing to print

  bool is_lost() const { return !has_gcode || empty > 0 || lost_walls > 0 || lost_floors > 0; }
};

/// Asks both about each piece. Both programs must be there.
std::vector<SliceRow> compare_with_slicer(const std::vector<PrintPiece>& pieces);

std::string slice_csv(const std::vector<SliceRow>& rows);

/// A line for each piece, and the pieces that one finds fault with and the other does not.
std::string slice_table(const std::vector<SliceRow>& rows);

}  // namespace argil::arena
