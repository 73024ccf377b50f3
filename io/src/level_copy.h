// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "argil/engine/clay.h"

#include "level_stack.h"

namespace argil::io {

/// A copy of a clay made in pieces between strokes, so that no stroke waits for all of it: what
/// changes after its piece was copied is copied again. The mask, small, is copied whole at the end.
/// Complete, it has the bits that the clay has then (LevelCopy.HasTheBitsOfTheClayThatWentOn).
///
/// Threads  the clay's. Cost  a piece: `most_leaves` leaves of 2 KB and those that changed since.
class LevelCopy {
 public:
  explicit LevelCopy(const Clay& clay);

  /// True when the copy is complete and has the clay's bits. One call on a small clay.
  bool advance(const Clay& clay, std::size_t most_leaves);

  /// The copy, once complete.
  Clay take() && { return Clay::from_levels(std::move(levels_), options_); }

 private:
  void begin(const Clay& clay);
  std::size_t copy_node(const LevelStack& from, int level, const Coord& origin);
  bool copy_changes(const Clay& clay);

  ClayOptions options_;
  std::unique_ptr<LevelStack> levels_;
  std::vector<std::pair<int, Coord>> nodes_left_;  // inner nodes of 16^3 leaves
  std::uint64_t revision_ = 0;
};

}  // namespace argil::io
