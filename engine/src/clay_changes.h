// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "argil/engine/clay.h"

#include "leaf_change.h"

namespace argil {

/// Which leaves of a clay changed, in order.
struct ChangeLog {
  std::uint64_t identity = 0;
  std::uint64_t revision = 0;                        ///< changes ever made
  const std::vector<LeafChange>* changes = nullptr;  ///< the latest of them
};

/// A number no two clays of this process share; a moved clay keeps its own.
std::uint64_t identity(const Clay& clay);

/// Grows with every leaf that changes.
std::uint64_t revision(const Clay& clay);

/// What changed after `since`, in order, a leaf perhaps more than once; or nothing when that is too
/// long ago to be known: then take all as changed.
std::optional<std::vector<LeafChange>> changes_since(const Clay& clay, std::uint64_t since);

}  // namespace argil
