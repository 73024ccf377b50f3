// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "argil/core/result.h"
#include "argil/engine/clay.h"
#include "argil/engine/display_block.h"

namespace argil {

/// Of what is shown now, hidden leaves left out.
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
/// hashes, `pick` and export know nothing of it; SurfacePicker picks on it.
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
  ///         surface is empty; drop all copies of blocks, the next update starts over.
  Result<std::int64_t> update(const Clay& clay, const std::optional<DisplayView>& view = {});

  /// What the last update did to blocks with triangles: those to upload, since they came or have
  /// other bits, and those to drop. Complete and minimal
  /// (DisplaySurfaceProperty.ARendererThatFollowsTheListsHoldsTheBlocks). Neither names a block of
  /// the other. The spans end with the next update.
  std::span<const BlockId> changed() const noexcept;
  std::span<const BlockId> gone() const noexcept;

  /// One block; empty spans when it has no triangles or is not there. The spans end with the next
  /// update.
  DisplayBlock block(const BlockId& id) const;

  /// All blocks with triangles, in order: what a renderer that comes later has to upload. Sorts
  /// them anew each time.
  std::vector<BlockId> blocks() const;

  /// Linear in the blocks.
  DisplayStats stats() const;

 private:
  friend struct DisplayAccess;  ///< of the engine itself
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace argil
