// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "surface/display_choice.h"

namespace argil::test {

/// The levels as they would be had the hidden leaves never been there.
inline LevelStack without_hidden(const LevelStack& stack, const DisplayChoice& choice) {
  LevelStack rest(stack.voxel_mm(0), stack.count());
  for (int level = 0; level < stack.count(); ++level) {
    rest.grid(level).setTree(stack.grid(level).tree().copy());
    for (const Coord& place : stack.sorted_origins(level)) {
      if (choice.hides(level, place)) rest.erase_leaf(level, place, stack.band_mm(level));
    }
  }
  return rest;
}

}  // namespace argil::test
