// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/engine/storage.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <cstring>
#include <memory>
#include <utility>

#include <openvdb/tree/LeafManager.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "clay/clay_access.h"
#include "field/level_stack.h"
#include "field/mask.h"
#include "field/nesting.h"

namespace argil {
namespace {

static_assert(storage::kLeafSide == kLeafSide && storage::kLeafNodes == kLeafNodes);
static_assert(storage::kLowerSide == VdbLowerNode::DIM && storage::kUpperSide == VdbUpperNode::DIM);
static_assert(storage::kLowerSlots == VdbLowerNode::NUM_VALUES &&
              storage::kUpperSlots == VdbUpperNode::NUM_VALUES);
static_assert(storage::kMostLevels == kMostLevels && storage::kMaskVoxels == kMaskVoxels);

Coord coord_of(const NodeCoord& node) noexcept { return {node[0], node[1], node[2]}; }
NodeCoord node_coord(const Coord& node) noexcept { return {node.x(), node.y(), node.z()}; }

[[maybe_unused]] bool is_aligned(const NodeCoord& origin, int side) noexcept {
  return std::all_of(origin.begin(), origin.end(), [&](int x) { return (x & (side - 1)) == 0; });
}

bool is_set(std::span<const std::uint64_t> mask, std::size_t bit) noexcept {
  return (mask[bit / 64] >> (bit % 64) & 1U) != 0;
}

template <class Mask>
void read_words(const Mask& mask, std::span<std::uint64_t> words) {
  for (std::size_t n = 0; n < words.size(); ++n) {
    words[n] = mask.template getWord<openvdb::Index64>(static_cast<openvdb::Index>(n));
  }
}

// ---- writing -----------------------------------------------------------------------------------

/// Writes a level into the tree that holds it.
class TreeSink final : public LevelSink {
 public:
  explicit TreeSink(VdbTree& tree) : tree_(tree) {}

  void add_tile(const NodeCoord& origin, float value, bool is_active) override {
    assert(is_aligned(origin, storage::kUpperSide));
    tree_.root().addTile(coord_of(origin), value, is_active);
  }

  void add_branch(const StoredBranch& branch) override {
    if (branch.is_lower()) {
      auto* upper = tree_.probeNode<VdbUpperNode>(coord_of(branch.origin));
      assert(upper != nullptr);
      upper->addChild(made<VdbLowerNode>(branch).release());
    } else {
      tree_.root().addChild(made<VdbUpperNode>(branch).release());
    }
  }

  std::vector<float*> add_leaves(std::span<const StoredLeaf> leaves) override;

 private:
  template <class Node>
  std::unique_ptr<Node> made(const StoredBranch& branch) const {
    assert(is_aligned(branch.origin, Node::DIM) && branch.values.size() == Node::NUM_VALUES &&
           branch.children.size() == Node::NUM_VALUES / 64 &&
           branch.active.size() == branch.children.size());
    auto node = std::make_unique<Node>(coord_of(branch.origin), tree_.background(), false);
    for (openvdb::Index n = 0; n < Node::NUM_VALUES; ++n) {
      if (!is_set(branch.children, n)) node->addTile(n, branch.values[n], is_set(branch.active, n));
    }
    return node;
  }

  VdbTree& tree_;
};

std::vector<float*> TreeSink::add_leaves(std::span<const StoredLeaf> leaves) {
  std::vector<VdbLeaf*> made(leaves.size());
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
    made[n] = leaf.get();
    lower->addChild(leaf.release());
  }
  std::vector<float*> values(leaves.size());
  constexpr std::size_t kGrain = 256;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, made.size(), kGrain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t n = range.begin(); n < range.end(); ++n) {
                        made[n]->allocate();
                        values[n] = made[n]->buffer().data();
                      }
                    });
  return values;
}

// ---- reading -----------------------------------------------------------------------------------

/// Masks and tiles of one branch, in memory that is used again for the next.
template <class Node>
class BranchReader {
 public:
  StoredBranch read(const Node& node) {
    read_words(node.getChildMask(), children_);
    read_words(node.getValueMask(), active_);
    for (auto tile = node.cbeginChildOff(); tile; ++tile) values_[tile.pos()] = *tile;
    return {node_coord(node.origin()), children_, active_, values_};
  }

 private:
  std::vector<std::uint64_t> children_ = std::vector<std::uint64_t>(Node::NUM_VALUES / 64);
  std::vector<std::uint64_t> active_ = std::vector<std::uint64_t>(Node::NUM_VALUES / 64);
  std::vector<float> values_ = std::vector<float>(Node::NUM_VALUES);
};

void copy_tree(const VdbTree& tree, LevelSink& to) {
  const VdbRoot& root = tree.root();
  for (auto tile = root.cbeginValueAll(); tile; ++tile) {
    to.add_tile(node_coord(tile.getCoord()), *tile, tile.isValueOn());
  }
  BranchReader<VdbUpperNode> uppers;
  BranchReader<VdbLowerNode> lowers;
  std::vector<const float*> from;
  std::vector<StoredLeaf> leaves;
  for (auto upper = root.cbeginChildOn(); upper; ++upper) {
    to.add_branch(uppers.read(*upper));
    for (auto lower = upper->cbeginChildOn(); lower; ++lower) {
      to.add_branch(lowers.read(*lower));
      for (auto leaf = lower->cbeginChildOn(); leaf; ++leaf) {
        from.push_back(leaf->buffer().data());
        StoredLeaf& stored = leaves.emplace_back();
        stored.origin = node_coord(leaf->origin());
        read_words(leaf->getValueMask(), stored.active);
      }
    }
  }
  const std::vector<float*> values = to.add_leaves(leaves);
  assert(values.size() == from.size());
  constexpr std::size_t kGrain = 64;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, from.size(), kGrain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t n = range.begin(); n < range.end(); ++n) {
                        std::memcpy(values[n], from[n], kLeafNodes * sizeof(float));
                      }
                    });
}

// ---- judging -----------------------------------------------------------------------------------

/// How far leaves of a level may begin from the origin: where the finest may be, and what coarser
/// ones add to that by their band, by being whole and by standing around finer ones.
int most_node(int level) {
  constexpr int kBeyond = 8 * kLeafSide;
  return std::min(kMaxNode, (kMaxNode >> level) + kBeyond);
}

bool is_sound_leaf(const VdbLeaf& leaf, float band, int most) {
  const float* values = leaf.buffer().data();
  const Coord& at = leaf.origin();
  bool fits =
      std::min({at.x(), at.y(), at.z()}) >= -most && std::max({at.x(), at.y(), at.z()}) <= most;
  for (openvdb::Index n = 0; n < kLeafNodes; ++n) {
    const float size = std::abs(values[n]);
    fits = fits && size <= band && (size < band) == leaf.isValueOn(n);
  }
  return fits;
}

}  // namespace

StoredClay::StoredClay(const Clay& clay) noexcept : stack_(&levels_of(clay)) {}

int StoredClay::level_count() const noexcept { return stack_->count(); }

double StoredClay::voxel_mm(int level) const noexcept {
  assert(level >= 0 && level < stack_->count());
  return stack_->voxel_mm(level);
}

float StoredClay::band_mm(int level) const noexcept {
  assert(level >= 0 && level < stack_->count());
  return stack_->band_mm(level);
}

void StoredClay::copy_level(int level, LevelSink& to) const {
  assert(level >= 0 && level < stack_->count());
  copy_tree(stack_->grid(level).tree(), to);
}

float StoredClay::sample(int level, const NodeCoord& node) const {
  assert(level >= 0 && level < stack_->count());
  return stack_->sample(level, coord_of(node));
}

std::vector<NodeCoord> StoredClay::leaf_origins(int level) const {
  assert(level >= 0 && level < stack_->count());
  const std::vector<Coord> sorted = stack_->sorted_origins(level);
  std::vector<NodeCoord> origins(sorted.size());
  std::transform(sorted.begin(), sorted.end(), origins.begin(), node_coord);
  return origins;
}

const float* StoredClay::leaf(int level, const NodeCoord& origin) const {
  assert(level >= 0 && level < stack_->count() && is_aligned(origin, kLeafSide));
  const VdbLeaf* found = stack_->leaf(level, coord_of(origin));
  return found != nullptr ? found->buffer().data() : nullptr;
}

bool StoredClay::has_mask() const noexcept { return stack_->mask() != nullptr; }

float StoredClay::mask_elsewhere() const {
  assert(has_mask());
  return stack_->mask()->elsewhere();
}

void StoredClay::copy_mask(LevelSink& to) const {
  assert(has_mask());
  copy_tree(stack_->mask()->grid().tree(), to);
}

struct ClayBuilder::State {
  State(const ClayOptions& clay_options, int levels)
      : options(clay_options), stack(std::make_unique<LevelStack>(clay_options.voxel_mm, levels)) {
    for (int level = 0; level < levels; ++level) {
      sinks.push_back(std::make_unique<TreeSink>(stack->grid(level).tree()));
    }
  }
  double mask_voxel_mm() const { return kMaskVoxels * stack->voxel_mm(0); }

  ClayOptions options;
  std::unique_ptr<LevelStack> stack;
  std::vector<std::unique_ptr<LevelSink>> sinks;  ///< of the levels
  VdbGrid::Ptr mask;                              ///< as it is written; null where there is none
  std::unique_ptr<LevelSink> mask_sink;
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
  const float band = state_->stack->band_mm(level);
  const int most = most_node(level);
  std::atomic<bool> is_so = true;
  openvdb::tree::LeafManager<const VdbTree> leaves(state_->stack->grid(level).tree());
  leaves.foreach ([&](const VdbLeaf& leaf, std::size_t) {
    if (!is_sound_leaf(leaf, band, most)) is_so = false;
  });
  return is_so;
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

Clay ClayBuilder::finish() && {
  assert(is_mask_sound() && !nesting_problem());
  if (state_->mask != nullptr) {
    state_->stack->exchange_mask(mask_of(*state_->mask, state_->mask_voxel_mm()));
  }
  return clay_of_levels(std::move(state_->stack), state_->options);
}

}  // namespace argil
