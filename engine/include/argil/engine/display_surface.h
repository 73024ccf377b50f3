// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/core/vec3.h"
#include "argil/engine/clay.h"

namespace argil {

/// From where a surface is looked at, and how small a detail is worth its triangles. At distance d
/// from the eye a pixel spans pixel_mm + pixel_rad * d.
struct DisplayView {
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

  /// Hidden leaves are shown again only when their voxels are larger than that by this share, so
  /// that a camera that trembles does not make them flicker: 0 to 1. With more, what comes nearer
  /// stays coarse for longer.
  double hysteresis = 0.25;

  /// How many levels a place may be drawn coarser than it is: 1, two levels of detail, to 32.
  int coarser = 1;

  /// A pixel's height in mm at a place: a tool that shall look 20 pixels in radius where the ray of
  /// the mouse meets the clay has 20 times that for its radius.
  double pixel_mm_at(const Vec3& place_mm) const noexcept {
    return pixel_mm + pixel_rad * length(place_mm - eye_mm);
  }
};

/// The name of a block, for as long as it is there: the level and the lowest node of its leaf.
struct BlockId {
  int level = 0;
  std::array<std::int32_t, 3> place{};

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

/// The surface in one block. The spans end with the next update.
struct DisplayBlock {
  std::span<const DisplayVertex> vertices;
  std::span<const Triangle> triangles;  ///< indices into vertices, counter-clockwise from outside
  Box3 bounds_mm;                       ///< the block's cells; no vertex is outside
};

struct DisplayStats {
  std::int64_t blocks = 0;  ///< with triangles
  std::int64_t vertices = 0;
  std::int64_t triangles = 0;
  std::int64_t bytes = 0;          ///< what blocks and choice take, scratch left out
  std::int64_t hidden_leaves = 0;  ///< of the clay, by the last view
};

/// The surface of a clay as a renderer wants it: in blocks, coarser where it is small on the
/// screen, with the list of blocks to upload after each update. Closed over all blocks whatever is
/// hidden: a hidden leaf counts as absent, and the levels of a clay meet without cracks. `Surface`,
/// hashes, picking and export know nothing of it.
///
/// Threads   as Clay: the clay thread; spreads work with TBB; bits do not depend on thread count.
/// Cost      as Surface for what is extracted; a changed view, or leaves that come or go, also
///           look at each leaf of the levels that may be hidden: docs/surface.md.
///           24 bytes for each vertex and 12 for each triangle, in all 45 for each vertex (at most
///           60 for small clay: DisplaySurface.TakesSixtyBytesAVertexAndGivesThemBack).
class DisplaySurface {
 public:
  DisplaySurface();
  DisplaySurface(DisplaySurface&&) noexcept;
  DisplaySurface& operator=(DisplaySurface&&) noexcept;
  ~DisplaySurface();

  /// Brings the surface up to date with the clay and the view; without a view everything is shown.
  /// Returns how many blocks were extracted.
  ///
  /// Errors  bad_input for a view out of range: nothing was changed, the lists neither. memory: the
  ///         surface is empty; drop all copies of blocks, the next update starts anew.
  Result<std::int64_t> update(const Clay& clay, const std::optional<DisplayView>& view = {});

  /// What the last update did to blocks with triangles: those to upload, since they came or have
  /// other bits, and those to drop. Complete and minimal: DisplaySurfaceProperty.
  /// ARendererThatFollowsTheListsHoldsTheBlocks.
  std::span<const BlockId> changed() const noexcept;
  std::span<const BlockId> gone() const noexcept;

  /// One block; empty spans when it has no triangles or is not there.
  DisplayBlock block(const BlockId& id) const;

  /// All blocks with triangles, in order.
  std::vector<BlockId> blocks() const;

  DisplayStats stats() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace argil
