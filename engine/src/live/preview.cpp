// SPDX-License-Identifier: GPL-3.0-or-later
// A preview is a clay of its own, made of copies of the coarser levels, and the blocks that are
// drawn of it: the clay's own with their vertices moved or dragged along, or others in their place.
#include "argil/engine/preview.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <new>
#include <sstream>
#include <utility>
#include <variant>
#include <vector>

#include "action/drag_push.h"
#include "brush/dab_plan.h"
#include "clay/clay_access.h"
#include "clay/clay_state.h"
#include "edit/edge_rounding.h"
#include "field/mask.h"
#include "live/dragged_blocks.h"
#include "live/moved_blocks.h"
#include "live/sketch_blocks.h"
#include "surface/display_access.h"
#include "tool/band_noise.h"
#include "tool/emboss_size.h"

namespace argil {
namespace {

/// Its edges are as wide as those that the tool will leave in the clay, and not as its own finest
/// level would want them.
Clay coarse_clay(const Clay& clay, const Tool& tool, int level) {
  const LevelStack& from = levels_of(clay);
  std::unique_ptr<LevelStack> levels = from.copy_from(level);
  if (from.mask() != nullptr) levels->exchange_mask(coarsened(*from.mask(), level));
  levels->drop_mask_of_nothing();
  ClayOptions options = clay.options();
  options.voxel_mm = levels->voxel_mm(0);
  const double radius_mm =
      std::max(std::abs(tool.strength) * smallest_radius(tool), from.voxel_mm(0));
  options.edge_radius_mm = edge_radius(from, level_of_shape(from, tool, radius_mm),
                                       clay.options().edge_radius_mm, radius_mm);
  return clay_of_levels(std::move(levels), options);
}

/// As coarse_clay, only to be read.
Clay coarse_levels(const Clay& clay, int level) {
  ClayOptions options = clay.options();
  options.voxel_mm = levels_of(clay).voxel_mm(level);
  return clay_of_levels(levels_of(clay).copy_from(level), options);
}

Result<void> validate_tool_voxels(double tool_voxels) {
  if (tool_voxels >= 8.0 && tool_voxels <= 1000.0) return {};
  std::ostringstream message;
  message << "tool_voxels is " << tool_voxels << "; must be from 8 to 1000, usually "
          << Preview::kOtherVoxels << " or " << Preview::kStampVoxels;
  return Error{ErrorKind::bad_input, message.str()};
}

/// Whether it makes surface where there was none, or takes matter far along: then vertices that
/// only follow the field's values would not show it, and where nothing else tells where they go,
/// other blocks stand in their place.
bool makes_surface(Action action) {
  if (drag_push_of(action) != nullptr) return false;
  return is_stamped(action) || can_be_carried(action) || action == Action::snake_hook ||
         action == Action::trim || action == Action::emboss;
}

/// A coarser level would show another noise, of longer waves, or an image so blurred that it is
/// another one: what is finer than two pixels, or than two voxels of the clay, is averaged.
bool holds_detail(const LevelStack& levels, const Tool& tool, int level) {
  const double voxel = levels.voxel_mm(level);
  if (tool.action == Action::noise) return noise_wavelength(tool) >= kLeastNoiseVoxels * voxel;
  if (tool.action != Action::emboss) return true;
  return 2.0 * std::max(emboss_pixel_mm(tool), levels.voxel_mm(0)) >= voxel;
}

void sort_without_repeats(std::vector<BlockId>& ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

/// What came again is not gone.
void put_in_order(BlockLists& lists) {
  sort_without_repeats(lists.changed);
  sort_without_repeats(lists.gone);
  std::vector<BlockId> gone;
  std::set_difference(lists.gone.begin(), lists.gone.end(), lists.changed.begin(),
                      lists.changed.end(), std::back_inserter(gone));
  lists.gone = std::move(gone);
}

}  // namespace

struct Preview::State {
  State(const Clay& of, const DisplaySurface& shown, const Tool& tool, const StrokeStyle& style,
        int at_level)
      : clay(coarse_clay(of, tool, at_level)),
        before(coarse_levels(of, at_level)),
        level(at_level),
        revision(argil::revision(clay)) {
    assert(level > 0);
    if (drag_push_of(tool.action) != nullptr) {
      blocks.emplace<DraggedBlocks>(shown, tool, style, levels_of(clay).mask());
    } else if (makes_surface(tool.action)) {
      blocks.emplace<SketchBlocks>(shown, before, clay, level);
    } else {
      blocks.emplace<MovedBlocks>(shown, before, clay, level);
    }
  }

  std::int64_t update() {
    const auto changes = changes_since(clay, revision);
    lists = {};
    std::int64_t made = 0;
    if (auto* const moved = std::get_if<MovedBlocks>(&blocks)) made = moved->update(changes, lists);
    if (auto* const sketch = std::get_if<SketchBlocks>(&blocks)) {
      made = sketch->update(changes, lists);
    }
    if (auto* const dragged = std::get_if<DraggedBlocks>(&blocks)) made = dragged->update(lists);
    put_in_order(lists);
    revision = argil::revision(clay);
    return made;
  }

  DisplayBlock block(const BlockId& id) const {
    if (const auto* const moved = std::get_if<MovedBlocks>(&blocks)) return moved->block(id);
    if (const auto* const sketch = std::get_if<SketchBlocks>(&blocks)) return sketch->block(id);
    if (const auto* const dragged = std::get_if<DraggedBlocks>(&blocks)) return dragged->block(id);
    return {};
  }

  Clay clay;
  Clay before;
  int level;
  std::uint64_t revision;  // of the clay, when the blocks were brought up to date
  std::variant<std::monostate, MovedBlocks, SketchBlocks, DraggedBlocks> blocks;
  BlockLists lists;
};

Preview::Preview(std::unique_ptr<State> state) : state_(std::move(state)) {}
Preview::Preview(Preview&&) noexcept = default;
Preview& Preview::operator=(Preview&&) noexcept = default;
Preview::~Preview() = default;

int Preview::level_of(const Clay& clay, const Tool& tool,
                      std::optional<double> tool_voxels) noexcept {
  const double most_voxels = tool_voxels.value_or(usual_voxels(tool.action));
  const LevelStack& levels = levels_of(clay);
  const int most = level_of_tool(levels, smallest_radius(tool));
  int level = 0;
  while (level < most && largest_radius(tool) > most_voxels * levels.voxel_mm(level) &&
         holds_detail(levels, tool, level + 1)) {
    ++level;
  }
  return level;
}

Result<std::optional<Preview>> Preview::begin(const Clay& clay, const DisplaySurface& shown,
                                              const Tool& tool, const StrokeStyle& style,
                                              std::optional<double> tool_voxels) {
  if (clay.is_stroke_open()) return stroke_is_open();
  if (auto ok = validate_brush(tool, style); !ok) return ok.error();
  if (tool_voxels) {
    if (auto ok = validate_tool_voxels(*tool_voxels); !ok) return ok.error();
  }
  int level = level_of(clay, tool, tool_voxels);
  if (level == 0 || is_painted(tool.action)) return std::optional<Preview>();
  // What is hidden of the clay cannot be drawn in part.
  if (makes_surface(tool.action)) {
    level = std::max(level, DisplayAccess::coarsest_hidden(shown) + 1);
  }
  if (level > level_of_tool(levels_of(clay), smallest_radius(tool))) {
    return std::optional<Preview>();
  }
  try {
    const std::int64_t free = clay.use().free_bytes;
    const std::int64_t copy = leaf_bytes(levels_of(clay), level);
    const std::int64_t takes = 2 * copy + mask_bytes(levels_of(clay));
    if (takes >= free) throw OverLimit(takes);
    auto state = std::make_unique<State>(clay, shown, tool, style, level);
    if (auto ok = state->clay.set_limits({.undo_bytes = 0, .memory_bytes = free - copy}); !ok) {
      return ok.error();
    }
    if (auto ok = state->clay.begin_stroke(tool, style); !ok) return ok.error();
    return std::optional<Preview>(Preview(std::move(state)));
  } catch (const std::bad_alloc& fault) {
    return out_of_memory(fault, "preview the stroke");
  }
}

Result<int> Preview::extend(std::span<const StrokeSample> samples) {
  Result<int> extended = state_->clay.extend_stroke(samples);
  auto* const dragged = std::get_if<DraggedBlocks>(&state_->blocks);
  if (!extended || dragged == nullptr) return extended;
  try {
    dragged->feed(samples);
    return extended;
  } catch (const std::bad_alloc& fault) {
    return out_of_memory(fault, "draw the preview");
  }
}

Result<StrokeReport> Preview::end() {
  Result<StrokeReport> ended = state_->clay.end_stroke();
  auto* const dragged = std::get_if<DraggedBlocks>(&state_->blocks);
  if (!ended || dragged == nullptr) return ended;
  try {
    dragged->finish();
    return ended;
  } catch (const std::bad_alloc& fault) {
    return out_of_memory(fault, "draw the preview");
  }
}

int Preview::level() const noexcept { return state_->level; }
const Clay& Preview::clay() const noexcept { return state_->clay; }

Result<std::int64_t> Preview::update_surface() {
  try {
    return state_->update();
  } catch (const std::bad_alloc&) {
    state_->lists = {};
    return Error{ErrorKind::memory,
                 "no memory left for the surface of the preview; drop the preview"};
  }
}

std::span<const BlockId> Preview::changed() const noexcept { return state_->lists.changed; }
std::span<const BlockId> Preview::gone() const noexcept { return state_->lists.gone; }
DisplayBlock Preview::block(const BlockId& id) const { return state_->block(id); }

}  // namespace argil
