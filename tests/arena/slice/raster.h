// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "argil/core/triangle_mesh.h"

#include "arena/slice/gcode.h"

namespace argil::arena {

/// Cells of a plane; each is set or not.
class Raster {
 public:
  /// Over x and y of the box, and a margin around.
  Raster(const Box3& box, double cell_mm);

  /// The cells whose middle is within the solid at that height.
  void add_section(const TriangleMesh& solid, double z_mm);
  /// The cells whose middle is under a bead that is wider by `more_mm` on each side, moved by `by`.
  void add_beads(const PrintedLayer& layer, double more_mm, const Vec3& by);

  std::size_t count() const;
  double cell_mm2() const { return cell_ * cell_; }
  /// The cells that are set here and not in `other`, which has the same box.
  Raster without(const Raster& other) const;
  /// Numbers of cells of the regions that hang together by sides, of at least `least` cells.
  std::vector<std::size_t> regions(std::size_t least) const;

 private:
  double x_of(std::size_t column) const;
  double y_of(std::size_t row) const;
  void add_bead(const Bead& bead, double reach);

  Vec3 origin_;
  double cell_;
  std::size_t columns_;
  std::size_t rows_;
  std::vector<std::uint8_t> set_;
};

}  // namespace argil::arena
