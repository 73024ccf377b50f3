// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "level_stack.h"

namespace argil {

/// One leaf that was added, removed or whose values or signs changed, as edits report it to whoever
/// keeps something derived from the levels (the surface, windows).
struct LeafChange {
  int level = 0;
  Coord place;  ///< the leaf's origin, present now or not

  friend bool operator==(const LeafChange& a, const LeafChange& b) noexcept {
    return a.level == b.level && a.place == b.place;
  }
  friend bool operator<(const LeafChange& a, const LeafChange& b) noexcept {
    return a.level != b.level ? a.level < b.level : a.place < b.place;
  }
};

}  // namespace argil
