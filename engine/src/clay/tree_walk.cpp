// SPDX-License-Identifier: GPL-3.0-or-later
#include "clay/tree_walk.h"

#include <algorithm>
#include <span>

#include "clay/node_coord.h"
#include "field/leaf.h"

namespace argil {
namespace {

template <class Mask>
void read_words(const Mask& mask, std::span<std::uint64_t> words) {
  for (std::size_t n = 0; n < words.size(); ++n) {
    words[n] = mask.template getWord<openvdb::Index64>(static_cast<openvdb::Index>(n));
  }
}

}  // namespace

void TreeWalk::show_tiles_of_root() {
  for (auto tile = tree_->root().cbeginValueAll(); tile; ++tile) {
    to_->see_tile(node_coord(tile.getCoord()), *tile, tile.isValueOn());
  }
}

void TreeWalk::show(const VdbUpperNode& upper) {
  to_->see_branch(branch_of(upper), {});
  for (auto lower = upper.cbeginChildOn(); lower; ++lower) {
    find_leaves(*lower);
    to_->see_branch(branch_of(*lower), leaves_);
  }
}

template <class Node>
StoredBranch TreeWalk::branch_of(const Node& node) {
  constexpr std::size_t kSlots = Node::NUM_VALUES;
  constexpr int kHalfTile = Node::ChildNodeType::DIM / 2;
  const std::span children(children_.data(), kSlots / 64);
  const std::span active(active_.data(), kSlots / 64);
  read_words(node.getChildMask(), children);
  read_words(node.getValueMask(), active);
  const std::span values = std::span(values_).first(kSlots);
  std::fill(values.begin(), values.end(), 0.0F);
  const float band = tree_->background();
  if (signs_ != nullptr) std::fill(active.begin(), active.end(), 0);
  for (auto tile = node.cbeginChildOff(); tile; ++tile) {
    values[tile.pos()] = signs_ == nullptr                                        ? *tile
                         : signs_->is_inside(tile.getCoord().offsetBy(kHalfTile)) ? -band
                                                                                  : band;
  }
  return {node_coord(node.origin()), children, active, values};
}

void TreeWalk::find_leaves(const VdbLowerNode& lower) {
  leaves_.clear();
  for (auto leaf = lower.cbeginChildOn(); leaf; ++leaf) {
    LeafView& view = leaves_.emplace_back();
    view.origin = node_coord(leaf->origin());
    view.values = values_of(*leaf);
    read_words(leaf->getValueMask(), view.active);
  }
}

void show_tree(const VdbTree& tree, LevelVisitor& to) {
  TreeWalk walk(tree, nullptr, to);
  walk.show_tiles_of_root();
  for (auto upper = tree.root().cbeginChildOn(); upper; ++upper) walk.show(*upper);
}

}  // namespace argil
