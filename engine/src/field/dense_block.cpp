// SPDX-License-Identifier: GPL-3.0-or-later
#include "field/dense_block.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace argil {

NodeBox covering_nodes(const Vec3& center_mm, double reach_mm, double voxel_mm) {
  assert(is_finite(center_mm) && reach_mm >= 0.0 && voxel_mm > 0.0);
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
  Vec3 fraction;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    cell[axis] = std::clamp(static_cast<int>(std::floor(node[a])), box.low[axis],
                            std::max(box.low[axis], box.high[axis] - 1));
    fraction[a] = node[a] - cell[axis];
  }
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Coord step{corner >> 2, (corner >> 1) & 1, corner & 1};
    double weight = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double s = fraction[static_cast<std::size_t>(axis)];
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
    const double span = (high[axis] - low[axis]) * static_cast<double>(nodes.voxel);
    gradient[axis] = static_cast<double>(value_at(high) - value_at(low)) / span;
  }
  return gradient;
}

NodeBox part_of(const NodeBox& box, const Coord& origin) {
  return {Coord::maxComponent(origin, box.low),
          Coord::minComponent(origin.offsetBy(kLeafSide - 1), box.high)};
}

LevelBlock empty_block(const NodeBox& box, double voxel_mm) {
  assert(box.low.x() <= box.high.x() && box.low.y() <= box.high.y() && box.low.z() <= box.high.z());
  LevelBlock block;
  block.box = box;
  block.nodes.n = box.sides();
  block.nodes.voxel = static_cast<float>(voxel_mm);
  const std::size_t size = block.index(box.high) + 1;  // the last of them
  block.nodes.value.resize(size);
  block.nodes.state.resize(size);
  return block;
}

}  // namespace argil
