// SPDX-License-Identifier: GPL-3.0-or-later
#include "exact_distance.h"

#include <cmath>
#include <limits>

#include "argil/engine/surface.h"

#include "mesh_distance.h"

namespace argil {
namespace {

LevelBlock block_of_unknowns(const NodeBox& box, double voxel) {
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
  const double voxel = stack.voxel_mm(level);
  const auto trusted = static_cast<float>((kHalfWidthVoxels - 1) * stack.voxel_mm(0));
  LevelBlock block = block_of_unknowns(box, voxel);
  const TriangleMesh surface = extract_surface(clay);
  const MeshDistance closest(surface.positions, surface.triangles);
  std::uint32_t hint = kNoTriangle;
  for_each_node(box, [&](const Coord& node) {
    float value = stack.node_value(level, node);
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
