// SPDX-License-Identifier: GPL-3.0-or-later
// What the engine sees of a Clay beyond its public contract.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "argil/engine/clay.h"

#include "field/leaf_change.h"
#include "field/level_stack.h"

namespace argil {

/// The only door to a Clay's levels; go through the functions below.
struct ClayAccess {
  static const LevelStack& levels(const Clay& clay) noexcept { return clay.levels(); }
  static Clay from_levels(std::unique_ptr<LevelStack> levels, const ClayOptions& options) {
    return Clay::from_levels(std::move(levels), options);
  }
  static std::uint64_t identity(const Clay& clay) noexcept;
  static std::uint64_t revision(const Clay& clay) noexcept;
  static std::optional<std::vector<LeafChange>> changes_since(const Clay& clay,
                                                              std::uint64_t since);
  /// What makes a mask of the levels' own one, in this many bytes; null for one of nothing.
  using MaskMaker =
      std::function<std::shared_ptr<Mask>(const LevelStack& stack, std::int64_t free_bytes)>;
  /// Puts another mask in the place of the clay's, as one undo step. Errors  bad_input while a
  /// stroke is open; memory where `make` throws bad_alloc, which leaves all as it was.
  static Result<void> change_mask(Clay& clay, const MaskMaker& make);
  /// Puts other levels in the place of the clay's, as one undo step; they hold the invariants of
  /// docs/field.md. No stroke is open (assert). Throws bad_alloc with nothing changed.
  static void replace_levels(Clay& clay, std::unique_ptr<LevelStack> levels,
                             const ClayOptions& options);
  /// What each can take back and repeat goes to the other. Both are the same bits, and neither has
  /// an open stroke.
  static void swap_histories(Clay& one, Clay& other) noexcept;
  static void forget_history(Clay& clay) noexcept;
};

/// Valid until the clay changes or moves.
inline const LevelStack& levels_of(const Clay& clay) noexcept { return ClayAccess::levels(clay); }

/// A clay of levels that hold the invariants of docs/field.md.
inline Clay clay_of_levels(std::unique_ptr<LevelStack> levels, const ClayOptions& options) {
  return ClayAccess::from_levels(std::move(levels), options);
}

/// A number no two clays of this process share; a moved clay keeps its own, and one whose levels
/// were all replaced gets another.
inline std::uint64_t identity(const Clay& clay) noexcept { return ClayAccess::identity(clay); }

/// Grows with every leaf that changes.
inline std::uint64_t revision(const Clay& clay) noexcept { return ClayAccess::revision(clay); }

/// What changed after `since`, in order, a leaf perhaps more than once; or nothing when that is too
/// long ago to be known: then take all as changed.
inline std::optional<std::vector<LeafChange>> changes_since(const Clay& clay, std::uint64_t since) {
  return ClayAccess::changes_since(clay, since);
}

}  // namespace argil
