// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/engine/sketch.h"

#include <algorithm>
#include <new>
#include <sstream>
#include <utility>
#include <vector>

#include "block_surface.h"
#include "clay_changes.h"
#include "clay_state.h"
#include "mask.h"

namespace argil {
namespace {

Clay coarse_clay(const Clay& clay, int level) {
  const LevelStack& from = clay.levels();
  std::unique_ptr<LevelStack> levels = from.copy_from(level);
  if (from.mask() != nullptr) levels->exchange_mask(coarsened(*from.mask(), level));
  levels->drop_mask_of_nothing();
  ClayOptions options = clay.options();
  options.voxel_mm = levels->voxel_mm(0);
  return Clay::from_levels(std::move(levels), options);
}

Result<void> validate_tool_voxels(double tool_voxels) {
  if (tool_voxels >= 8.0 && tool_voxels <= 1000.0) return {};
  std::ostringstream message;
  message << "tool_voxels is " << tool_voxels << "; must be from 8 to 1000, usually 32";
  return Error{ErrorKind::bad_input, message.str()};
}

}  // namespace

struct Sketch::State {
  State(Clay of, int at_level)
      : clay(std::move(of)), level(at_level), revision(argil::revision(clay)) {
    forget_blocks();
  }

  void forget_blocks() {
    blocks.begin_with_changes(clay.levels());
    is_whole = false;
    changed.clear();
    gone.clear();
  }

  BlockId named(const LeafPlace& at) const { return id_of({at.level + level, at.place}); }
  std::vector<BlockId> named(const std::vector<LeafPlace>& places) const {
    std::vector<BlockId> ids;
    ids.reserve(places.size());
    for (const LeafPlace& at : places) ids.push_back(named(at));
    return ids;
  }

  std::int64_t update() {
    const auto changes = changes_since(clay, revision);
    // More changed than the clay remembers: then all of it.
    if (!changes) is_whole = true;
    const std::int64_t extracted =
        changes ? blocks.update(clay.levels(), *changes) : blocks.rebuild_all(clay.levels());
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

Sketch::Sketch(std::unique_ptr<State> state) : state_(std::move(state)) {}
Sketch::Sketch(Sketch&&) noexcept = default;
Sketch& Sketch::operator=(Sketch&&) noexcept = default;
Sketch::~Sketch() = default;

int Sketch::level_of(const Clay& clay, const Tool& tool, double tool_voxels) noexcept {
  const LevelStack& levels = clay.levels();
  const int most = level_of_tool(levels, smallest_radius(tool));
  int level = 0;
  while (level < most && largest_radius(tool) > tool_voxels * levels.voxel_mm(level)) ++level;
  return level;
}

Result<std::optional<Sketch>> Sketch::begin(const Clay& clay, const Tool& tool,
                                            const StrokeStyle& style, double tool_voxels) {
  if (clay.is_stroke_open()) return stroke_is_open();
  if (auto ok = validate_brush(tool, style); !ok) return ok.error();
  if (auto ok = validate_tool_voxels(tool_voxels); !ok) return ok.error();
  const int level = level_of(clay, tool, tool_voxels);
  if (level == 0) return std::optional<Sketch>();
  try {
    const std::int64_t free = clay.use().free_bytes;
    const std::int64_t takes = leaf_bytes(clay.levels(), level) + mask_bytes(clay.levels());
    if (takes >= free) throw OverLimit(takes);
    auto state = std::make_unique<State>(coarse_clay(clay, level), level);
    if (auto ok = state->clay.set_limits({.undo_bytes = 0, .memory_bytes = free}); !ok) {
      return ok.error();
    }
    if (auto ok = state->clay.begin_stroke(tool, style); !ok) return ok.error();
    return std::optional<Sketch>(Sketch(std::move(state)));
  } catch (const std::bad_alloc& fault) {
    return out_of_memory(fault, "sketch the stroke");
  }
}

Result<int> Sketch::extend(std::span<const StrokeSample> samples) {
  return state_->clay.extend_stroke(samples);
}

Result<StrokeReport> Sketch::end() { return state_->clay.end_stroke(); }

int Sketch::level() const noexcept { return state_->level; }
const Clay& Sketch::clay() const noexcept { return state_->clay; }

Result<std::int64_t> Sketch::update_surface() {
  try {
    return state_->update();
  } catch (const std::bad_alloc&) {
    state_->forget_blocks();
    return Error{ErrorKind::memory,
                 "no memory left for the surface of the sketch; drop the sketch"};
  }
}

std::span<const BlockId> Sketch::changed() const noexcept { return state_->changed; }
std::span<const BlockId> Sketch::gone() const noexcept { return state_->gone; }

DisplayBlock Sketch::block(const BlockId& id) const {
  const auto& blocks = state_->blocks.blocks();
  LeafPlace at = place_of(id);
  at.level -= state_->level;
  const auto found = blocks.find(at);
  if (found == blocks.end() || found->second.triangles.empty()) return {};
  const double voxel =
      state_->clay.levels().voxel_mm(0) / static_cast<double>(std::int64_t{1} << state_->level);
  return found->second.shown_as(id, voxel);
}

bool Sketch::replaces(const BlockId& of_clay) const noexcept {
  if (of_clay.level < 0) return false;
  if (state_->is_whole) return true;
  const LeafPlace at = place_of(of_clay);
  const int steps = std::max(0, state_->level - at.level);
  return state_->blocks.has_seen_to(
      {std::max(at.level, state_->level) - state_->level, place_of(at.place >> steps)});
}

}  // namespace argil
