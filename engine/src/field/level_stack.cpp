// SPDX-License-Identifier: GPL-3.0-or-later
// Level L is an OpenVDB grid of voxel size h_L. Values are written leaf by leaf with their active
// mask, which costs far less than setting nodes one by one. Reading goes through sampling.h.
#include "field/level_stack.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>

#include "field/mask.h"
#include "field/row_bits.h"
#include "field/sampling.h"

namespace argil {
namespace {

/// The leaves of the level `from` and coarser ones.
struct LeavesFrom {
  const LevelStack& stack;
  int from;

  int top() const noexcept { return stack.top(); }
  const float* values(int level, const Coord& node) const {
    const VdbLeaf* leaf = level >= from ? stack.leaf(level, node) : nullptr;
    return leaf != nullptr ? values_of(*leaf) : nullptr;
  }
  float constant(const Coord& node) const { return stack.grid(top()).tree().getValue(node); }
};

}  // namespace

LevelStack::LevelStack(double finest_voxel_mm, int levels) {
  assert(finest_voxel_mm > 0.0 && levels >= 1 && levels <= kMostLevels);
  openvdb::initialize();
  double voxel = finest_voxel_mm;
  for (int level = 0; level < levels; ++level, voxel *= 2.0) {
    auto grid = VdbGrid::create(static_cast<float>(kHalfWidthVoxels * voxel));
    grid->setTransform(openvdb::math::Transform::createLinearTransform(voxel));
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    grid->setName("surface_" + std::to_string(level));
    grids_.push_back(std::move(grid));
    voxel_mm_.push_back(voxel);
  }
}

std::unique_ptr<LevelStack> LevelStack::copy_from(int finest) const {
  assert(is_level(finest));
  auto copy = std::make_unique<LevelStack>(voxel_mm(finest), count() - finest);
  for (int level = finest; level < count(); ++level) {
    copy->grid(level - finest).setTree(grid(level).tree().copy());
  }
  return copy;
}

void LevelStack::set_leaf(int level, const Coord& origin, const float* values) {
  assert(is_leaf_origin(origin));
  write(*grid(level).tree().touchLeaf(origin), level, values);
}

void LevelStack::rewrite_leaf(int level, const Coord& origin, const float* values) {
  assert(is_leaf_origin(origin) && has_leaf(level, origin));
  write(*grid(level).tree().probeLeaf(origin), level, values);
}

void LevelStack::swap_leaf(int level, const Coord& origin, LeafValues& values) {
  assert(is_leaf_origin(origin) && has_leaf(level, origin));
  VdbLeaf& leaf = *grid(level).tree().probeLeaf(origin);
  std::swap_ranges(values.begin(), values.end(), leaf.buffer().data());
  set_active(leaf, level);
}

void LevelStack::write(VdbLeaf& leaf, int level, const float* values) {
  std::memcpy(leaf.buffer().data(), values, kLeafNodes * sizeof(float));
  set_active(leaf, level);
}

void LevelStack::set_active(VdbLeaf& leaf, int level) {
  const float* values = leaf.buffer().data();
  const float band = band_mm(level);
  VdbLeaf::NodeMaskType active;
  for (openvdb::Index word = 0; word < VdbLeaf::NodeMaskType::WORD_COUNT; ++word) {
    active.getWord<std::uint64_t>(word) = bits_of_band(values + 64 * word, band);
  }
  leaf.setValueMask(active);
}

void LevelStack::erase_leaf(int level, const Coord& origin, float tile) {
  assert(is_leaf_origin(origin));
  grid(level).tree().addTile(1, origin, tile, false);
}

std::vector<Coord> LevelStack::sorted_origins(int level) const {
  std::vector<Coord> origins;
  origins.reserve(grid(level).tree().leafCount());
  for (auto leaf = grid(level).tree().cbeginLeaf(); leaf; ++leaf) origins.push_back(leaf->origin());
  std::sort(origins.begin(), origins.end());
  return origins;
}

float LevelStack::sample(int level, const Coord& node) const {
  return sample_of(LeavesFrom{*this, level}, level, node);
}

float LevelStack::sample_above(int level, const Coord& node) const {
  assert(level < top());
  return sample_of(LeavesFrom{*this, level + 1}, level, node);
}

float LevelStack::node_value(int level, const Coord& node) const {
  return node_value_of(LeavesFrom{*this, 0}, level, node);
}

Mask& LevelStack::mask_to_change() {
  if (!mask_) mask_ = std::make_shared<Mask>(kMaskVoxels * voxel_mm(0), 0.0F);
  return *mask_;
}

std::shared_ptr<Mask> LevelStack::exchange_mask(std::shared_ptr<Mask> by) noexcept {
  return std::exchange(mask_, std::move(by));
}

void LevelStack::drop_mask_of_nothing() noexcept {
  if (mask_ && mask_->is_nothing()) mask_.reset();
}

}  // namespace argil
