// SPDX-License-Identifier: GPL-3.0-or-later
// How a dense block is read from the levels for a window. Three steps: gather() copies what the
// level stores and interpolates what only coarser levels do; a march over a block of a level coarse
// enough to reach the wanted depth cheaply gives the far distances; fix_border() hands those in at
// the border of the fine block, which then is marched as well. So surfaces outside the block count.
#include "field/level_block.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "field/resample.h"

namespace argil {
namespace {

/// The outermost layer of a band is left out: there the clamp may have cut a value short.
constexpr float kFixedBand = static_cast<float>(kHalfWidthVoxels - 1);
/// How many voxels deep a march may go before it starts from a coarser level: the far part costs
/// least there, and its error only enters where the closest point lies outside the window.
constexpr double kDeepestMarch = 16.0;
/// Layers at a block's border that a second-order difference can reach.
constexpr int kBorder = 2;

Vec3 as_vec3(const Coord& c) noexcept {
  return {static_cast<double>(c.x()), static_cast<double>(c.y()), static_cast<double>(c.z())};
}

/// Whether a level coarser than this has a leaf around this one: if none has, it is constant.
bool is_covered(const LevelStack& stack, int level, const Coord& origin) {
  for (int at = level + 1; at < stack.count(); ++at) {
    if (stack.has_leaf(at, origin >> (at - level))) return true;
  }
  return false;
}

void set_node(LevelBlock& block, const Coord& node, float value, float fixed_within) {
  const std::size_t at = block.index(node);
  block.nodes.value[at] = value;
  block.nodes.state[at] =
      std::abs(value) < fixed_within ? MarchBlock::kFixed : MarchBlock::kUnknown;
}

/// Nodes that `level` does not store, from the finest coarser level that has a leaf around them.
/// Four taps, not two as the surface has: two lie inside every curve, by up to the clay's
/// tolerance.
std::vector<float> interpolated(const LevelStack& stack, int level, const NodeBox& part) {
  int above = level + 1;
  while (above < stack.top() && !stack.has_leaf(above, part.low >> (above - level))) ++above;
  const double ratio = std::ldexp(1.0, level - above);
  LevelBlock coarse = empty_block(resample_support(part, ratio), voxel_of(stack, above));
  for_each_node(coarse.box, [&](const Coord& node) {
    coarse.nodes.value[coarse.index(node)] = stack.sample(above, node);
  });
  const auto n = part.sides();
  std::vector<float> values(static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1]) *
                            static_cast<std::size_t>(n[2]));
  resample(coarse, ratio, part, values);
  return values;
}

/// One leaf, or the part of it within the block: read from the level, or interpolated from the
/// coarser level that covers it, or the constant far from the surface.
void gather_leaf(const LevelStack& stack, int level, const Coord& origin, float fixed_within,
                 LevelBlock& block) {
  const NodeBox part = part_of(block.box, origin);
  if (const VdbLeaf* leaf = stack.leaf(level, origin)) {
    const float* values = values_of(*leaf);
    for_each_node(part, [&](const Coord& node) {
      set_node(block, node, values[leaf_offset(node)], fixed_within);
    });
    return;
  }
  if (!is_covered(stack, level, origin)) {
    const float far = stack.grid(stack.top()).tree().getValue(origin >> (stack.top() - level));
    for_each_node(part, [&](const Coord& node) { set_node(block, node, far, 0.0F); });
    return;
  }
  const std::vector<float> values = interpolated(stack, level, part);
  std::size_t n = 0;
  for_each_node(part, [&](const Coord& node) { set_node(block, node, values[n++], fixed_within); });
}

/// A made-up level: the top's nodes with all others left out.
void gather_thinned(const LevelStack& stack, int level, LevelBlock& block) {
  const int shift = level - stack.top();
  const float within = kFixedBand * static_cast<float>(stack.voxel_mm(stack.top()));
  for_each_node(block.box, [&](const Coord& node) {
    set_node(block, node, stack.sample(stack.top(), node << shift), within);
  });
}

/// The coarsest level worth marching on for this depth.
int far_level(const LevelStack& stack, int level, double depth_mm) noexcept {
  int far = level;
  while (far < stack.top() + kMadeUpLevels && depth_mm > kDeepestMarch * voxel_of(stack, far)) {
    ++far;
  }
  return far;
}

/// A block marched from its band outward to the depth.
LevelBlock march_whole(const LevelStack& stack, int level, const NodeBox& box, double depth_mm) {
  const double voxel = voxel_of(stack, level);
  LevelBlock block = gather(stack, level, box);
  fast_march(block.nodes, static_cast<float>(depth_mm + 2.0 * voxel));
  return block;
}

/// Within the outermost layers, where nothing beyond was seen by the march.
bool is_in_border(const Coord& node, const NodeBox& box) noexcept {
  const NodeBox inner = box.grown(-kBorder);
  return !inner.contains(as_vec3(node));
}

/// Fixes the unknown nodes at the border whose closest point lies outside the block, that is, where
/// distance flows in. Where it flows out nothing is fixed: the march knows better there.
void fix_border(const LevelBlock& far, double ratio, float far_limit, LevelBlock& block) {
  const double voxel = static_cast<double>(block.nodes.voxel);
  for_each_node(block.box, [&](const Coord& node) {
    const std::size_t at = block.index(node);
    if (block.nodes.state[at] != MarchBlock::kUnknown || !is_in_border(node, block.box)) return;
    const Vec3 far_node = as_vec3(node) / ratio;
    const float value = far.value_at(far_node);
    const bool inside = block.nodes.value[at] < 0.0F;
    if (std::abs(value) >= far_limit || (value < 0.0F) != inside) return;
    const Vec3 displacement =
        normalized(far.gradient_at(far_node)) * (static_cast<double>(value) / voxel);
    if (block.box.contains(as_vec3(node) - displacement)) return;
    block.nodes.value[at] = value;
    block.nodes.state[at] = MarchBlock::kFixed;
  });
}

/// The box of a coarser level that covers `box`, with room for `depth_mm` and two voxels around.
NodeBox far_box(const NodeBox& box, int shift, double depth_mm, double far_voxel) {
  const int margin = static_cast<int>(std::ceil(depth_mm / far_voxel)) + 2;
  return NodeBox{box.low >> shift, (box.high >> shift).offsetBy(1)}.grown(margin);
}

}  // namespace

double voxel_of(const LevelStack& stack, int level) noexcept {
  assert(level >= 0 && level <= stack.top() + kMadeUpLevels);
  const int beyond = std::max(level - stack.top(), 0);
  return std::ldexp(stack.voxel_mm(level - beyond), beyond);
}

/// Mirrors what extended_block() allocates, so that a window can be refused before.
double largest_side(const LevelStack& stack, int level, double reach_mm, double depth_mm) noexcept {
  const double near = 2.0 * reach_mm / voxel_of(stack, level) + 2.0 + 2.0 * kBorder;
  const double far_voxel = voxel_of(stack, far_level(stack, level, depth_mm));
  const double far = 2.0 * (reach_mm + depth_mm) / far_voxel + 10.0;
  return std::ceil(std::max(near, far));
}

LevelBlock gather(const LevelStack& stack, int level, const NodeBox& box) {
  LevelBlock block = empty_block(box, voxel_of(stack, level));
  if (level > stack.top()) {
    gather_thinned(stack, level, block);
    return block;
  }
  const NodeBox origins{leaf_origin(box.low) >> 3, leaf_origin(box.high) >> 3};
  for_each_node(origins, [&](const Coord& origin) {
    gather_leaf(stack, level, origin << 3, kFixedBand * block.nodes.voxel, block);
  });
  return block;
}

LevelBlock extended_block(const LevelStack& stack, int level, const NodeBox& box, double depth_mm) {
  assert(depth_mm >= 0.0);
  const int far_at = far_level(stack, level, depth_mm);
  const int shift = far_at - level;
  const double far_voxel = voxel_of(stack, far_at);
  const LevelBlock far =
      march_whole(stack, far_at, far_box(box, shift, depth_mm, far_voxel), depth_mm);
  const double voxel = voxel_of(stack, level);
  const auto limit = static_cast<float>(depth_mm + 2.0 * voxel);
  LevelBlock block = gather(stack, level, box.grown(kBorder));
  if (shift == 0) {
    for_each_node(block.box, [&](const Coord& node) {
      const float value = far.nodes.value[far.index(node)];
      block.nodes.value[block.index(node)] = std::clamp(value, -limit, limit);
    });
    return block;
  }
  fix_border(far, std::ldexp(1.0, shift), static_cast<float>(depth_mm + 2.0 * far_voxel), block);
  fast_march(block.nodes, limit);
  return block;
}

}  // namespace argil
