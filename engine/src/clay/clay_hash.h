// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "field/level_stack.h"

namespace argil {

/// xxh64 of a leaf: origin, values and active mask.
std::uint64_t hash_of_leaf(const VdbLeaf& leaf);

/// The leaves of one level by hash, in lexicographic order of their origins.
using LeafHashes = std::vector<std::uint64_t>;

/// Clay::hash of these levels, and their mask if they have one. `leaves` has an entry for each
/// level: hashes are worked out in parallel, or while leaves are read, and put together in order.
std::uint64_t hash_of_levels(const LevelStack& stack, std::span<const LeafHashes> leaves);

/// The same where the hashes of leaves are not known yet.
std::uint64_t hash_of_levels(const LevelStack& stack);

}  // namespace argil
