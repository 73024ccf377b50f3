// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/block_news.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace argil::viewer {
namespace {

Vec3 vec_of(const std::array<float, 3>& p) noexcept {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

}  // namespace

void BlockNews::append(BlockNews&& later) {
  if (later.is_fresh) {
    *this = std::move(later);
    return;
  }
  // A block that is gone and came back is in both lists: `changed` is taken after `gone`.
  for (const BlockId& id : later.gone) changed.erase(id);
  gone.insert(gone.end(), later.gone.begin(), later.gone.end());
  for (auto& [id, block] : later.changed) changed.insert_or_assign(id, std::move(block));
}

void BlockFeed::touch_mask(const Box3& box_mm) {
  // Beyond so many, looking at all blocks is no more work.
  constexpr std::size_t kMostBoxes = 64;
  if (masked_mm_.size() >= kMostBoxes) is_mask_unknown_ = true;
  if (!is_mask_unknown_) masked_mm_.push_back(box_mm);
}

BlockMesh BlockFeed::copy_of(const Clay& clay, const BlockId& id, const DisplayBlock& block) {
  BlockMesh mesh;
  mesh.id = id;
  mesh.bounds_mm = block.bounds_mm;
  mesh.vertices.assign(block.vertices.begin(), block.vertices.end());
  mesh.triangles.assign(block.triangles.begin(), block.triangles.end());
  // Without a mask nothing is sent for it: a byte a vertex would be uploaded for nothing.
  if (!clay.has_mask()) return mesh;
  mesh.mask.reserve(mesh.vertices.size());
  for (const DisplayVertex& vertex : mesh.vertices) {
    const double masked = clay.mask_at(vec_of(vertex.position_mm));
    mesh.mask.push_back(
        static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(masked, 0.0, 1.0))));
  }
  return mesh;
}

void BlockFeed::add_masked(const Clay& clay, BlockNews& news) {
  // Where none was and none is, nothing can differ.
  const bool has_mask = clay.has_mask();
  if (!std::exchange(had_mask_, has_mask) && !has_mask) is_mask_unknown_ = false;
  if (!is_mask_unknown_ && masked_mm_.empty()) return;
  // A mask moves no surface: the blocks that it may have changed are found by their boxes.
  for (const BlockId& id : surface_.blocks()) {
    if (news.changed.contains(id)) continue;
    const Box3 bounds = surface_.block(id).bounds_mm;
    const bool is_touched =
        is_mask_unknown_ || std::any_of(masked_mm_.begin(), masked_mm_.end(),
                                        [&](const Box3& box) { return box.meets(bounds); });
    if (is_touched) news.changed.emplace(id, copy_of(clay, id));
  }
  masked_mm_.clear();
  is_mask_unknown_ = false;
}

Result<BlockNews> BlockFeed::update(const Clay& clay, const std::optional<DisplayView>& view) {
  auto updated = surface_.update(clay, view);
  if (!updated) {
    is_fresh_ = true;
    return updated.error();
  }
  // With every update, so that it misses none. Without memory the next pick starts over, and says
  // so.
  (void)picker_.update(surface_);
  BlockNews news;
  if (is_fresh_) {
    // A renderer holds nothing of this clay: all of it is sent, and nothing else is owed.
    news.is_fresh = true;
    for (const BlockId& id : surface_.blocks()) news.changed.emplace(id, copy_of(clay, id));
    masked_mm_.clear();
    previewed_.clear();
    had_mask_ = clay.has_mask();
    is_mask_unknown_ = is_fresh_ = had_preview_ = false;
    return news;
  }
  news.gone.assign(surface_.gone().begin(), surface_.gone().end());
  for (const BlockId& id : surface_.changed()) news.changed.emplace(id, copy_of(clay, id));
  if (had_preview_) bring_back(clay, news);
  add_masked(clay, news);
  return news;
}

void BlockFeed::bring_back(const Clay& clay, BlockNews& news) {
  // What the preview showed or hid is sent as the clay has it now.
  for (const BlockId& id : previewed_) {
    if (news.changed.contains(id)) continue;
    const DisplayBlock block = surface_.block(id);
    if (block.triangles.empty()) {
      news.gone.push_back(id);
    } else {
      news.changed.emplace(id, copy_of(clay, id, block));
    }
  }
  previewed_.clear();
  had_preview_ = false;
}

/// While a preview is shown the surface of the clay itself stays as it was when the preview began:
/// its blocks come back with bring_back().
Result<BlockNews> BlockFeed::update(const Clay& clay, Preview& preview) {
  if (auto updated = preview.update_surface(); !updated) return updated.error();
  BlockNews news;
  news.gone.assign(preview.gone().begin(), preview.gone().end());
  for (const BlockId& id : preview.changed()) {
    news.changed.emplace(id, copy_of(clay, id, preview.block(id)));
  }
  previewed_.insert(preview.gone().begin(), preview.gone().end());
  previewed_.insert(preview.changed().begin(), preview.changed().end());
  return news;
}

}  // namespace argil::viewer
