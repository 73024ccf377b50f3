// SPDX-License-Identifier: GPL-3.0-or-later
// What a clay remembers of its changes: the log that others read, and the steps to undo.
#include <algorithm>
#include <atomic>
#include <cassert>
#include <new>
#include <span>
#include <utility>

#include "clay/clay_access.h"
#include "clay/clay_state.h"
#include "field/mask.h"
#include "field/parallel.h"

namespace argil {
namespace {

/// 10 MB. Half of it is more than any dab changes.
constexpr std::size_t kMostLoggedChanges = std::size_t{1} << 16;

std::uint64_t new_identity() {
  static std::atomic<std::uint64_t> next{1};
  return next++;
}

}  // namespace

Clay::State::State(std::unique_ptr<LevelStack> stack, const ClayOptions& clay_options)
    : options(clay_options), levels(std::move(stack)) {
  assert(levels);
  identity = new_identity();
}

void Clay::State::log_change(const LeafChange& change) {
  assert(levels->is_level(change.level) && is_leaf_origin(change.origin));
  if (changes.size() >= kMostLoggedChanges) {
    // The newer half stays: who looks after every dab never misses one.
    constexpr std::size_t kOld = kMostLoggedChanges / 2;
    changes.erase(changes.begin(), changes.begin() + kOld);
    forgotten += kOld;
  }
  if (changes.size() == changes.capacity()) {
    // By half a MB: doubled, a session of strokes would hold up to 5 MB that nothing is in.
    constexpr std::size_t kGrowth = 4096;
    changes.reserve(std::min(changes.size() + kGrowth, kMostLoggedChanges));
  }
  changes.push_back(change);
}

/// Leaves that stay say which nodes changed, so that readers of the log need not take all as new.
void Clay::State::restore(const UndoStep& step) {
  for (const auto& [key, saved] : step) {
    const auto& [level, origin] = key;
    LeafChange change{level, origin};
    if (const VdbLeaf* leaf = levels->leaf(level, origin); leaf != nullptr && saved.values) {
      change = change_of_values(level, origin, values_of(*leaf), saved.values->data());
    }
    log_change(change);
    if (saved.values) {
      levels->set_leaf(level, origin, saved.values->data());
    } else {
      levels->erase_leaf(level, origin, saved.tile);
    }
  }
}

namespace {

/// A leaf of a step, and the same leaf of the clay.
struct SwappedLeaf {
  int level;
  Coord origin;
  SavedLeaf* saved;
  bool is_there;    ///< the clay has it
  SavedLeaf clays;  ///< what it is there now, unless both have it: those swap
  LeafChange change;
  bool is_swapped = false;

  bool stays() const noexcept { return is_there && saved->values; }
};

std::vector<SwappedLeaf> leaves_to_swap(const LevelStack& stack, UndoStep& step) {
  std::vector<SwappedLeaf> leaves;
  leaves.reserve(step.size());
  for (auto& [key, saved] : step) {
    const auto& [level, origin] = key;
    const VdbLeaf* leaf = stack.leaf(level, origin);
    const bool is_kept = leaf != nullptr && !saved.values;
    const float tile = leaf == nullptr ? stack.grid(level).tree().getValue(origin) : 0.0F;
    leaves.push_back({level, origin, &saved, leaf != nullptr,
                      SavedLeaf(is_kept ? values_of(*leaf) : nullptr, tile),
                      LeafChange{level, origin}, false});
  }
  return leaves;
}

/// Makes the leaves that only the step has, or none of them.
void make_missing(LevelStack& stack, const std::vector<SwappedLeaf>& leaves) {
  std::size_t made = 0;
  const auto is_missing = [](const SwappedLeaf& leaf) { return !leaf.is_there; };
  try {
    for (; made < leaves.size(); ++made) {
      const SwappedLeaf& leaf = leaves[made];
      if (!is_missing(leaf)) continue;
      if (leaf.saved->values) {
        stack.set_leaf(leaf.level, leaf.origin, leaf.saved->values->data());
      } else {
        stack.erase_leaf(leaf.level, leaf.origin, leaf.saved->tile);
      }
    }
  } catch (const std::bad_alloc&) {
    for (const SwappedLeaf& leaf : std::span(leaves).first(made)) {
      if (is_missing(leaf)) stack.erase_leaf(leaf.level, leaf.origin, leaf.clays.tile);
    }
    throw;
  }
}

}  // namespace

/// Values of leaves that both have are swapped, in parallel; nothing is written before all that
/// takes memory is done.
void Clay::State::exchange(UndoStep& step) {
  std::vector<SwappedLeaf> leaves = leaves_to_swap(*levels, step);
  changes.reserve(std::min(changes.size() + leaves.size(), kMostLoggedChanges));
  make_missing(*levels, leaves);
  const auto swap = [&](SwappedLeaf& leaf) {
    if (!leaf.stays() || leaf.is_swapped) return;
    const float* now = values_of(*levels->leaf(leaf.level, leaf.origin));
    leaf.change = change_of_values(leaf.level, leaf.origin, now, leaf.saved->values->data());
    levels->swap_leaf(leaf.level, leaf.origin, *leaf.saved->values);
    leaf.is_swapped = true;
  };
  try {
    for_each_leaf(leaves.size(), [&](std::size_t n) { swap(leaves[n]); });
  } catch (const std::bad_alloc&) {  // no memory for threads: what is left is done here
    std::for_each(leaves.begin(), leaves.end(), swap);
  }
  for (SwappedLeaf& leaf : leaves) {
    log_change(leaf.change);
    if (leaf.stays()) continue;
    if (leaf.is_there) levels->erase_leaf(leaf.level, leaf.origin, leaf.saved->tile);
    *leaf.saved = std::move(leaf.clays);
  }
}

void Clay::State::restore(const MaskStep& step) {
  if (step.empty()) return;
  Mask& mask = levels->mask_to_change();
  for (const auto& [origin, saved] : step) {
    if (saved.values) {
      mask.put(origin, *saved.values);
    } else {
      mask.put(origin, saved.tile);
    }
  }
  levels->drop_mask_of_nothing();
}

MaskStep Clay::State::exchange(const MaskStep& step) {
  MaskStep inverse;
  const Mask nothing(1.0, 0.0F);
  const Mask& mask = levels->mask() != nullptr ? *levels->mask() : nothing;
  for (const auto& entry : step) {
    const Coord& origin = entry.first;
    inverse.emplace(origin, SavedLeaf(mask.leaf(origin), mask.constant(origin)));
  }
  restore(step);
  return inverse;
}

FormerLevels Clay::State::replace_levels(FormerLevels by) {
  assert(by.levels && by.levels->voxel_mm(0) == by.options.voxel_mm && !open);
  FormerLevels former{std::move(levels), options};
  levels = std::move(by.levels);
  options = by.options;
  identity = new_identity();
  forgotten += changes.size() + 1;
  changes.clear();
  return former;
}

/// The inverse of an entry is an entry of the same kind.
UndoEntry Clay::State::swap_back(UndoEntry& entry) {
  if (auto* step = std::get_if<UndoStep>(&entry)) {
    exchange(*step);
    return std::move(*step);
  }
  if (auto* step = std::get_if<MaskStep>(&entry)) return exchange(*step);
  if (auto* former = std::get_if<FormerMask>(&entry)) {
    return FormerMask{levels->exchange_mask(std::move(former->mask))};
  }
  return replace_levels(std::move(std::get<FormerLevels>(entry)));
}

void Clay::State::push_undo(UndoEntry entry) {
  history.push(std::move(entry));
  history.trim(limits.undo_bytes);
}

EditTarget Clay::State::target_into(UndoStep& step) {
  LeafSink sink = [this, &step](const LeafChange& change, const float* values, float tile) {
    log_change(change);
    // The first state within the step counts.
    step.try_emplace({change.level, change.origin}, values, tile);
  };
  EditTarget target{*levels, memory, tolerance_mm(), std::move(sink), free_bytes()};
  target.edge_radius_mm = options.edge_radius_mm;
  return target;
}

Result<std::int64_t> Clay::State::run(
    const std::function<Result<void>(EditTarget& target, const UndoStep& step)>& edit) {
  assert(!open);
  UndoStep step;
  EditTarget target = target_into(step);
  try {
    if (auto ok = edit(target, step); !ok) {
      restore(step);
      return ok.error();
    }
    const auto changed = static_cast<std::int64_t>(step.size());
    history.make_room();
    push_undo(std::move(step));
    return changed;
  } catch (...) {
    restore(step);
    throw;
  }
}

void ClayAccess::replace_levels(Clay& clay, std::unique_ptr<LevelStack> levels,
                                const ClayOptions& options) {
  Clay::State& state = *clay.state_;
  const ChangingCall call(state.user);
  assert(levels && !state.open);
  state.history.make_room();
  state.push_undo(state.replace_levels({std::move(levels), options}));
}

void ClayAccess::swap_histories(Clay& one, Clay& other) noexcept {
  assert(!one.state_->open && !other.state_->open);
  std::swap(one.state_->history, other.state_->history);
}

void ClayAccess::forget_history(Clay& clay) noexcept {
  assert(!clay.state_->open);
  clay.state_->history = History();
}

int Clay::undo_depth() const noexcept { return static_cast<int>(state_->history.undo_depth()); }

bool Clay::undo() {
  const ChangingCall call(state_->user);
  History& history = state_->history;
  if (state_->open || !history.has_undo()) return false;
  history.make_room();
  history.undone(state_->swap_back(history.next_undo()));
  return true;
}

bool Clay::redo() {
  const ChangingCall call(state_->user);
  History& history = state_->history;
  if (state_->open || !history.has_redo()) return false;
  history.make_room();
  history.redone(state_->swap_back(history.next_redo()));
  return true;
}

}  // namespace argil
