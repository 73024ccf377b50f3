// SPDX-License-Identifier: GPL-3.0-or-later
// A choice of leaves and the blocks extracted from it, kept up to date with the clay's changes: a
// leaf that is hidden or shown again counts as one that went or came.
#include "argil/engine/display_surface.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <new>

#include "clay/clay_access.h"
#include "surface/block_surface.h"
#include "surface/display_access.h"
#include "surface/display_choice.h"

namespace argil {
namespace {

std::vector<BlockId> ids_of(const std::vector<LeafKey>& origins) {
  std::vector<BlockId> ids;
  ids.reserve(origins.size());
  for (const LeafKey& at : origins) ids.push_back(id_of(at));
  return ids;
}

/// Surfaces may be updated on several threads.
std::uint64_t next_edition() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

/// Whether two views hide the same leaves: then nothing need be chosen again.
bool same_choice(const std::optional<DisplayView>& a, const std::optional<DisplayView>& b) {
  if (!a || !b) return !a && !b;
  return a->eye_mm == b->eye_mm && a->pixel_rad == b->pixel_rad && a->pixel_mm == b->pixel_mm &&
         a->voxel_pixels == b->voxel_pixels && a->hysteresis == b->hysteresis &&
         a->coarser == b->coarser;
}

}  // namespace

struct DisplaySurface::State {
  DisplayChoice choice;
  BlocksOf<DrawnBlock> blocks;
  std::optional<DisplayView> view;
  double voxel_mm = 0.0;       // of level 0
  std::uint64_t identity = 0;  // of the clay the blocks are of
  std::uint64_t revision = 0;  // of it, when they were brought up to date
  bool empty = true;
  DisplayEdition edition;
  std::vector<BlockId> changed;
  std::vector<BlockId> gone;

  std::int64_t rebuild(const LevelStack& stack, const std::optional<DisplayView>& by) {
    choice.show_all(stack);
    choice.choose(by);
    return blocks.rebuild_all({stack, &choice});
  }

  /// What changed of the leaves that are shown, before or now.
  std::int64_t follow(const LevelStack& stack, std::vector<LeafChange> changes,
                      const std::optional<DisplayView>& by) {
    std::vector<bool> was_shown;
    was_shown.reserve(changes.size());
    for (const LeafChange& change : changes) was_shown.push_back(choice.shows(change.where()));
    std::vector<LeafKey> flips;
    if (choice.follow(stack, changes) || !same_choice(view, by)) flips = choice.choose(by);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < changes.size(); ++i) {
      if (was_shown[i] || choice.shows(changes[i].where())) changes[kept++] = changes[i];
    }
    changes.resize(kept);
    for (const LeafKey& at : flips) changes.push_back({at.level, at.origin});
    return blocks.update({stack, &choice}, changes);
  }

  std::int64_t update(const Clay& clay, const std::optional<DisplayView>& by) {
    std::optional<std::vector<LeafChange>> changes;
    if (!empty && identity == argil::identity(clay)) changes = changes_since(clay, revision);
    const LevelStack& stack = levels_of(clay);
    const std::int64_t extracted =
        changes ? follow(stack, std::move(*changes), by) : rebuild(stack, by);
    changed = ids_of(blocks.changed());
    gone = ids_of(blocks.gone());
    view = by;
    voxel_mm = stack.voxel_mm(0);
    identity = argil::identity(clay);
    revision = argil::revision(clay);
    empty = false;
    edition = {edition.now, next_edition()};
    return extracted;
  }
};

DisplayEdition DisplayAccess::edition(const DisplaySurface& surface) noexcept {
  return surface.state_->edition;
}

double DisplayAccess::voxel_mm(const DisplaySurface& surface) noexcept {
  return surface.state_->voxel_mm;
}

int DisplayAccess::coarsest_hidden(const DisplaySurface& surface) noexcept {
  return surface.state_->choice.coarsest_hidden();
}

std::vector<BlockId> DisplayAccess::drawn(const DisplaySurface& surface) {
  std::vector<BlockId> ids;
  for (const auto& [where, block] : surface.state_->blocks.blocks()) {
    if (!block.triangles.empty()) ids.push_back(id_of(where));
  }
  return ids;
}

const DrawnBlock& DisplayAccess::block(const DisplaySurface& surface, const BlockId& id) {
  const DrawnBlock* block = surface.state_->blocks.block(leaf_of(id));
  assert(block != nullptr && !block->triangles.empty());
  return *block;
}

DisplaySurface::DisplaySurface() : state_(std::make_unique<State>()) {}
DisplaySurface::DisplaySurface(DisplaySurface&&) noexcept = default;
DisplaySurface& DisplaySurface::operator=(DisplaySurface&&) noexcept = default;
DisplaySurface::~DisplaySurface() = default;

Result<std::int64_t> DisplaySurface::update(const Clay& clay,
                                            const std::optional<DisplayView>& view) {
  if (view) {
    if (auto valid = validate_view(*view); !valid) return valid.error();
  }
  try {
    return state_->update(clay, view);
  } catch (const std::bad_alloc&) {
    state_ = std::make_unique<State>();
    return Error{ErrorKind::memory,
                 "no memory left for the surface to draw; ask for larger voxel_pixels or more "
                 "levels in coarser"};
  }
}

std::span<const BlockId> DisplaySurface::changed() const noexcept { return state_->changed; }
std::span<const BlockId> DisplaySurface::gone() const noexcept { return state_->gone; }

DisplayBlock DisplaySurface::block(const BlockId& id) const {
  const auto& blocks = state_->blocks.blocks();
  const auto found = blocks.find(leaf_of(id));
  if (found == blocks.end() || found->second.triangles.empty()) return {};
  return found->second.shown_as(id, state_->voxel_mm);
}

std::vector<BlockId> DisplaySurface::blocks() const {
  std::vector<BlockId> ids = DisplayAccess::drawn(*this);
  std::sort(ids.begin(), ids.end());
  return ids;
}

DisplayStats DisplaySurface::stats() const {
  DisplayStats stats;
  stats.triangles = state_->blocks.triangle_count();
  stats.hidden_leaves = state_->choice.hidden_count();
  stats.bytes = state_->choice.bytes();
  constexpr std::size_t kEntry = sizeof(LeafKey) + sizeof(DrawnBlock) + 2 * sizeof(void*);
  for (const auto& [where, block] : state_->blocks.blocks()) {
    stats.blocks += block.triangles.empty() ? 0 : 1;
    stats.vertices += static_cast<std::int64_t>(block.vertices.size());
    stats.bytes +=
        static_cast<std::int64_t>(kEntry + block.vertices.capacity() * sizeof(DisplayVertex) +
                                  block.triangles.capacity() * sizeof(Triangle));
  }
  return stats;
}

}  // namespace argil
