// SPDX-License-Identifier: GPL-3.0-or-later
#include "unsettled.h"

namespace argil {

void Unsettled::add(int level, const Coord& place, float voxels) {
  if (voxels <= 0.0F) return;
  const auto n = static_cast<std::size_t>(level);
  if (moved_.size() <= n) moved_.resize(n + 1);
  moved_[n].at(place) += voxels;
}

std::vector<std::pair<int, Coord>> Unsettled::take(
    const std::function<bool(int level, const Coord& place)>& is_behind) {
  std::vector<std::pair<int, Coord>> taken;
  for (std::size_t n = 0; n < moved_.size(); ++n) {
    std::vector<Coord> due;
    moved_[n].for_each([&](const Coord& place, float voxels) {
      if (voxels > kMostVoxels || is_behind(static_cast<int>(n), place)) due.push_back(place);
    });
    for (const Coord& place : due) {
      moved_[n].at(place) = 0.0F;
      taken.emplace_back(static_cast<int>(n), place);
    }
  }
  return taken;
}

}  // namespace argil
