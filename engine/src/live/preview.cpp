// SPDX-License-Identifier: GPL-3.0-or-later
// A preview is a clay of its own, made of copies of the coarser levels, and the blocks of its
// surface that differ from the clay's.
#include "argil/engine/preview.h"

#include <algorithm>
#include <cassert>
#include <new>
#include <sstream>
#include <utility>
#include <vector>

#include "brush/dab.h"
#include "clay/clay_access.h"
#include "clay/clay_state.h"
#include "field/mask.h"
#include "surface/block_surface.h"

namespace argil {
namespace {

Clay coarse_clay(const Clay& clay, int level) {
  const LevelStack& from = levels_of(clay);
  std::unique_ptr<LevelStack> levels = from.copy_from(level);
  if (from.mask() != nullptr) levels->exchange_mask(coarsened(*from.mask(), level));
  levels->drop_mask_of_nothing();
  ClayOptions options = clay.options();
  options.voxel_mm = levels->voxel_mm(0);
  return clay_of_levels(std::move(levels), options);
}

Result<void> validate_tool_voxels(double tool_voxels) {
  if (tool_voxels >= 8.0 && tool_voxels <= 1000.0) return {};
  std::ostringstream message;
  message << "tool_voxels is " << tool_voxels << "; must be from 8 to 1000, usually 32";
  return Error{ErrorKind::bad_input, message.str()};
}

}  // namespace

struct Preview::State {
  State(Clay of, int at_level)
      : clay(std::move(of)), level(at_level), revision(argil::revision(clay)) {
    assert(level > 0);
    forget_blocks();
  }

  void forget_blocks() {
    blocks.begin_with_changes(levels_of(clay));
    is_whole = false;
    changed.clear();
    gone.clear();
  }

  BlockId named(const LeafKey& at) const { return id_of({at.level + level, at.origin}); }
  std::vector<BlockId> named(const std::vector<LeafKey>& origins) const {
    std::vector<BlockId> ids;
    ids.reserve(origins.size());
    for (const LeafKey& at : origins) ids.push_back(named(at));
    return ids;
  }

  std::int64_t update() {
    const auto changes = changes_since(clay, revision);
    // More changed than the clay remembers: then all of it.
    if (!changes) is_whole = true;
    const std::int64_t extracted =
        changes ? blocks.update(levels_of(clay), *changes) : blocks.rebuild_all(levels_of(clay));
    changed = named(blocks.changed());
    gone = named(blocks.gone());
    revision = argil::revision(clay);
    return extracted;
  }

  Clay clay;
  int level;
  BlocksOf<DrawnBlock> blocks;
  bool is_whole = false;   // there are all blocks, not only those that changed
  std::uint64_t revision;  // of the clay, when the blocks were brought up to date
  std::vector<BlockId> changed;
  std::vector<BlockId> gone;
};

Preview::Preview(std::unique_ptr<State> state) : state_(std::move(state)) {}
Preview::Preview(Preview&&) noexcept = default;
Preview& Preview::operator=(Preview&&) noexcept = default;
Preview::~Preview() = default;

int Preview::level_of(const Clay& clay, const Tool& tool, double tool_voxels) noexcept {
  const LevelStack& levels = levels_of(clay);
  const int most = level_of_tool(levels, smallest_radius(tool));
  int level = 0;
  while (level < most && largest_radius(tool) > tool_voxels * levels.voxel_mm(level)) ++level;
  return level;
}

Result<std::optional<Preview>> Preview::begin(const Clay& clay, const Tool& tool,
                                              const StrokeStyle& style, double tool_voxels) {
  if (clay.is_stroke_open()) return stroke_is_open();
  if (auto ok = validate_brush(tool, style); !ok) return ok.error();
  if (auto ok = validate_tool_voxels(tool_voxels); !ok) return ok.error();
  const int level = level_of(clay, tool, tool_voxels);
  if (level == 0) return std::optional<Preview>();
  try {
    const std::int64_t free = clay.use().free_bytes;
    const std::int64_t takes = leaf_bytes(levels_of(clay), level) + mask_bytes(levels_of(clay));
    if (takes >= free) throw OverLimit(takes);
    auto state = std::make_unique<State>(coarse_clay(clay, level), level);
    if (auto ok = state->clay.set_limits({.undo_bytes = 0, .memory_bytes = free}); !ok) {
      return ok.error();
    }
    if (auto ok = state->clay.begin_stroke(tool, style); !ok) return ok.error();
    return std::optional<Preview>(Preview(std::move(state)));
  } catch (const std::bad_alloc& fault) {
    return out_of_memory(fault, "preview the stroke");
  }
}

Result<int> Preview::extend(std::span<const StrokeSample> samples) {
  return state_->clay.extend_stroke(samples);
}

Result<StrokeReport> Preview::end() { return state_->clay.end_stroke(); }

int Preview::level() const noexcept { return state_->level; }
const Clay& Preview::clay() const noexcept { return state_->clay; }

Result<std::int64_t> Preview::update_surface() {
  try {
    return state_->update();
  } catch (const std::bad_alloc&) {
    state_->forget_blocks();
    return Error{ErrorKind::memory,
                 "no memory left for the surface of the preview; drop the preview"};
  }
}

std::span<const BlockId> Preview::changed() const noexcept { return state_->changed; }
std::span<const BlockId> Preview::gone() const noexcept { return state_->gone; }

DisplayBlock Preview::block(const BlockId& id) const {
  const auto& blocks = state_->blocks.blocks();
  LeafKey at = leaf_of(id);
  at.level -= state_->level;
  const auto found = blocks.find(at);
  if (found == blocks.end() || found->second.triangles.empty()) return {};
  const double voxel =
      levels_of(state_->clay).voxel_mm(0) / static_cast<double>(std::int64_t{1} << state_->level);
  return found->second.shown_as(id, voxel);
}

bool Preview::replaces(const BlockId& of_clay) const noexcept {
  if (of_clay.level < 0) return false;
  if (state_->is_whole) return true;
  const LeafKey at = leaf_of(of_clay);
  const int steps = std::max(0, state_->level - at.level);
  return state_->blocks.has_seen_to(
      {std::max(at.level, state_->level) - state_->level, leaf_origin(at.origin >> steps)});
}

}  // namespace argil
