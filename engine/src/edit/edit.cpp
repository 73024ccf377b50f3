// SPDX-License-Identifier: GPL-3.0-or-later
// An edit is prepared on copies and written at the end, so that it can be refused or fail without a
// trace. Order matters in commit(): the sink hears of a leaf before it changes, leaves that stay
// are rewritten in parallel, and only then does one thread add and remove leaves, which changes the
// tree.
#include "edit/edit.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "edit/coarsening_criterion.h"
#include "field/nesting.h"
#include "field/parallel.h"
#include "field/prolongation.h"

namespace argil {

namespace {

/// What every level relies on: values are finite and within its band.
[[maybe_unused]] bool is_within_band(const LeafEdit& leaf, float band) {
  return std::all_of(leaf.now(), leaf.now() + kLeafNodes,
                     [&](float value) { return std::abs(value) <= band; });  // false for NaN
}

}  // namespace

Edit::Edit(EditTarget& target)
    : target_(target),
      stack_(target.stack),
      wanted_(static_cast<std::size_t>(target.stack.count())) {}

void Edit::want(int level, const Coord& origin) {
  assert(levels_.empty() && stack_.is_level(level));
  wanted_[static_cast<std::size_t>(level)].at(origin) = 1;
}

void Edit::load() {
  assert(levels_.empty());
  std::vector<std::vector<Coord>> origins(wanted_.size());
  std::size_t count = 0;
  for (std::size_t n = 0; n < wanted_.size(); ++n) {
    const int level = static_cast<int>(n);
    wanted_[n].for_each([&](const Coord& origin, std::uint8_t) {
      origins[n].push_back(origin);
      if (level == stack_.top()) return;
      for_each_required_parent(origin, [&](const Coord& coarse) { want(level + 1, coarse); });
    });
    count += origins[n].size();
  }
  // Filled and written, and before and after a sweep where distances are solved.
  const auto bytes = static_cast<std::int64_t>(count * (sizeof(LeafEdit) + 4 * sizeof(LeafValues)));
  if (bytes > target_.free_bytes) throw OverLimit(bytes);
  levels_.resize(origins.size());
  const LevelEdit* coarser = nullptr;
  for (int level = stack_.top(); level >= 0; --level) {
    const auto n = static_cast<std::size_t>(level);
    levels_[n] = std::make_unique<LevelEdit>(stack_, target_.memory, level, origins[n], coarser);
    coarser = levels_[n].get();
  }
}

bool Edit::has_child(int level, const LeafEdit& leaf) {
  if (level == 0) return false;
  LevelEdit::Reader finer(this->level(level - 1));
  bool child = false;
  for (int octant = 0; octant < 8 && !child; ++octant) {
    child = finer.present_now(octant_origin(leaf.origin, octant));
  }
  return child;
}

/// Whether a leaf stays within a stroke: it holds a band, and it existed, changed, or is needed
/// below.
bool Edit::is_filled(int level, const LeafEdit& leaf) {
  if (!has_band(leaf.now(), stack_.band_mm(level))) return has_child(level, leaf);
  if (level == stack_.top() || leaf.existed || leaf.changed) return true;
  if (level == 0) return false;
  LevelEdit::Reader finer(this->level(level - 1));
  return required_by_finer(leaf.origin,
                           [&](const Coord& origin) { return finer.present_now(origin); });
}

void Edit::drop_empty_of(int level) {
  auto& leaves = this->level(level).leaves();
  for_each_leaf(leaves.size(),
                [&](std::size_t i) { leaves[i].present = is_filled(level, leaves[i]); });
}

void Edit::drop_empty() {
  for (int n = 0; n < stack_.count(); ++n) drop_empty_of(n);
}

void Edit::restrict_to(int level, RestrictedLeaves which) {
  assert(level > 0);
  drop_empty_of(level - 1);
  restrict_edit(this->level(level - 1), this->level(level), which);
}

/// Whether a leaf stays when the edit is pruned. Finer levels are judged first, so that what they
/// require is known.
bool Edit::stays(int level, const LeafEdit& leaf) {
  if (!has_band(leaf.now(), stack_.band_mm(level))) return has_child(level, leaf);
  if (level == stack_.top()) return true;
  if (level > 0) {
    LevelEdit::Reader finer(this->level(level - 1));
    if (required_by_finer(leaf.origin,
                          [&](const Coord& origin) { return finer.present_now(origin); })) {
      return true;
    }
  }
  return coarser_misses(leaf.now(), coarse_nodes(this->level(level + 1), leaf.origin),
                        coarsening_criterion(stack_, level, target_.tolerance_mm));
}

void Edit::prune() {
  for (int n = 0; n < stack_.count(); ++n) {
    auto& leaves = level(n).leaves();
    for_each_leaf(leaves.size(), [&](std::size_t i) { leaves[i].present = stays(n, leaves[i]); });
  }
}

/// What commit() does with a leaf. At the coarsest level an absent leaf may still change its
/// constant: a tool inside a large clay, or far outside.
Edit::Fate Edit::fate_of(int level, const LeafEdit& leaf) const {
  if (leaf.present && leaf.existed) return leaf.changed ? Fate::rewritten : Fate::kept;
  if (leaf.present) return Fate::made;
  const bool is_new_tile = leaf.changed && level == stack_.top();
  return leaf.existed || is_new_tile ? Fate::erased : Fate::kept;
}

bool Edit::commit() {
  bool came_or_went = false;
  for (int n = 0; n < stack_.count(); ++n) {
    level(n).mark_changes();
    const std::vector<LeafEdit>& leaves = level(n).leaves();
    for (const LeafEdit& leaf : leaves) {
      const Fate fate = fate_of(n, leaf);
      if (fate == Fate::kept) continue;
      assert(is_within_band(leaf, stack_.band_mm(n)));
      LeafChange change{n, leaf.origin};
      if (fate == Fate::rewritten) {
        change = change_of_values(n, leaf.origin, leaf.before(), leaf.now());
      }
      const float tile = leaf.existed ? 0.0F : stack_.grid(n).tree().getValue(leaf.origin);
      target_.sink(change, leaf.existed ? leaf.before() : nullptr, tile);
    }
    for_each_leaf(leaves.size(), [&](std::size_t i) {
      const LeafEdit& leaf = leaves[i];
      if (fate_of(n, leaf) != Fate::rewritten) return;
      stack_.rewrite_leaf(n, leaf.origin, leaf.now());
    });
    const float band = stack_.band_mm(n);
    for (const LeafEdit& leaf : leaves) {
      const Fate fate = fate_of(n, leaf);
      came_or_went = came_or_went || fate == Fate::made || fate == Fate::erased;
      if (fate == Fate::made) stack_.set_leaf(n, leaf.origin, leaf.now());
      if (fate == Fate::erased) {
        stack_.erase_leaf(n, leaf.origin, leaf.now()[0] < 0.0F ? -band : band);
      }
    }
  }
  return came_or_went;
}

EditTarget noting(const EditTarget& target, LeafList& changed) {
  EditTarget both = target;
  both.sink = [&changed, tell = target.sink](const LeafChange& change, const float* values,
                                             float tile) {
    changed.emplace_back(change.level, change.origin);
    tell(change, values, tile);
  };
  return both;
}

LeafList all_leaves(const LevelStack& stack) {
  LeafList leaves;
  for (int level = 0; level < stack.count(); ++level) {
    for (const Coord& origin : stack.sorted_origins(level)) leaves.emplace_back(level, origin);
  }
  return leaves;
}

}  // namespace argil
