// SPDX-License-Identifier: GPL-3.0-or-later
#include "live/drawn_by_leaf.h"

#include <algorithm>
#include <cassert>

#include "surface/display_access.h"

namespace argil {

DrawnByLeaf::DrawnByLeaf(const DisplaySurface& shown, int level) : level_(level) {
  assert(level > 0);
  for (const BlockId& id : DisplayAccess::drawn(shown)) {
    const LeafKey around = leaf_around(id);
    const auto at = static_cast<std::size_t>(around.level);
    if (numbers_.size() <= at) numbers_.resize(at + 1);
    std::size_t& number = numbers_[at].at(around.origin);
    if (number == 0) {
      groups_.push_back({around, {}});
      number = groups_.size();
    }
    groups_[number - 1].blocks.push_back(id);
  }
}

LeafKey DrawnByLeaf::leaf_around(const BlockId& id) const {
  const LeafKey block = leaf_of(id);
  const int steps = std::max(0, level_ - block.level);
  return {block.level + steps - level_, leaf_origin(block.origin >> steps)};
}

std::size_t DrawnByLeaf::group_of(const LeafKey& at) const {
  const auto level = static_cast<std::size_t>(at.level);
  const std::size_t number = level < numbers_.size() ? numbers_[level].get(at.origin) : 0;
  return number == 0 ? groups_.size() : number - 1;
}

}  // namespace argil
