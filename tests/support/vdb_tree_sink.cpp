// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/vdb_tree_sink.h"

#include <cassert>
#include <cstdint>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace argil::io {
namespace {

bool is_set(std::span<const std::uint64_t> mask, std::size_t bit) noexcept {
  assert(bit / 64 < mask.size());
  return (mask[bit / 64] >> (bit % 64) & 1U) != 0;
}

std::unique_ptr<VdbLeaf> leaf_of(const StoredLeaf& stored, float background) {
  auto leaf = std::make_unique<VdbLeaf>(openvdb::PartialCreate(), coord_of(stored.origin),
                                        background, false);
  VdbLeaf::NodeMaskType active;
  for (openvdb::Index word = 0; word < VdbLeaf::NodeMaskType::WORD_COUNT; ++word) {
    active.getWord<openvdb::Index64>(word) = stored.active[word];
  }
  leaf->setValueMask(active);
  return leaf;
}

}  // namespace

template <class Node>
std::unique_ptr<Node> VdbTreeSink::node_of(const StoredBranch& branch) const {
  assert(branch.values.size() == Node::NUM_VALUES);
  auto node = std::make_unique<Node>(coord_of(branch.origin), tree_.background(), false);
  for (openvdb::Index n = 0; n < Node::NUM_VALUES; ++n) {
    if (!is_set(branch.children, n)) node->addTile(n, branch.values[n], is_set(branch.active, n));
  }
  return node;
}

void VdbTreeSink::add_tile(const NodeCoord& origin, float value, bool is_active) {
  tree_.root().addTile(coord_of(origin), value, is_active);
}

void VdbTreeSink::add_branch(const StoredBranch& branch) {
  if (!branch.is_lower()) {
    tree_.root().addChild(node_of<VdbUpperNode>(branch).release());
    return;
  }
  auto* upper = tree_.probeNode<VdbUpperNode>(coord_of(branch.origin));
  assert(upper != nullptr);
  upper->addChild(node_of<VdbLowerNode>(branch).release());
}

std::vector<float*> VdbTreeSink::add_leaves(std::span<const StoredLeaf> leaves) {
  std::vector<VdbLeaf*> made(leaves.size());
  VdbLowerNode* lower = nullptr;  // leaves of one follow one another
  for (std::size_t n = 0; n < leaves.size(); ++n) {
    const Coord around = coord_of(leaves[n].origin) & ~(storage::kLowerSide - 1);
    if (lower == nullptr || lower->origin() != around) {
      lower = tree_.probeNode<VdbLowerNode>(around);
    }
    assert(lower != nullptr);
    std::unique_ptr<VdbLeaf> leaf = leaf_of(leaves[n], tree_.background());
    made[n] = leaf.get();
    lower->addChild(leaf.release());
  }
  std::vector<float*> values(leaves.size());
  constexpr std::size_t kGrain = 256;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, made.size(), kGrain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t n = range.begin(); n < range.end(); ++n) {
                        // Linking needs one thread; allocating does not.
                        made[n]->allocate();
                        values[n] = made[n]->buffer().data();
                      }
                    });
  return values;
}

}  // namespace argil::io
