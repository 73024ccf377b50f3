// SPDX-License-Identifier: GPL-3.0-or-later
#include "edit.h"

#include <algorithm>

#include "retention.h"

namespace argil {

Edit::Edit(EditTarget& target)
    : target_(target),
      stack_(target.stack),
      wanted_(static_cast<std::size_t>(target.stack.count())) {}

void Edit::want(int level, const Coord& place) {
  wanted_[static_cast<std::size_t>(level)].at(place) = 1;
}

void Edit::load() {
  std::vector<std::vector<Coord>> places(wanted_.size());
  std::size_t count = 0;
  for (std::size_t n = 0; n < wanted_.size(); ++n) {
    const int level = static_cast<int>(n);
    wanted_[n].for_each([&](const Coord& place, std::uint8_t) {
      places[n].push_back(place);
      if (level == stack_.top()) return;
      for_each_required_place(place, [&](const Coord& coarse) { want(level + 1, coarse); });
    });
    count += places[n].size();
  }
  const auto bytes = static_cast<std::int64_t>(count * sizeof(LeafEdit));
  if (bytes > target_.free_bytes) throw OverLimit(bytes);
  levels_.resize(places.size());
  const LevelEdit* coarser = nullptr;
  for (int level = stack_.top(); level >= 0; --level) {
    const auto n = static_cast<std::size_t>(level);
    levels_[n] = std::make_unique<LevelEdit>(stack_, target_.memory, level, places[n], coarser);
    coarser = levels_[n].get();
  }
}

bool Edit::has_child(int level, const LeafEdit& leaf) {
  if (level == 0) return false;
  const LevelEdit& finer = this->level(level - 1);
  bool child = false;
  for (int octant = 0; octant < 8 && !child; ++octant) {
    child = finer.present_now(
        (leaf.place << 1).offsetBy(octant & 4 ? 8 : 0, octant & 2 ? 8 : 0, octant & 1 ? 8 : 0));
  }
  return child;
}

bool Edit::is_filled(int level, const LeafEdit& leaf) {
  if (!has_band(leaf.now.data(), stack_.band_mm(level))) return has_child(level, leaf);
  if (level == stack_.top() || leaf.existed || leaf.changed) return true;
  if (level == 0) return false;
  const LevelEdit& finer = this->level(level - 1);
  return required_by_finer(leaf.place,
                           [&](const Coord& place) { return finer.present_now(place); });
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
  drop_empty_of(level - 1);
  restrict_edit(this->level(level - 1), this->level(level), which);
}

bool Edit::stays(int level, const LeafEdit& leaf) {
  if (!has_band(leaf.now.data(), stack_.band_mm(level))) return has_child(level, leaf);
  if (level == stack_.top()) return true;
  LevelEdit* finer = level > 0 ? &this->level(level - 1) : nullptr;
  const auto finer_present = [&](const Coord& place) { return finer->present_now(place); };
  if (finer != nullptr && required_by_finer(leaf.place, finer_present)) return true;
  return coarser_misses(leaf.now, coarse_nodes(this->level(level + 1), leaf.place),
                        retention_rule(stack_, level, target_.tolerance_mm));
}

void Edit::drop_unneeded() {
  for (int n = 0; n < stack_.count(); ++n) {
    auto& leaves = level(n).leaves();
    for_each_leaf(leaves.size(), [&](std::size_t i) { leaves[i].present = stays(n, leaves[i]); });
  }
}

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
      LeafChange change{n, leaf.place};
      if (fate == Fate::rewritten) {
        change = change_of_values(n, leaf.place, leaf.before.data(), leaf.now.data());
      }
      const float tile = leaf.existed ? 0.0F : stack_.grid(n).tree().getValue(leaf.place);
      target_.sink(change, leaf.existed ? leaf.before.data() : nullptr, tile);
    }
    for_each_leaf(leaves.size(), [&](std::size_t i) {
      const LeafEdit& leaf = leaves[i];
      if (fate_of(n, leaf) != Fate::rewritten) return;
      stack_.rewrite_leaf(n, leaf.place, leaf.now.data());
    });
    const float band = stack_.band_mm(n);
    for (const LeafEdit& leaf : leaves) {
      const Fate fate = fate_of(n, leaf);
      came_or_went = came_or_went || fate == Fate::made || fate == Fate::erased;
      if (fate == Fate::made) stack_.set_leaf(n, leaf.place, leaf.now.data());
      if (fate == Fate::erased) {
        stack_.erase_leaf(n, leaf.place, leaf.now[0] < 0.0F ? -band : band);
      }
    }
  }
  return came_or_went;
}

LeafList all_leaves(const LevelStack& stack) {
  LeafList leaves;
  for (int level = 0; level < stack.count(); ++level) {
    for (const Coord& place : stack.sorted_places(level)) leaves.emplace_back(level, place);
  }
  return leaves;
}

bool tidy(EditTarget& target, const LeafList& touched) {
  const LevelStack& stack = target.stack;
  Edit edit(target);
  bool any = false;
  for (const auto& entry : touched) {
    if (stack.has_leaf(entry.first, entry.second)) {
      edit.want(entry.first, entry.second);
      any = true;
    }
    const int finer = entry.first - 1;
    if (finer < 0) continue;
    const Coord first = (entry.second << 1).offsetBy(-kLeafSide);
    const openvdb::CoordBBox around(first, first.offsetBy(4 * kLeafSide - 1));
    for_each_place(around, [&](const Coord& place) {
      if (!stack.has_leaf(finer, place)) return;
      edit.want(finer, place);
      any = true;
    });
  }
  if (!any) return false;
  edit.load();
  edit.drop_unneeded();
  return edit.commit();
}

}  // namespace argil
