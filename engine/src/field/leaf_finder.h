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
    constexpr int kSide = static_cast<int>(VdbLowerNode::DIM);
    const Coord key = node & ~(kSide - 1);
    if (!is_known_ || key != key_) {
      inner_ = tree_->probeConstNode<VdbLowerNode>(node);
      key_ = key;
      is_known_ = true;
    }
    if (inner_ == nullptr) return nullptr;
    const openvdb::Index n = VdbLowerNode::coordToOffset(node);
    return inner_->isChildMaskOn(n) ? inner_->getTable()[n].getChild() : nullptr;
  }
  /// The values of that leaf's nodes, or null.
  const float* values(const Coord& node) {
    const VdbLeaf* found = leaf(node);
    return found != nullptr ? found->buffer().data() : nullptr;
  }

  void forget() noexcept { is_known_ = false; }

 private:
  const VdbTree* tree_;
  const VdbLowerNode* inner_ = nullptr;
  Coord key_;
  bool is_known_ = false;
};

}  // namespace argil
