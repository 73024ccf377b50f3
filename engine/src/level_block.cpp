// SPDX-License-Identifier: GPL-3.0-or-later
#include "level_block.h"

#include <algorithm>
#include <cmath>

#include "resample.h"

namespace argil {
namespace {

/// The outermost layer of a band is left out: there the clamp may have cut a value short.
constexpr float kFixedBand = static_cast<float>(kHalfWidthVoxels - 1);
/// How many voxels deep a march may go before it starts from a coarser level: the far part costs
/// least there, and its error only enters where the closest place lies outside the window.
constexpr double kDeepestMarch = 16.0;
/// Layers at a block's border that a second-order difference can reach.
constexpr int kBorder = 2;

Vec3 as_vec3(const Coord& c) noexcept {
  return {static_cast<double>(c.x()), static_cast<double>(c.y()), static_cast<double>(c.z())};
}

/// Whether a level coarser than this has a leaf around the place: if none has, the place is
/// constant.
bool is_covered(const LevelStack& stack, int level, const Coord& place) {
  for (int at = level + 1; at < stack.count(); ++at) {
    if (stack.has_leaf(at, place >> (at - level))) return true;
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

/// One leaf's place, or the part of it within the block: read from the leaf, or interpolated from
/// the level that covers the place, or the constant far from the surface.
void gather_place(const LevelStack& stack, int level, const Coord& place, float fixed_within,
                  LevelBlock& block) {
  const NodeBox part = part_of(block.box, place);
  if (const VdbLeaf* leaf = stack.leaf(level, place)) {
    const float* values = leaf->buffer().data();
    for_each_node(part, [&](const Coord& node) {
      set_node(block, node, values[leaf_offset(node)], fixed_within);
    });
    return;
  }
  if (!is_covered(stack, level, place)) {
    const float far = stack.grid(stack.top()).tree().getValue(place >> (stack.top() - level));
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

LevelBlock march_whole(const LevelStack& stack, int level, const NodeBox& box, double depth_mm) {
  const double voxel = voxel_of(stack, level);
  LevelBlock block = gather(stack, level, box);
  fast_march(block.nodes, static_cast<float>(depth_mm + 2.0 * voxel));
  return block;
}

bool is_in_border(const Coord& node, const NodeBox& box) noexcept {
  const NodeBox inner = box.grown(-kBorder);
  return !inner.contains(as_vec3(node));
}

/// Fixes the unknown nodes at the border whose closest place lies outside the block, that is, where
/// distance flows in. Where it flows out nothing is fixed: the march knows better there.
void fix_border(const LevelBlock& far, double ratio, float far_limit, LevelBlock& block) {
  const double voxel = static_cast<double>(block.nodes.voxel);
  for_each_node(block.box, [&](const Coord& node) {
    const std::size_t at = block.index(node);
    if (block.nodes.state[at] != MarchBlock::kUnknown || !is_in_border(node, block.box)) return;
    const Vec3 place = as_vec3(node) / ratio;
    const float value = far.value_at(place);
    const bool inside = block.nodes.value[at] < 0.0F;
    if (std::abs(value) >= far_limit || (value < 0.0F) != inside) return;
    const Vec3 way = normalized(far.gradient_at(place)) * (static_cast<double>(value) / voxel);
    if (block.box.contains(as_vec3(node) - way)) return;
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
  const int beyond = std::max(level - stack.top(), 0);
  return std::ldexp(stack.voxel_mm(level - beyond), beyond);
}

double largest_side(const LevelStack& stack, int level, double reach_mm, double depth_mm) noexcept {
  const double near = 2.0 * reach_mm / voxel_of(stack, level) + 2.0 + 2.0 * kBorder;
  const double far_voxel = voxel_of(stack, far_level(stack, level, depth_mm));
  const double far = 2.0 * (reach_mm + depth_mm) / far_voxel + 10.0;
  return std::ceil(std::max(near, far));
}

NodeBox covering_nodes(const Vec3& center_mm, double reach_mm, double voxel_mm) {
  NodeBox box;
  for (int axis = 0; axis < 3; ++axis) {
    const double center = center_mm[static_cast<std::size_t>(axis)];
    box.low[axis] = static_cast<int>(std::floor((center - reach_mm) / voxel_mm));
    box.high[axis] = static_cast<int>(std::ceil((center + reach_mm) / voxel_mm));
  }
  return box;
}

float LevelBlock::value_at(const Vec3& node) const noexcept {
  Coord cell;
  Vec3 share;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    cell[axis] = std::clamp(static_cast<int>(std::floor(node[a])), box.low[axis],
                            std::max(box.low[axis], box.high[axis] - 1));
    share[a] = node[a] - cell[axis];
  }
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Coord step{corner >> 2, (corner >> 1) & 1, corner & 1};
    double weight = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double s = share[static_cast<std::size_t>(axis)];
      weight *= step[axis] == 1 ? s : 1.0 - s;
    }
    if (weight != 0.0) sum += weight * static_cast<double>(nodes.value[index(cell + step)]);
  }
  return static_cast<float>(sum);
}

Vec3 LevelBlock::gradient_at(const Vec3& node) const noexcept {
  Vec3 gradient;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Vec3 low = node;
    Vec3 high = node;
    const int i = static_cast<int>(axis);
    low[axis] = std::max(node[axis] - 1.0, static_cast<double>(box.low[i]));
    high[axis] = std::min(node[axis] + 1.0, static_cast<double>(box.high[i]));
    const double way = (high[axis] - low[axis]) * static_cast<double>(nodes.voxel);
    gradient[axis] = static_cast<double>(value_at(high) - value_at(low)) / way;
  }
  return gradient;
}

NodeBox part_of(const NodeBox& box, const Coord& place) {
  return {Coord::maxComponent(place, box.low),
          Coord::minComponent(place.offsetBy(kLeafSide - 1), box.high)};
}

LevelBlock empty_block(const NodeBox& box, double voxel_mm) {
  LevelBlock block;
  block.box = box;
  block.nodes.n = box.sides();
  block.nodes.voxel = static_cast<float>(voxel_mm);
  const std::size_t size = block.index(box.high) + 1;
  block.nodes.value.resize(size);
  block.nodes.state.resize(size);
  return block;
}

LevelBlock gather(const LevelStack& stack, int level, const NodeBox& box) {
  LevelBlock block = empty_block(box, voxel_of(stack, level));
  if (level > stack.top()) {
    gather_thinned(stack, level, block);
    return block;
  }
  const NodeBox places{place_of(box.low) >> 3, place_of(box.high) >> 3};
  for_each_node(places, [&](const Coord& place) {
    gather_place(stack, level, place << 3, kFixedBand * block.nodes.voxel, block);
  });
  return block;
}

LevelBlock extended_block(const LevelStack& stack, int level, const NodeBox& box, double depth_mm) {
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
