// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "argil/core/result.h"
#include "argil/engine/display_block.h"

#include "field/leaf_change.h"
#include "field/leaf_map.h"

namespace argil {

/// Which leaves of a stack a display surface is made without.
///
/// A leaf is shown when its voxels are large enough on the screen, or a shown leaf of the next
/// finer level requires it (for_each_required_parent), or hiding it would draw some part more than
/// DisplayView::coarser levels too coarse. So what is shown is nested and balanced as far as the
/// stack is, and the surface of it closes.
class DisplayChoice {
 public:
  DisplayChoice() = default;
  DisplayChoice(const DisplayChoice&) = delete;  // surfaces refer to it
  DisplayChoice& operator=(const DisplayChoice&) = delete;

  /// Shows all leaves of a stack.
  void show_all(const LevelStack& stack);

  /// Takes in that leaves came, which are hidden as yet where they may be, or went. Says whether
  /// any did: then it is time to choose.
  bool follow(const LevelStack& stack, std::span<const LeafChange> changes);

  /// Chooses by a view, or shows everything. Returns the leaves that are hidden now or no longer.
  std::vector<LeafKey> choose(const std::optional<DisplayView>& view);

  /// `node`: any of the leaf's. Thread-safe while nobody chooses.
  bool hides(int level, const Coord& node) const {
    return levels_[static_cast<std::size_t>(level)].leaves.get(node) == State::hidden;
  }
  bool shows(const LeafKey& at) const {
    return levels_[static_cast<std::size_t>(at.level)].leaves.get(at.origin) == State::shown;
  }
  std::int64_t hidden_count() const noexcept;
  /// -1 where nothing is hidden.
  int coarsest_hidden() const noexcept;
  std::int64_t bytes() const noexcept;

 private:
  enum class State : std::uint8_t { absent, shown, hidden };
  struct Level {
    double voxel_mm = 0.0;
    LeafMap<State> leaves;
    std::int64_t hidden = 0;
  };
  /// Of a leaf: the levels of leaves under it, and whether a shown one requires it.
  using Needs = LeafMap<std::uint8_t>;

  void set(const LeafKey& at, State to);
  void choose_level(int level, const DisplayView& view, Needs& needs, Needs& next,
                    std::vector<LeafKey>& flips) const;

  std::vector<Level> levels_;
};

/// Errors  bad_input names what is out of its range.
Result<void> validate_view(const DisplayView& view);

}  // namespace argil
