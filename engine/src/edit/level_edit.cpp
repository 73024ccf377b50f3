// SPDX-License-Identifier: GPL-3.0-or-later
// Copies of leaves are filled in parallel; the index from origins to copies is made by one thread
// afterwards, in the order of the origins.
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

std::vector<LeafEdit> EditMemory::take(std::size_t count) {
  std::vector<LeafEdit> leaves;
  if (!kept_.empty()) {
    leaves = std::move(kept_.back());
    kept_.pop_back();
    leaves_ -= leaves.capacity();
  }
  leaves.clear();
  leaves.resize(count);
  return leaves;
}

void EditMemory::give(std::vector<LeafEdit>&& leaves) noexcept {
  constexpr std::size_t kMostLeaves = (std::size_t{64} << 20) / sizeof(LeafEdit);
  if (kept_.size() == kMostKept || leaves_ + leaves.capacity() > kMostLeaves) return;
  leaves_ += leaves.capacity();
  kept_.push_back(std::move(leaves));
}

LevelEdit::LevelEdit(const LevelStack& stack, EditMemory& memory, int level,
                     const std::vector<Coord>& origins, const LevelEdit* coarser)
    : stack_(stack), memory_(memory), level_(level), leaves_(memory.take(origins.size())) {
  assert(stack.is_level(level));
  assert(coarser == nullptr || (coarser->level() == level + 1 && &coarser->stack() == &stack));
  for_each_leaf(origins.size(), [&](std::size_t i) {
    LeafEdit& edit = leaves_[i];
    edit.origin = origins[i];
    const VdbLeaf* leaf = stack.leaf(level, origins[i]);
    edit.existed = leaf != nullptr;
    if (leaf != nullptr) {
      std::memcpy(edit.before.data(), leaf->buffer().data(), sizeof(LeafValues));
    } else if (coarser != nullptr) {
      upsample(coarse_nodes(*coarser, origins[i]), edit.before);
      clamp_to(stack.band_mm(level), edit.before);
    } else {
      prolong_leaf(stack, level, origins[i], edit.before);
    }
    edit.now = edit.before;
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
    return edit->now[static_cast<std::size_t>(leaf_offset(node))];
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
  for_each_leaf(leaves_.size(), [&](std::size_t n) {
    LeafEdit& leaf = leaves_[n];
    leaf.changed = std::memcmp(leaf.now.data(), leaf.before.data(), sizeof(LeafValues)) != 0;
    if (leaf.changed) leaf.changed_nodes = changed_nodes(leaf.before.data(), leaf.now.data());
  });
}

}  // namespace argil
