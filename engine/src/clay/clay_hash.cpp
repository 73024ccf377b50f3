// SPDX-License-Identifier: GPL-3.0-or-later
#include "clay/clay_hash.h"

#include <array>
#include <cassert>

#include <tbb/parallel_for.h>

#include "argil/core/hash.h"

#include "field/mask.h"

namespace argil {
namespace {

template <class T>
std::span<const std::byte> bytes_of(const T* data, std::size_t count) {
  return std::as_bytes(std::span(data, count));
}

}  // namespace

std::uint64_t hash_of_leaf(const VdbLeaf& leaf) {
  Hash64 hash;
  const std::array<std::int32_t, 3> origin{leaf.origin().x(), leaf.origin().y(), leaf.origin().z()};
  hash.update(bytes_of(origin.data(), origin.size()));
  hash.update(bytes_of(values_of(leaf), kLeafNodes));
  std::array<openvdb::Index64, VdbLeaf::NodeMaskType::WORD_COUNT> active;
  for (openvdb::Index word = 0; word < active.size(); ++word) {
    active[word] = leaf.getValueMask().getWord<openvdb::Index64>(word);
  }
  hash.update(bytes_of(active.data(), active.size()));
  return hash.digest();
}

std::uint64_t hash_of_levels(const LevelStack& stack, std::span<const LeafHashes> leaves) {
  assert(leaves.size() == static_cast<std::size_t>(stack.count()));
  Hash64 hash;
  for (int level = 0; level < stack.count(); ++level) {
    const double voxel = stack.voxel_mm(level);
    hash.update(bytes_of(&voxel, 1));
    const LeafHashes& of_level = leaves[static_cast<std::size_t>(level)];
    hash.update(bytes_of(of_level.data(), of_level.size()));
  }
  if (const Mask* mask = stack.mask()) {
    const std::uint64_t mask_hash = mask->hash();
    hash.update(bytes_of(&mask_hash, 1));
  }
  return hash.digest();
}

std::uint64_t hash_of_levels(const LevelStack& stack) {
  std::vector<LeafHashes> leaves;
  for (int level = 0; level < stack.count(); ++level) {
    const std::vector<Coord> origins = stack.sorted_origins(level);
    LeafHashes& of_level = leaves.emplace_back(origins.size());
    tbb::parallel_for(std::size_t{0}, origins.size(), [&](std::size_t n) {
      of_level[n] = hash_of_leaf(*stack.leaf(level, origins[n]));
    });
  }
  return hash_of_levels(stack, leaves);
}

}  // namespace argil
