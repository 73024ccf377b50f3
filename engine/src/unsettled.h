// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "place_map.h"

namespace argil {

/// Leaves whose distance was moved with the surface and not yet measured anew, and how far that
/// was. A stroke keeps one.
class Unsettled {
 public:
  /// Beyond this the band has lost a voxel on one side.
  static constexpr float kMostVoxels = 1.0F;

  void add(int level, const Coord& place, float voxels);

  /// Takes out the leaves that moved too far, and those that the tool has left behind.
  std::vector<std::pair<int, Coord>> take(
      const std::function<bool(int level, const Coord& place)>& is_behind);

 private:
  std::vector<PlaceMap<float>> moved_;  // by level
};

}  // namespace argil
