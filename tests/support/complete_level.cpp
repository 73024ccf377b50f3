// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/complete_level.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <openvdb/tools/SignedFloodFill.h>

#include "field/level_stack.h"
#include "field/nesting.h"

namespace argil::test {
namespace {

/// The leaves of level 0 in a cube that the surface may cross.
void collect(const SceneDistance& distance, double voxel_mm, const Coord& low, int side,
             std::vector<Coord>& places) {
  const double middle = side / 2.0;
  const Vec3 center = voxel_mm * Vec3{low.x() + middle, low.y() + middle, low.z() + middle};
  if (std::abs(distance(center)) > voxel_mm * (std::sqrt(3.0) * middle + kHalfWidthVoxels)) return;
  if (side == kLeafSide) {
    places.push_back(low);
    return;
  }
  const int half = side / 2;
  for (int octant = 0; octant < 8; ++octant) {
    const Coord step(octant >> 2, (octant >> 1) & 1, octant & 1);
    collect(distance, voxel_mm, low.offsetBy(step.x() * half, step.y() * half, step.z() * half),
            half, places);
  }
}

}  // namespace

VdbGrid::Ptr complete_level(const ForceScene& scene, double voxel_mm) {
  int side = kLeafSide;
  while (side * voxel_mm < scene.half_mm + 2.0) side *= 2;
  std::vector<Coord> places;
  for (int octant = 0; octant < 8; ++octant) {
    const Coord step(octant >> 2, (octant >> 1) & 1, octant & 1);
    collect(scene.distance, voxel_mm,
            Coord((step.x() - 1) * side, (step.y() - 1) * side, (step.z() - 1) * side), side,
            places);
  }
  LevelStack stack(voxel_mm, 1);
  const float band = stack.band_mm(0);
  LeafValues values;
  for (const Coord& place : places) {
    for (int n = 0; n < kLeafNodes; ++n) {
      const Coord node = place.offsetBy(n >> 6, (n >> 3) & 7, n & 7);
      const Vec3 at{voxel_mm * node.x(), voxel_mm * node.y(), voxel_mm * node.z()};
      values[static_cast<std::size_t>(n)] =
          std::clamp(static_cast<float>(scene.distance(at)), -band, band);
    }
    if (has_band(values.data(), band)) stack.set_leaf(0, place, values.data());
  }
  openvdb::tools::signedFloodFill(stack.grid(0).tree());
  auto grid = VdbGrid::create(band);
  grid->setTree(stack.grid(0).treePtr());
  return grid;
}

}  // namespace argil::test
