// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <set>
#include <vector>

#include "argil/engine/clay.h"
#include "argil/engine/display_surface.h"
#include "argil/engine/preview.h"
#include "argil/engine/stroke.h"
#include "argil/engine/surface_picker.h"

#include "picture/renderer.h"

namespace argil::viewer {

/// What changed in the blocks since a renderer last took them.
struct BlockNews {
  bool is_fresh = false;  ///< drop all former blocks first
  std::vector<BlockId> gone;
  std::map<BlockId, BlockMesh> changed;  ///< to be taken after `gone`

  bool empty() const noexcept { return !is_fresh && gone.empty() && changed.empty(); }
  /// Adds what happened after.
  void append(BlockNews&& later);
};

/// Follows a clay and says which blocks a renderer has to take: the surface's, and those whose
/// mask was painted.
///
/// Threads  the document thread.
class BlockFeed {
 public:
  /// What changed since the last call, with the mask at each vertex.
  /// Errors  memory: the next call starts afresh.
  Result<BlockNews> update(const Clay& clay, const std::optional<DisplayView>& view);

  /// A preview over the blocks of the last update, which were those of the clay as it stands. Until
  /// drop_preview only the next function may be called. Results as those of Preview::begin.
  Result<std::optional<Preview>> begin_preview(const Clay& clay, const Tool& tool,
                                               const StrokeStyle& style) const {
    return Preview::begin(clay, surface_, tool, style);
  }
  /// What the preview changed of them. Errors  memory: drop the preview.
  Result<BlockNews> update(const Clay& clay, Preview& preview);
  /// The preview is gone: the next update brings back what it changed.
  void drop_preview() noexcept { had_preview_ = true; }

  /// The mask may differ within a box, or anywhere.
  void touch_mask(const Box3& box_mm);
  void touch_mask_everywhere() noexcept { is_mask_unknown_ = true; }

  /// Another clay: everything is sent again.
  void restart() noexcept { is_fresh_ = true; }

  DisplayStats stats() const { return surface_.stats(); }

  /// Where a ray meets the blocks of the last update without a preview: what is seen of the clay.
  Result<std::optional<Pick>> pick(const Ray& ray) { return picker_.pick(surface_, ray); }

 private:
  static BlockMesh copy_of(const Clay& clay, const BlockId& id, const DisplayBlock& block);
  BlockMesh copy_of(const Clay& clay, const BlockId& id) const {
    return copy_of(clay, id, surface_.block(id));
  }
  void bring_back(const Clay& clay, BlockNews& news);
  void add_masked(const Clay& clay, BlockNews& news);

  DisplaySurface surface_;
  SurfacePicker picker_;
  std::vector<Box3> masked_mm_;
  bool is_mask_unknown_ = false;
  bool had_mask_ = false;  ///< at the last update
  bool is_fresh_ = true;
  std::set<BlockId> previewed_;  ///< blocks that a preview changed, or that are there by it
  bool had_preview_ = false;
};

}  // namespace argil::viewer
