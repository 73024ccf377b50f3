// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "argil/haptics/tool_force.h"

#include "haptics/fields.h"

namespace argil::haptics {
namespace {

using namespace fields;

// Work along closed loops, and the places where the definition of the volume force fails
// (../shared/facts/theory.md C.2).

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

/// The volume force on a field that depends on z alone, by a sum over z that shares nothing with
/// the tested code: the kernel's share of a slice is (1 - (z / support)^2)^5, a uniform ball's 1 -
/// (z / R)^2. `slope` is d phi / d z (0 where the field is flat).
template <class Phi, class Slope>
double sliced_force(bool uniform, double radius, double height, const ForceMaterial& material,
                    const Phi& phi, const Slope& slope) {
  constexpr int kSlices = 20000;
  const double reach = uniform ? radius : kKernelSupport * radius;
  double weights = 0.0;
  double sum = 0.0;
  for (int i = 0; i < kSlices; ++i) {
    const double share = -1.0 + 2.0 * (i + 0.5) / kSlices;
    const double weight = std::pow(1.0 - share * share, uniform ? 1.0 : 5.0);
    const double z = height + reach * share;
    const double u = std::max(0.0, 1.0 - phi(z) / material.skin_mm);
    weights += weight;
    sum += weight * slope(z) * std::min(std::pow(u, material.exponent), material.clamp_ratio);
  }
  return material.surface_force_n * sum / weights;
}

double saturated_contact(bool uniform, double radius, double skin) {
  ForceMaterial material;
  material.skin_mm = skin;
  return sliced_force(
             uniform, radius, 0.0, material, [](double z) { return z; },
             [=](double z) { return z > -skin ? 1.0 : 0.0; }) /
         material.surface_force_n;
}

/// A field clamped one skin below the surface, as a narrow band is: large tools feel nothing.
TEST(VolumeForceFailure, SaturatingFieldLosesLargeTools) {
  // R / l, and F / f_c0 at contact of a uniform ball according to the theory.
  const std::pair<double, double> rows[] = {{1.0, 1.22}, {2.0, 0.86}, {5.0, 0.37}, {10.0, 0.19}};
  for (const auto& [ratio, theory] : rows) {
    ForceMaterial material;
    material.skin_mm = 4.0 / ratio;
    const Distance field = clamped_at(material.skin_mm, plane({0, 0, 1}));
    const ForceTool tool = ball_tool(4.0, {});
    const double contact =
        force_at(field, tool, 40, material, ForceLaw::energy, {0.3, 0.2, 0.37}).contact_n.z /
        material.surface_force_n;
    EXPECT_NEAR(contact, saturated_contact(false, 4.0, material.skin_mm), 0.02 * contact) << ratio;
    EXPECT_NEAR(contact, theory, 0.1 * theory) << ratio;
    EXPECT_NEAR(saturated_contact(true, 4.0, material.skin_mm), theory, 0.06 * theory) << ratio;
  }
}

TEST(VolumeForceFailure, SaturatingFieldLetsImmersedToolsThrough) {
  const ForceMaterial material;
  const Distance plain = plane({0, 0, 1});
  const Distance band = clamped_at(material.skin_mm, plain);
  const auto force = [&](const Distance& field, double depth) {
    return force_at(field, ball_tool(8.0, {0, 0, -depth}), 16, material, ForceLaw::energy)
               .contact_n.z /
           material.surface_force_n;
  };
  EXPECT_GT(force(plain, 8.0), 2.4);
  EXPECT_GT(force(plain, 16.0), 2.6);
  EXPECT_LT(force(band, 8.0), 1.3);
  EXPECT_LT(force(band, 16.0), 0.05);
}

double greatest_on_sheet(double thickness, double radius, const ForceMaterial& material) {
  double greatest = 0.0;
  for (int step = 0; step < 36; ++step) {
    const double height = 0.1 * radius * step;
    const ForceResult result = force_at(slab(thickness), ball_tool(radius, {0, 0, height}), 32,
                                        material, ForceLaw::energy, {0.3, 0.2, 0.37});
    greatest = std::max(greatest, std::abs(result.contact_n.z));
  }
  return greatest / material.surface_force_n;
}

double sliced_on_sheet(double thickness, double radius, const ForceMaterial& material) {
  double greatest = 0.0;
  for (int step = 0; step < 36; ++step) {
    const double height = 0.1 * radius * step;
    const double force = sliced_force(
        false, radius, height, material, [=](double z) { return std::abs(z) - thickness / 2.0; },
        [](double z) { return z < 0.0 ? -1.0 : 1.0; });
    greatest = std::max(greatest, std::abs(force));
  }
  return greatest / material.surface_force_n;
}

/// Sheets thinner than half the tool's radius can be pushed through with less than a third of f_c0.
TEST(VolumeForceFailure, ThinSheetIsWeak) {
  constexpr double kRadius = 4.0;
  ForceMaterial material;
  material.skin_mm = 0.5 * kRadius;
  double last = 0.0;
  for (const double ratio : {0.1, 0.25, 0.5, 1.0, 2.0}) {
    const double greatest = greatest_on_sheet(ratio * kRadius, kRadius, material);
    const double sliced = sliced_on_sheet(ratio * kRadius, kRadius, material);
    EXPECT_NEAR(greatest, sliced, 0.03 * sliced + 0.002) << ratio;
    EXPECT_GT(greatest, last) << ratio;
    EXPECT_LT(greatest, ratio <= 0.5 ? 0.32 : 2.0) << ratio;
    last = greatest;
  }
  EXPECT_GT(last, 1.0);
}

}  // namespace
}  // namespace argil::haptics
