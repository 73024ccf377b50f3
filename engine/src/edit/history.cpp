// SPDX-License-Identifier: GPL-3.0-or-later
// Steps are weighed once, when they come: their bytes never change afterwards.
#include "edit/history.h"

#include <algorithm>
#include <cassert>

namespace argil {
namespace {

/// A leaf's values, its masks and origin.
constexpr std::int64_t kSavedLeafBytes = sizeof(VdbLeaf) + sizeof(LeafValues);

template <class Step>
std::int64_t bytes_of_leaves(const Step& step) {
  constexpr std::int64_t kMapNode = 32 + sizeof(typename Step::value_type);
  std::int64_t bytes = 0;
  for (const auto& entry : step) {
    bytes += kMapNode;
    if (entry.second.values) bytes += static_cast<std::int64_t>(sizeof(LeafValues)) + 16;
  }
  return bytes;
}

std::int64_t step_bytes(const UndoStep& step) { return bytes_of_leaves(step); }
std::int64_t step_bytes(const MaskStep& step) { return bytes_of_leaves(step); }
std::int64_t step_bytes(const FormerMask& step) { return step.mask ? step.mask->bytes() : 0; }
std::int64_t step_bytes(const FormerLevels& step) {
  return leaf_bytes(*step.levels) + mask_bytes(*step.levels);
}

}  // namespace

std::vector<std::pair<int, Coord>> keys_of(const UndoStep& step) {
  std::vector<std::pair<int, Coord>> keys;
  keys.reserve(step.size());
  for (const auto& entry : step) keys.push_back(entry.first);
  return keys;
}

SavedLeaf::SavedLeaf(const float* at, float constant) : tile(constant) {
  if (at == nullptr) return;
  values = std::make_unique<LeafValues>();
  std::copy_n(at, kLeafNodes, values->begin());
}

std::int64_t leaf_bytes(const LevelStack& stack, int finest) {
  std::int64_t leaves = 0;
  for (int level = finest; level < stack.count(); ++level) {
    leaves += static_cast<std::int64_t>(stack.grid(level).tree().leafCount());
  }
  return leaves * kSavedLeafBytes;
}

std::int64_t mask_bytes(const LevelStack& stack) {
  return stack.mask() != nullptr ? stack.mask()->bytes() : 0;
}

void History::make_room() {
  for (Steps* steps : {&undo_, &redo_}) {
    if (steps->size() == steps->capacity()) steps->reserve(2 * steps->size() + 8);
  }
}

History::Step History::weighed(UndoEntry entry) noexcept {
  const std::int64_t bytes = std::visit([](const auto& step) { return step_bytes(step); }, entry);
  return {std::move(entry), bytes};
}

void History::push(UndoEntry entry) noexcept {
  assert(undo_.size() < undo_.capacity());
  undo_.push_back(weighed(std::move(entry)));
  bytes_ += undo_.back().bytes;
  for (const Step& step : redo_) bytes_ -= step.bytes;
  redo_.clear();
}

void History::move_last(Steps& from, Steps& to, UndoEntry inverse) noexcept {
  assert(!from.empty() && to.size() < to.capacity());
  to.push_back(weighed(std::move(inverse)));
  bytes_ += to.back().bytes - from.back().bytes;
  from.pop_back();
}

void History::trim(std::int64_t budget) {
  assert(budget >= 0 && bytes_ >= 0);
  while (bytes_ > budget && undo_.size() + redo_.size() > 1) {
    Steps& from = undo_.empty() || (undo_.size() == 1 && !redo_.empty()) ? redo_ : undo_;
    bytes_ -= from.front().bytes;
    from.erase(from.begin());
    if (&from == &undo_) ++forgotten_;
  }
}

}  // namespace argil
