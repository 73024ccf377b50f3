// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/engine/clay_copy.h"

#include <cassert>
#include <cstdint>
#include <unordered_set>
#include <utility>
#include <vector>

#include "clay/clay_access.h"
#include "field/level_stack.h"
#include "field/mask.h"

namespace argil {
namespace {

/// The tiles of one upper node, and where the nodes below it are.
VdbUpperNode* copy_tiles(const VdbUpperNode& from, float background, std::vector<Coord>& lower) {
  auto* to = new VdbUpperNode(from.origin(), background, false);
  for (auto tile = from.cbeginChildOff(); tile; ++tile) {
    to->addTile(tile.pos(), *tile, tile.isValueOn());
  }
  for (auto child = from.cbeginChildOn(); child; ++child) lower.push_back(child->origin());
  return to;
}

}  // namespace

struct ClayCopy::State {
  void begin(const Clay& clay);
  std::size_t copy_node(const LevelStack& from, int level, const Coord& origin);
  bool copy_changes(const Clay& clay);

  ClayOptions options;
  std::unique_ptr<LevelStack> levels;
  std::vector<std::pair<int, Coord>> nodes_left;  // inner nodes of 16^3 leaves
  std::uint64_t revision = 0;
};

void ClayCopy::State::begin(const Clay& clay) {
  options = clay.options();  // an operation may have given it other voxels
  const LevelStack& from = levels_of(clay);
  levels = std::make_unique<LevelStack>(options.voxel_mm, from.count());
  nodes_left.clear();
  for (int level = 0; level < from.count(); ++level) {
    const auto& root = from.grid(level).tree().root();
    auto& copy = levels->grid(level).tree().root();
    for (auto tile = root.cbeginValueAll(); tile; ++tile) {
      copy.addTile(tile.getCoord(), *tile, tile.isValueOn());
    }
    std::vector<Coord> lower;
    for (auto upper = root.cbeginChildOn(); upper; ++upper) {
      copy.addChild(copy_tiles(*upper, root.background(), lower));
    }
    for (const Coord& origin : lower) nodes_left.emplace_back(level, origin);
  }
  revision = argil::revision(clay);
}

std::size_t ClayCopy::State::copy_node(const LevelStack& from, int level, const Coord& origin) {
  const auto* node = from.grid(level).tree().probeConstNode<VdbLowerNode>(origin);
  auto* upper = levels->grid(level).tree().probeNode<VdbUpperNode>(origin);
  // Either went as a whole since: then its leaves are among the changes.
  if (node == nullptr || upper == nullptr) return 0;
  upper->addChild(new VdbLowerNode(*node));
  return node->leafCount();
}

bool ClayCopy::State::copy_changes(const Clay& clay) {
  const auto changes = changes_since(clay, revision);
  if (!changes) return false;
  revision = argil::revision(clay);
  std::unordered_set<LeafKey, LeafKeyHash> seen;
  for (const LeafChange& change : *changes) {
    if (!seen.insert(change.where()).second) continue;
    const auto& [level, origin] = change.where();
    if (const VdbLeaf* leaf = levels_of(clay).leaf(level, origin)) {
      levels->set_leaf(level, origin, leaf->buffer().data());
    } else {
      levels->erase_leaf(level, origin, levels_of(clay).grid(level).tree().getValue(origin));
    }
  }
  return true;
}

ClayCopy::ClayCopy(const Clay& clay) : state_(std::make_unique<State>()) { state_->begin(clay); }
ClayCopy::~ClayCopy() = default;
ClayCopy::ClayCopy(ClayCopy&&) noexcept = default;
ClayCopy& ClayCopy::operator=(ClayCopy&&) noexcept = default;

bool ClayCopy::advance(const Clay& clay, std::size_t most_leaves) {
  if (!state_->copy_changes(clay)) {
    // Too much changed for the clay to remember it all: from the start, and in one piece, so that
    // strokes of that size cannot keep the copy from ever being complete.
    state_->begin(clay);
    most_leaves = kAllLeaves;
  }
  std::size_t copied = 0;
  auto& nodes_left = state_->nodes_left;
  while (!nodes_left.empty() && copied < most_leaves) {
    const auto [level, origin] = nodes_left.back();
    nodes_left.pop_back();
    copied += state_->copy_node(levels_of(clay), level, origin);
  }
  if (!nodes_left.empty()) return false;
  const Mask* mask = levels_of(clay).mask();
  state_->levels->exchange_mask(mask != nullptr ? mask->copy() : nullptr);
  return true;
}

Clay ClayCopy::take() && {
  assert(state_->nodes_left.empty());
  return clay_of_levels(std::move(state_->levels), state_->options);
}

Clay copy_of(const Clay& clay) {
  ClayCopy copy(clay);
  while (!copy.advance(clay, ClayCopy::kAllLeaves)) {
  }
  return std::move(copy).take();
}

}  // namespace argil
