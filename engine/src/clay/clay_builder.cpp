// SPDX-License-Identifier: GPL-3.0-or-later
// Makes a clay of stored levels.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "argil/engine/storage.h"

#include "clay/clay_access.h"
#include "clay/node_coord.h"
#include "clay/tree_sink.h"
#include "field/level_stack.h"
#include "field/mask.h"
#include "field/nesting.h"
#include "field/row_bits.h"

namespace argil {
namespace {

bool is_set(std::span<const std::uint64_t> mask, std::size_t bit) noexcept {
  return (mask[bit / 64] >> (bit % 64) & 1U) != 0;
}

/// How far leaves of a level may begin from the origin: where the finest may be, and what coarser
/// ones add to that by their band, by being whole and by standing around finer ones.
int most_node(int level) {
  constexpr int kBeyond = 8 * kLeafSide;
  return std::min(kMaxNode, (kMaxNode >> level) + kBeyond);
}

bool is_sound_leaf(const VdbLeaf& leaf, float band, int most) {
  const float* values = values_of(leaf);
  const Coord& at = leaf.origin();
  bool fits =
      std::min({at.x(), at.y(), at.z()}) >= -most && std::max({at.x(), at.y(), at.z()}) <= most;
  int beyond = 0;  // not bool, so that the compiler compares several at a time
  for (int n = 0; n < kLeafNodes; ++n) beyond |= std::abs(values[n]) <= band ? 0 : 1;
  for (openvdb::Index word = 0; word < VdbLeaf::NodeMaskType::WORD_COUNT; ++word) {
    fits = fits && bits_of_band(values + 64 * word, band) ==
                       leaf.getValueMask().getWord<openvdb::Index64>(word);
  }
  return fits && beyond == 0;
}

template <class Node>
std::unique_ptr<Node> node_of(const StoredBranch& branch, float background) {
  assert(is_aligned(branch.origin, Node::DIM) && branch.values.size() == Node::NUM_VALUES &&
         branch.children.size() == Node::NUM_VALUES / 64 &&
         branch.active.size() == branch.children.size());
  auto node = std::make_unique<Node>(coord_of(branch.origin), background, false);
  for (openvdb::Index n = 0; n < Node::NUM_VALUES; ++n) {
    if (!is_set(branch.children, n)) node->addTile(n, branch.values[n], is_set(branch.active, n));
  }
  return node;
}

}  // namespace

void TreeSink::add_tile(const NodeCoord& origin, float value, bool is_active) {
  assert(is_aligned(origin, storage::kUpperSide));
  tree_.root().addTile(coord_of(origin), value, is_active);
}

void TreeSink::add_branch(const StoredBranch& branch) {
  if (!branch.is_lower()) {
    tree_.root().addChild(node_of<VdbUpperNode>(branch, tree_.background()).release());
    return;
  }
  auto* upper = tree_.probeNode<VdbUpperNode>(coord_of(branch.origin));
  assert(upper != nullptr);
  upper->addChild(node_of<VdbLowerNode>(branch, tree_.background()).release());
}

std::vector<float*> TreeSink::add_leaves(std::span<const StoredLeaf> leaves) {
  leaves_.resize(leaves.size());
  VdbLowerNode* lower = nullptr;  // leaves of one follow one another
  for (std::size_t n = 0; n < leaves.size(); ++n) {
    const Coord origin = coord_of(leaves[n].origin);
    assert(is_aligned(leaves[n].origin, kLeafSide));
    const Coord around = origin & ~(storage::kLowerSide - 1);
    if (lower == nullptr || lower->origin() != around) {
      lower = tree_.probeNode<VdbLowerNode>(around);
    }
    assert(lower != nullptr);
    auto leaf = std::make_unique<VdbLeaf>(openvdb::PartialCreate(), origin, tree_.background());
    VdbLeaf::NodeMaskType active;
    for (openvdb::Index word = 0; word < VdbLeaf::NodeMaskType::WORD_COUNT; ++word) {
      active.getWord<openvdb::Index64>(word) = leaves[n].active[word];
    }
    leaf->setValueMask(active);
    leaves_[n] = leaf.get();
    lower->addChild(leaf.release());
  }
  std::vector<float*> values(leaves.size());
  constexpr std::size_t kGrain = 256;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, leaves_.size(), kGrain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t n = range.begin(); n < range.end(); ++n) {
                        leaves_[n]->allocate();
                        values[n] = leaves_[n]->buffer().data();
                      }
                    });
  return values;
}

std::vector<float*> LevelTreeSink::add_leaves(std::span<const StoredLeaf> added) {
  is_sound_.assign(added.size(), 0);
  hashes_.assign(added.size(), 0);
  return TreeSink::add_leaves(added);
}

void LevelTreeSink::leaf_is_filled(std::size_t n) {
  assert(n < leaves().size());
  const VdbLeaf& leaf = *leaves()[n];
  is_sound_[n] = is_sound_leaf(leaf, band_, most_node(level_)) ? 1 : 0;
  hashes_[n] = hash_of_leaf(leaf);
}

bool LevelTreeSink::is_sound() const {
  return std::all_of(is_sound_.begin(), is_sound_.end(), [](char sound) { return sound != 0; });
}

LeafHashes LevelTreeSink::sorted_hashes() const {
  std::vector<std::pair<Coord, std::uint64_t>> by_origin(leaves().size());
  for (std::size_t n = 0; n < by_origin.size(); ++n) {
    by_origin[n] = {leaves()[n]->origin(), hashes_[n]};
  }
  std::sort(by_origin.begin(), by_origin.end());
  LeafHashes sorted;
  sorted.reserve(by_origin.size());
  for (const auto& [origin, hash] : by_origin) sorted.push_back(hash);
  return sorted;
}

struct ClayBuilder::State {
  State(const ClayOptions& clay_options, int levels)
      : options(clay_options), stack(std::make_unique<LevelStack>(clay_options.voxel_mm, levels)) {
    for (int level = 0; level < levels; ++level) {
      sinks.push_back(std::make_unique<LevelTreeSink>(stack->grid(level).tree(), level));
    }
  }
  double mask_voxel_mm() const { return kMaskVoxels * stack->voxel_mm(0); }

  ClayOptions options;
  std::unique_ptr<LevelStack> stack;
  std::vector<std::unique_ptr<LevelTreeSink>> sinks;  ///< of the levels
  VdbGrid::Ptr mask;  ///< as it is written; null where there is none
  std::unique_ptr<TreeSink> mask_sink;
};

ClayBuilder::ClayBuilder(const ClayOptions& options, int levels) {
  assert(validate_options(options) && levels >= 1 && levels <= kMostLevels);
  state_ = std::make_unique<State>(options, levels);
}
ClayBuilder::~ClayBuilder() = default;

LevelSink& ClayBuilder::level(int level) {
  assert(level >= 0 && level < state_->stack->count());
  return *state_->sinks[static_cast<std::size_t>(level)];
}

LevelSink& ClayBuilder::mask(float elsewhere) {
  assert(state_->mask == nullptr);
  state_->mask = VdbGrid::create(elsewhere);
  state_->mask->setTransform(
      openvdb::math::Transform::createLinearTransform(state_->mask_voxel_mm()));
  state_->mask_sink = std::make_unique<TreeSink>(state_->mask->tree());
  return *state_->mask_sink;
}

double ClayBuilder::voxel_mm(int level) const noexcept { return state_->stack->voxel_mm(level); }
float ClayBuilder::band_mm(int level) const noexcept { return state_->stack->band_mm(level); }

bool ClayBuilder::is_sound(int level) const {
  assert(level >= 0 && level < state_->stack->count());
  return state_->sinks[static_cast<std::size_t>(level)]->is_sound();
}

bool ClayBuilder::is_mask_sound() const {
  return state_->mask == nullptr ||
         fault_of_mask(*state_->mask, state_->mask_voxel_mm()) == nullptr;
}

std::optional<NestingProblem> ClayBuilder::nesting_problem() const {
  const std::optional<NestingFault> fault = first_nesting_fault(*state_->stack);
  if (!fault) return std::nullopt;
  return NestingProblem{fault->kind == NestingFault::Kind::no_parent, fault->level,
                        node_coord(fault->origin)};
}

BuiltClay ClayBuilder::finish() && {
  assert(is_mask_sound() && !nesting_problem());
  if (state_->mask != nullptr) {
    state_->stack->exchange_mask(mask_of(*state_->mask, state_->mask_voxel_mm()));
  }
  std::vector<LeafHashes> leaves;
  for (const auto& sink : state_->sinks) leaves.push_back(sink->sorted_hashes());
  const std::uint64_t hash = hash_of_levels(*state_->stack, leaves);
  BuiltClay built{clay_of_levels(std::move(state_->stack), state_->options), hash};
  assert(built.clay.hash() == hash);
  return built;
}

}  // namespace argil
