// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "argil/haptics/force/tool_force.h"

#include "haptics/force/fields.h"

namespace argil::haptics {
namespace {

using namespace fields;

// Work along closed loops.

struct LoopWork {
  double work_mj = 0.0;  ///< N mm
  double greatest_energy_mj = 0.0;
};

/// Once around the rectangle low + [0, w] x [0, h] in the plane z = low.z.
LoopWork walk(const FieldWindowView& window, const ForceMaterial& material, ForceLaw law,
              const Vec3& low, double width, double height) {
  constexpr int kSteps = 120;
  const Vec3 corners[] = {low, low + Vec3{width, 0, 0}, low + Vec3{width, height, 0},
                          low + Vec3{0, height, 0}, low};
  LoopWork result;
  for (std::size_t side = 0; side < 4; ++side) {
    const Vec3 step = (corners[side + 1] - corners[side]) / kSteps;
    for (int i = 0; i < kSteps; ++i) {
      const Vec3 place = corners[side] + (i + 0.5) * step;
      const ForceResult force = volume_force(window, ball_tool(4.0, place), material, law);
      EXPECT_FALSE(force.outside_window);
      result.work_mj += dot(force.contact_n, step);
      result.greatest_energy_mj = std::max(result.greatest_energy_mj, force.energy_nmm);
    }
  }
  return result;
}

TEST(LoopWork, OfTheEnergyLawVanishes) {
  for (const double voxel : {1.0, 0.7}) {
    const Window window = sampled(blended_balls(6), {2, 11, 0}, 22, voxel, {0.13, 0.21, 0.4});
    for (const double e : {1.0, 2.0, 4.0}) {
      ForceMaterial material;
      material.exponent = e;
      for (const double z : {1.3, -4.0}) {
        const LoopWork loop = walk(window.view, material, ForceLaw::energy, {-6, 1, z}, 16, 22);
        EXPECT_GT(loop.greatest_energy_mj, 10.0);
        EXPECT_LE(std::abs(loop.work_mj), 1e-3 * loop.greatest_energy_mj) << e << ' ' << z;
      }
    }
  }
}

/// The contrast that shows the measurement can see work: the unit gradient is not conservative.
TEST(LoopWork, OfTheBlanchLawDoesNotVanish) {
  const Window window = sampled(blended_balls(6), {2, 11, 0}, 22, 1.0, {0.13, 0.21, 0.4});
  for (const double e : {1.0, 2.0, 4.0}) {
    ForceMaterial material;
    material.exponent = e;
    const LoopWork energy = walk(window.view, material, ForceLaw::energy, {-6, 1, 1.3}, 16, 22);
    const LoopWork blanch = walk(window.view, material, ForceLaw::blanch, {-6, 1, 1.3}, 16, 22);
    EXPECT_GT(std::abs(blanch.work_mj), 0.5) << e;
    EXPECT_GT(std::abs(blanch.work_mj), 100.0 * std::abs(energy.work_mj)) << e;
  }
}

}  // namespace
}  // namespace argil::haptics
