// SPDX-License-Identifier: GPL-3.0-or-later
#include "level_copy.h"

#include <unordered_set>

#include "clay_changes.h"
#include "mask.h"

namespace argil::io {
namespace {

using UpperNode = VdbGrid::TreeType::RootNodeType::ChildNodeType;
using LowerNode = UpperNode::ChildNodeType;

/// The tiles of one upper node, and where the nodes below it are.
UpperNode* copy_tiles(const UpperNode& from, float background, std::vector<Coord>& lower) {
  auto* to = new UpperNode(from.origin(), background, false);
  for (auto tile = from.cbeginChildOff(); tile; ++tile) {
    to->addTile(tile.pos(), *tile, tile.isValueOn());
  }
  for (auto child = from.cbeginChildOn(); child; ++child) lower.push_back(child->origin());
  return to;
}

}  // namespace

LevelCopy::LevelCopy(const Clay& clay) { begin(clay); }

void LevelCopy::begin(const Clay& clay) {
  options_ = clay.options();  // an operation may have given it other voxels
  const LevelStack& from = clay.levels();
  levels_ = std::make_unique<LevelStack>(options_.voxel_mm, from.count());
  nodes_left_.clear();
  for (int level = 0; level < from.count(); ++level) {
    const auto& root = from.grid(level).tree().root();
    auto& copy = levels_->grid(level).tree().root();
    for (auto tile = root.cbeginValueAll(); tile; ++tile) {
      copy.addTile(tile.getCoord(), *tile, tile.isValueOn());
    }
    std::vector<Coord> lower;
    for (auto upper = root.cbeginChildOn(); upper; ++upper) {
      copy.addChild(copy_tiles(*upper, root.background(), lower));
    }
    for (const Coord& origin : lower) nodes_left_.emplace_back(level, origin);
  }
  revision_ = revision(clay);
}

std::size_t LevelCopy::copy_node(const LevelStack& from, int level, const Coord& origin) {
  const auto* node = from.grid(level).tree().probeConstNode<LowerNode>(origin);
  auto* upper = levels_->grid(level).tree().probeNode<UpperNode>(origin);
  // Either went as a whole since: then its leaves are among the changes.
  if (node == nullptr || upper == nullptr) return 0;
  upper->addChild(new LowerNode(*node));
  return node->leafCount();
}

bool LevelCopy::copy_changes(const Clay& clay) {
  const auto changes = changes_since(clay, revision_);
  if (!changes) return false;
  revision_ = revision(clay);
  std::unordered_set<LeafPlace, LeafPlaceHash> seen;
  for (const LeafChange& change : *changes) {
    if (!seen.insert(change.where()).second) continue;
    const auto& [level, place] = change.where();
    if (const VdbLeaf* leaf = clay.levels().leaf(level, place)) {
      levels_->set_leaf(level, place, leaf->buffer().data());
    } else {
      levels_->erase_leaf(level, place, clay.levels().grid(level).tree().getValue(place));
    }
  }
  return true;
}

bool LevelCopy::advance(const Clay& clay, std::size_t most_leaves) {
  if (!copy_changes(clay)) {
    // Too much changed for the clay to remember it all: from the start, and in one piece, so that
    // strokes of that size cannot keep the copy from ever being complete.
    begin(clay);
    most_leaves = static_cast<std::size_t>(-1);
  }
  std::size_t copied = 0;
  while (!nodes_left_.empty() && copied < most_leaves) {
    const auto [level, origin] = nodes_left_.back();
    nodes_left_.pop_back();
    copied += copy_node(clay.levels(), level, origin);
  }
  if (!nodes_left_.empty()) return false;
  const Mask* mask = clay.levels().mask();
  levels_->exchange_mask(mask != nullptr ? mask->copy() : nullptr);
  return true;
}

}  // namespace argil::io
