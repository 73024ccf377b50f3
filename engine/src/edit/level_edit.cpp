// SPDX-License-Identifier: GPL-3.0-or-later
// Leaves that are not there are filled in parallel; the index from origins to leaves is made by one
// thread afterwards, in the order of the origins.
#include "edit/level_edit.h"

#include <cassert>
#include <cstring>
#include <utility>

#include "field/parallel.h"
#include "field/prolongation.h"

namespace argil {

CoarseNodes coarse_nodes(const LevelEdit& coarser, const Coord& origin) {
  LevelEdit::Reader reader(coarser);
  return gather_coarse(
      origin, [&](const Coord& at) { return reader.filled_now(at); },
      [&](const Coord& node) { return coarser.stack().sample(coarser.level(), node); });
}

std::unique_ptr<EditMemory::Chunk> EditMemory::take() {
  const std::lock_guard lock(mutex_);
  if (kept_.empty()) return std::make_unique_for_overwrite<Chunk>();
  std::unique_ptr<Chunk> chunk = std::move(kept_.back());
  kept_.pop_back();
  return chunk;
}

void EditMemory::give(std::vector<std::unique_ptr<Chunk>>&& chunks) noexcept {
  const std::lock_guard lock(mutex_);
  if (kept_.capacity() < kMostChunks) {
    try {
      kept_.reserve(kMostChunks);
    } catch (const std::bad_alloc&) {
      return;  // what is not kept is freed
    }
  }
  for (std::unique_ptr<Chunk>& chunk : chunks) {
    if (kept_.size() < kMostChunks) kept_.push_back(std::move(chunk));
  }
}

void EditMemory::clear() noexcept {
  const std::lock_guard lock(mutex_);
  kept_.clear();
}

LeafArena::LeafArena(EditMemory& memory, std::size_t leaves)
    : memory_(memory),
      places_((leaves + EditMemory::kLeavesOfChunk - 1) / EditMemory::kLeavesOfChunk) {}

EditMemory::Chunk* LeafArena::open(std::size_t at) {
  const std::lock_guard lock(mutex_);
  EditMemory::Chunk* there = places_[at].load(std::memory_order_relaxed);
  if (there != nullptr) return there;  // by another thread meanwhile
  chunks_.push_back(memory_.take());
  places_[at].store(chunks_.back().get(), std::memory_order_release);
  return chunks_.back().get();
}

void LeafEdit::mark_changes() noexcept {
  if (is_marked_) return;
  is_marked_ = true;
  changed = std::memcmp(now_, before_, sizeof(LeafValues)) != 0;
  if (changed) changed_nodes = argil::changed_nodes(before_, now_);
}

LevelEdit::LevelEdit(const LevelStack& stack, EditMemory& memory, int level,
                     const std::vector<Coord>& origins, const LevelEdit* coarser)
    : stack_(stack), level_(level), arena_(memory, 2 * origins.size()), leaves_(origins.size()) {
  assert(stack.is_level(level));
  assert(coarser == nullptr || (coarser->level() == level + 1 && &coarser->stack() == &stack));
  for_each_leaf(origins.size(), [&](std::size_t i) {
    LeafEdit& edit = leaves_[i];
    edit.origin = origins[i];
    if (const VdbLeaf* leaf = stack.leaf(level, origins[i])) {
      edit.open(values_of(*leaf), nullptr, arena_);
      return;
    }
    LeafValues& filled = arena_.take();
    if (coarser != nullptr) {
      upsample(coarse_nodes(*coarser, origins[i]), filled);
      clamp_to(stack.band_mm(level), filled);
    } else {
      prolong_leaf(stack, level, origins[i], filled);
    }
    edit.open(nullptr, &filled, arena_);
  });
  for (std::size_t i = 0; i < origins.size(); ++i) {
    assert(index_.get(origins[i]) == 0);  // no repeats
    index_.at(origins[i]) = static_cast<std::uint32_t>(i + 1);
  }
}

LeafEdit* LevelEdit::find(const Coord& origin) {
  const std::uint32_t found = index_.get(origin);
  return found == 0 ? nullptr : &leaves_[found - 1];
}

const LeafEdit* LevelEdit::find(const Coord& origin) const {
  const std::uint32_t found = index_.get(origin);
  return found == 0 ? nullptr : &leaves_[found - 1];
}

float LevelEdit::now(const Coord& node) const {
  if (const LeafEdit* edit = find(leaf_origin(node))) {
    return edit->now()[static_cast<std::size_t>(leaf_offset(node))];
  }
  return stack_.sample(level_, node);
}

void LevelEdit::gather_now(const openvdb::CoordBBox& box, std::vector<float>& out) const {
  assert(!box.empty());
  out.resize(static_cast<std::size_t>(box.volume()));
  Reader reader(*this);
  for_each_leaf_origin(box, [&](const Coord& origin) {
    LeafValues filled;
    const float* values = reader.filled_now(origin);
    if (values == nullptr) {
      prolong_leaf(stack_, level_, origin, filled);
      values = filled.data();
    }
    copy_into_box(origin, values, box, out);
  });
}

void LevelEdit::mark_changes() {
  for_each_leaf(leaves_.size(), [&](std::size_t n) { leaves_[n].mark_changes(); });
}

}  // namespace argil
