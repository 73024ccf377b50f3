// SPDX-License-Identifier: GPL-3.0-or-later
// With cones over its open edges every mesh is closed, so that its crossings with lattice lines
// tell its winding number, and w is that less the cones'.
#include <cassert>
#include <vector>

#include "import/import_field.h"

namespace argil {
namespace {

constexpr double kClearFraction = 0.25;
constexpr double kHalfDiagonal = 0.5 * (kLeafSide - 1) * 1.7320508075688773;

std::vector<Triangle> both(std::vector<Triangle> triangles, const std::vector<Triangle>& more) {
  triangles.insert(triangles.end(), more.begin(), more.end());
  return triangles;
}

}  // namespace

ImportSampler::ImportSampler(const ImportInput& input) : input_(input) {
  if (input.closed) {
    lattice_.emplace(input.positions, input.triangles, input.center, input.voxel_mm);
    return;
  }
  std::vector<Vec3> positions = input.positions;
  const std::vector<Triangle> cones = boundary_cones(positions, input.triangles);
  lattice_.emplace(positions, both(input.triangles, cones), input.center, input.voxel_mm);
  cones_.emplace(positions, cones, SolidWinding::kConeFarRadii);
}

bool ImportSampler::is_clear(const Coord& origin) const noexcept {
  if (!cones_) return true;
  const double half = 0.5 * (kLeafSide - 1) * voxel();
  const Vec3 middle = position(origin) + Vec3{half, half, half};
  return cones_->most_within(middle, kHalfDiagonal * voxel()) < kClearFraction;
}

void ImportSampler::build_trees() {
  if (distance_) return;
  distance_.emplace(input_.positions, input_.triangles);
  winding_.emplace(input_.positions, input_.triangles);
}

}  // namespace argil
