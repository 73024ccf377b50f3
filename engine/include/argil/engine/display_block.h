// SPDX-License-Identifier: GPL-3.0-or-later
// What a renderer gets of a surface, and says of its view.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <span>

#include "argil/core/triangle_mesh.h"
#include "argil/core/vec3.h"

namespace argil {

/// From where a surface is looked at, and how small a detail is worth its triangles. At distance d
/// from the eye a pixel spans pixel_mm + pixel_rad * d. What is out of its range is refused by
/// DisplaySurface::update, which names it. Where the eye looks does not matter: what is behind it
/// is as fine as what is before it.
struct DisplayView {
  /// From -1e12 to 1e12; of a parallel projection any such point.
  Vec3 eye_mm;

  /// Height of a pixel over its distance: 2 tan(field of view / 2) / rows of the picture, usually
  /// near 0.0005. 0 for a parallel projection. Finite, not below 0.
  double pixel_rad = 0.0;

  /// A pixel's height in mm at the eye: 0 for perspective; of a parallel projection, everywhere.
  /// Finite, not below 0; not 0 together with pixel_rad.
  double pixel_mm = 0.0;

  /// Leaves are hidden when their voxels are smaller than so many pixels: 0.1 to 100, usually 1,
  /// which nobody sees.
  double voxel_pixels = 1.0;

  /// Hidden leaves are shown again only when their voxels are larger than that by this fraction, so
  /// that a camera that trembles does not make them flicker: 0 to 1. With more, what comes nearer
  /// stays coarse for longer.
  double hysteresis = 0.25;

  /// How many levels a part may be drawn coarser than it is: 1, two levels of detail, to 32.
  int coarser = 1;

  /// A pixel's height in mm at a point: a tool that shall look 20 pixels in radius where the ray of
  /// the mouse meets the clay has 20 times that for its radius.
  double pixel_mm_at(const Vec3& point_mm) const noexcept {
    return pixel_mm + pixel_rad * length(point_mm - eye_mm);
  }
};

/// The name of a block, for as long as it is there: its leaf's level and origin (lowest node, a
/// multiple of 8 on each axis). Ordered by level, then x, y and z.
struct BlockId {
  int level = 0;
  std::array<std::int32_t, 3> origin{};

  friend auto operator<=>(const BlockId&, const BlockId&) = default;
};

/// What graphics cards take: 24 bytes. `position_mm` is absolute, rounded from the bits that all
/// blocks around a vertex agree on, so that they agree on it as well and no pixel shows between
/// them; at 110 mm from the origin and voxels of 0.05 mm a voxel is 6 500 steps of float.
struct DisplayVertex {
  std::array<float, 3> position_mm{};
  std::array<float, 3> normal{};  ///< unit, outward

  friend bool operator==(const DisplayVertex&, const DisplayVertex&) = default;
};

/// The surface in one block: views into the DisplaySurface that it came from. The spans end with
/// the next update; a renderer copies what it uploads.
struct DisplayBlock {
  std::span<const DisplayVertex> vertices;
  std::span<const Triangle> triangles;  ///< indices into vertices, counter-clockwise from outside
  Box3 bounds_mm;  ///< the block's cells and 0.15 voxel around them; no vertex is outside
};

}  // namespace argil
