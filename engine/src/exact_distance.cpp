// SPDX-License-Identifier: GPL-3.0-or-later
#include "exact_distance.h"

#include <cmath>
#include <limits>

#include "argil/engine/surface.h"

#include "mesh_distance.h"

namespace argil {
namespace {

/// The field at a node of any level: below level 0 trilinear between the finest nodes.
float field_at(const LevelStack& stack, int level, const Coord& node) {
  if (level >= 0) return stack.node_value(level, node);
  const int shift = -level;
  const Coord low = node >> shift;
  const Coord rest = node - (low << shift);
  float sum = 0.0F;
  for (int corner = 0; corner < 8; ++corner) {
    const Coord step{corner >> 2, (corner >> 1) & 1, corner & 1};
    float weight = 1.0F;
    for (int axis = 0; axis < 3; ++axis) {
      const float share = std::ldexp(static_cast<float>(rest[axis]), level);
      weight *= step[axis] == 1 ? share : 1.0F - share;
    }
    if (weight > 0.0F) sum += weight * stack.node_value(0, low + step);
  }
  return sum;
}

LevelBlock empty_block(const NodeBox& box, double voxel) {
  LevelBlock block;
  block.box = box;
  block.nodes.n = box.sides();
  block.nodes.voxel = static_cast<float>(voxel);
  block.nodes.value.resize(block.index(box.high) + 1);
  block.nodes.state.assign(block.nodes.value.size(), MarchBlock::kFixed);
  return block;
}

}  // namespace

LevelBlock exact_block(const Clay& clay, int level, const NodeBox& box) {
  const LevelStack& stack = clay.levels();
  const double voxel = std::ldexp(stack.voxel_mm(0), level);
  const auto trusted = static_cast<float>((kHalfWidthVoxels - 1) * stack.voxel_mm(0));
  LevelBlock block = empty_block(box, voxel);
  const TriangleMesh surface = extract_surface(clay);
  const MeshDistance closest(surface.positions, surface.triangles);
  std::uint32_t hint = kNoTriangle;
  for_each_node(box, [&](const Coord& node) {
    float value = field_at(stack, level, node);
    if (std::abs(value) >= trusted && !surface.triangles.empty()) {
      const Vec3 place = voxel * Vec3{static_cast<double>(node.x()), static_cast<double>(node.y()),
                                      static_cast<double>(node.z())};
      const auto found = closest.closest(place, std::numeric_limits<double>::infinity(), hint);
      hint = found.triangle;
      value = std::copysign(static_cast<float>(found.distance), value);
    }
    block.nodes.value[block.index(node)] = value;
  });
  return block;
}

}  // namespace argil
