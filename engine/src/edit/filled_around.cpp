// SPDX-License-Identifier: GPL-3.0-or-later
// Which are wanted is found by one thread; of each is found first on which side of the surface it
// lies, since most lie wholly on one.
#include "edit/filled_around.h"

#include <cassert>
#include <limits>

#include "field/halo.h"
#include "field/parallel.h"
#include "field/prolongation.h"

namespace argil {
namespace {

enum class Side : std::uint8_t { inside, outside, both };

/// Of all nodes of a leaf that a level does not store.
Side side_of(const LevelStack& stack, int level, const Coord& origin) {
  if (level == stack.top()) {
    return stack.grid(level).tree().getValue(origin) < 0.0F ? Side::inside : Side::outside;
  }
  const float band = stack.band_mm(level);
  if (!may_coarse_be_below(stack, level + 1, origin, 1.0F, band)) return Side::outside;
  return may_coarse_be_below(stack, level + 1, origin, -1.0F, band) ? Side::both : Side::inside;
}

/// The nodes of 3^3 leaves.
openvdb::CoordBBox around(const Coord& middle) {
  return {middle.offsetBy(-kLeafSide), middle.offsetBy(2 * kLeafSide - 1)};
}

}  // namespace

FilledAround::FilledAround(const LevelEdit& edit, std::span<const Coord> origins, Reach reach) {
  const LevelStack& stack = edit.stack();
  const int level = edit.level();
  inside_.fill(-stack.band_mm(level));
  outside_.fill(stack.band_mm(level));
  constexpr std::uint32_t kElsewhere = std::numeric_limits<std::uint32_t>::max();
  std::vector<Coord> wanted;
  LevelEdit::Reader reader(edit);
  LeafMap<std::uint32_t> seen;
  for (const Coord& middle : origins) {
    const auto look = [&](const Coord& origin) {
      std::uint32_t& known = seen.at(origin);
      if (known != 0) return;
      known = kElsewhere;
      if (reader.filled_now(origin) != nullptr) return;
      wanted.push_back(origin);
      index_.at(origin) = static_cast<std::uint32_t>(wanted.size());
    };
    if (reach == Reach::beside) {
      for_each_halo_leaf(middle, [&](std::size_t, const Coord& origin) { look(origin); });
    } else {
      for_each_leaf_origin(around(middle), look);
    }
  }
  std::vector<Side> sides(wanted.size());
  for_each_leaf(wanted.size(), [&](std::size_t n) { sides[n] = side_of(stack, level, wanted[n]); });
  std::vector<std::size_t> filled;
  for (std::size_t n = 0; n < wanted.size(); ++n) {
    values_.push_back(sides[n] == Side::inside ? inside_.data() : outside_.data());
    if (sides[n] == Side::both) filled.push_back(n);
  }
  own_.resize(filled.size());
  for_each_leaf(filled.size(), [&](std::size_t n) {
    prolong_leaf(stack, level, wanted[filled[n]], own_[n]);
    values_[filled[n]] = own_[n].data();
  });
}

}  // namespace argil
