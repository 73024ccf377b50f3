// SPDX-License-Identifier: GPL-3.0-or-later
#include "level_stack.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

namespace argil {

LevelStack::LevelStack(double finest_voxel_mm, int levels) {
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

void LevelStack::set_leaf(int level, const Coord& place, const float* values) {
  VdbLeaf* leaf = grid(level).tree().touchLeaf(place);
  std::memcpy(leaf->buffer().data(), values, kLeafNodes * sizeof(float));
  const float band = band_mm(level);
  VdbLeaf::NodeMaskType active;
  for (openvdb::Index n = 0; n < kLeafNodes; ++n) active.set(n, std::abs(values[n]) < band);
  leaf->setValueMask(active);
}

void LevelStack::erase_leaf(int level, const Coord& place, float tile) {
  grid(level).tree().addTile(1, place, tile, false);
}

std::vector<Coord> LevelStack::sorted_places(int level) const {
  std::vector<Coord> places;
  places.reserve(grid(level).tree().leafCount());
  for (auto leaf = grid(level).tree().cbeginLeaf(); leaf; ++leaf) places.push_back(leaf->origin());
  std::sort(places.begin(), places.end());
  return places;
}

float LevelStack::sample(int level, const Coord& node) const {
  if (const VdbLeaf* found = leaf(level, node)) return found->buffer().data()[leaf_offset(node)];
  if (level == top()) return grid(level).tree().getValue(node);
  const Coord low = coarser(node);
  const Coord odd = node & 1;
  float sum = 0.0F;
  int count = 0;
  for (int i = 0; i <= odd.x(); ++i) {
    for (int j = 0; j <= odd.y(); ++j) {
      for (int k = 0; k <= odd.z(); ++k, ++count) sum += sample(level + 1, low.offsetBy(i, j, k));
    }
  }
  return sum / static_cast<float>(count);
}

float LevelStack::node_value(int level, const Coord& node) const {
  for (int finer = 0; finer < level; ++finer) {
    const Coord fine = node << (level - finer);
    if (const VdbLeaf* found = leaf(finer, fine)) {
      return found->buffer().data()[leaf_offset(fine)];
    }
  }
  return sample(level, node);
}

}  // namespace argil
