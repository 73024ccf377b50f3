// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "field/level_stack.h"

namespace argil {

/// Finds the leaves of one level for somebody who asks for leaves that lie together: the inner node
/// of the tree that holds the last one, 16^3 leaves wide, is kept, so that the next costs an array
/// step instead of a hash lookup. To be used by one thread; after leaves came or went, forget().
class LeafFinder {
 public:
  LeafFinder(const LevelStack& stack, int level) : tree_(&stack.grid(level).tree()) {}

  /// As LevelStack::leaf.
  const VdbLeaf* leaf(const Coord& node) {
    if (!find_inner(node)) return nullptr;
    const openvdb::Index n = VdbLowerNode::coordToOffset(node);
    return inner_->isChildMaskOn(n) ? inner_->getTable()[n].getChild() : nullptr;
  }
  bool has_leaf(const Coord& node) {
    return find_inner(node) && inner_->isChildMaskOn(VdbLowerNode::coordToOffset(node));
  }
  /// Which of the eight leaves of a cube of 16^3 nodes with this origin, a multiple of 16, are
  /// there: bit 4 i + 2 j + k of the one at offset 8 (i, j, k).
  unsigned leaves_of_eight(const Coord& origin) {
    if (!find_inner(origin)) return 0;
    constexpr openvdb::Index kSide = 16;  // leaves
    const openvdb::Index first = VdbLowerNode::coordToOffset(origin);
    unsigned found = 0;
    for (unsigned i = 0; i < 2; ++i) {
      for (unsigned j = 0; j < 2; ++j) {
        for (unsigned k = 0; k < 2; ++k) {
          const bool is_there = inner_->isChildMaskOn(first + (i * kSide + j) * kSide + k);
          found |= (is_there ? 1U : 0U) << (4 * i + 2 * j + k);
        }
      }
    }
    return found;
  }
  /// Of the 64 leaves of a cube of 32^3 nodes, its origin that of a leaf: bit 16 i + 4 j + k.
  std::uint64_t leaves_of_64(const Coord& origin) {
    constexpr int kSide = 4;
    constexpr int kInner = static_cast<int>(VdbLowerNode::DIM) / kLeafSide;
    const Coord first = (origin >> 3) & (kInner - 1);
    std::uint64_t found = 0;
    if (first.x() > kInner - kSide || first.y() > kInner - kSide || first.z() > kInner - kSide) {
      for (int n = 0; n < kSide * kSide * kSide; ++n) {
        const Coord at = origin + (Coord(n >> 4, n >> 2 & 3, n & 3) << 3);
        found |= std::uint64_t{has_leaf(at) ? 1U : 0U} << n;
      }
      return found;
    }
    if (!find_inner(origin)) return 0;
    static_assert(kInner == 16);  // a row along z is 16 bits of the mask
    for (int n = 0; n < kSide * kSide; ++n) {
      const auto row =
          static_cast<openvdb::Index>((first.x() + (n >> 2)) * kInner + first.y() + (n & 3));
      const auto bits = inner_->getChildMask().getWord<std::uint64_t>(row / 4) >>
                            (kInner * (row % 4) + static_cast<openvdb::Index>(first.z())) &
                        0xf;
      found |= static_cast<std::uint64_t>(bits) << (kSide * n);
    }
    return found;
  }
  /// The values of that leaf's nodes, or null.
  const float* values(const Coord& node) {
    const VdbLeaf* found = leaf(node);
    return found != nullptr ? values_of(*found) : nullptr;
  }

  void forget() noexcept { is_known_ = false; }

 private:
  bool find_inner(const Coord& node) {
    constexpr int kSide = static_cast<int>(VdbLowerNode::DIM);
    const Coord key = node & ~(kSide - 1);
    if (!is_known_ || key != key_) {
      inner_ = tree_->probeConstNode<VdbLowerNode>(node);
      key_ = key;
      is_known_ = true;
    }
    return inner_ != nullptr;
  }

  const VdbTree* tree_;
  const VdbLowerNode* inner_ = nullptr;
  Coord key_;
  bool is_known_ = false;
};

}  // namespace argil
