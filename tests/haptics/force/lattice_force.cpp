// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/force/lattice_force.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "argil/haptics/force/closed_force.h"

#include "force/law_table.h"
#include "haptics/force/fields.h"
#include "support/effort.h"

namespace argil::haptics {
namespace {

using namespace fields;

constexpr ForceLaw kBothLaws[] = {ForceLaw::energy, ForceLaw::blanch};

std::vector<ForceTool> tools(double radius) {
  ForceTool long_one;
  long_one.radii_mm = {radius / 4.0, radius / 4.0, radius};
  ForceTool flat;
  flat.radii_mm = {radius, radius, radius / 2.0};
  ForceTool box;
  box.shape = ToolShape::box;
  box.radii_mm = {radius, radius / 2.0, radius / 1.5};
  ForceTool capsule;
  capsule.shape = ToolShape::capsule;
  capsule.radii_mm = {radius / 3.0, radius / 3.0, radius};
  return {ball_tool(radius, {}), long_one, flat, box, capsule};
}

/// Random numbers and poses that are the same on every run.
class Dice {
 public:
  explicit Dice(unsigned seed) : random_(seed) {}
  double signed_unit() { return unit_(random_); }
  Vec3 place() { return {signed_unit(), signed_unit(), signed_unit()}; }
  Vec3 direction() { return normalized(place()); }
  Quat orientation() {
    return normalized(Quat{signed_unit(), signed_unit(), signed_unit(), signed_unit()});
  }

 private:
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> unit_{-1.0, 1.0};
};

Window window_of(const Distance& field, const ForceTool& tool, const Lattice& lattice,
                 const Vec3& offset = {}) {
  return sampled(field, tool.position_mm, window_reach_mm(tool, lattice, 0.0), lattice.voxel_mm,
                 lattice.voxel_mm * offset);
}

ForceResult felt(const Distance& field, const ForceTool& tool, const ForceMaterial& material,
                 ForceLaw law, const Vec3& offset = {}) {
  const Lattice lattice = choose_lattice(tool);
  const Window window = window_of(field, tool, lattice, offset);
  const ForceResult result =
      LatticeForce(tool, material, law, lattice.voxel_mm).evaluate(window.view, tool);
  EXPECT_FALSE(result.outside_window);
  return result;
}

/// The largest error of force and torque of both laws, relative to max(|F|, 0.05 f_c0), against the
/// closed form, which needs no lattice.
double error_on_plane(ForceTool tool, double depth, const ForceMaterial& material, Dice& dice) {
  const double radius = tool.radii_mm.z;
  const Vec3 n = dice.direction();
  tool.orientation = dice.orientation();
  tool.position_mm = (radius * (1.0 - depth)) * n;
  const ForceResult exact = plane_force(n, 0.0, tool, material);
  const double scale = std::max(length(exact.contact_n), 0.05 * material.surface_force_n);
  double worst = 0.0;
  for (const ForceLaw law : kBothLaws) {
    const ForceResult result = felt(plane(n), tool, material, law, dice.place());
    const double force = length(result.contact_n - exact.contact_n);
    const double torque = length(result.contact_nmm - exact.contact_nmm) / radius;
    worst = std::max({worst, force / scale, torque / scale});
  }
  return worst;
}

/// From skimming to immersed, skins from a quarter to four times the radius.
TEST(LatticeForce, IsTheClosedFormOnAPlane) {
  Dice dice(1);
  double worst = 0.0;
  for (const double radius : {2.0, 8.0, 32.0}) {
    for (const double e : {1.0, 2.0, 2.5, 4.0}) {
      ForceMaterial material;
      material.exponent = e;
      for (const double depth : {0.05, 0.3, 1.0, 2.0}) {
        worst = std::max(worst, error_on_plane(tools(radius)[0], depth, material, dice));
        worst = std::max(worst, error_on_plane(tools(radius)[1], depth, material, dice));
      }
    }
  }
  RecordProperty("worst_error", std::to_string(worst));
  EXPECT_LE(worst, 0.008);
  EXPECT_GT(worst, 1e-5);  // else the comparison would be with itself
}

TEST(LatticeForce, IsTheClosedFormOnABall) {
  Dice dice(2);
  for (const double radius : {2.0, 8.0, 32.0}) {
    for (const double depth : {0.05, 0.5, 1.0}) {
      const Vec3 n = dice.direction();
      const double clay = 1.7 * radius + 8.0;
      const ForceTool tool = ball_tool(radius, (clay + radius * (1.0 - depth)) * n);
      const Vec3 exact = ball_force({}, clay, tool, {}).contact_n;
      for (const ForceLaw law : kBothLaws) {
        const Vec3 result = felt(ball(clay), tool, {}, law, dice.place()).contact_n;
        EXPECT_LE(length(result - exact), 0.008 * std::max(length(exact), 0.15)) << radius;
      }
    }
  }
}

/// Two implementations that share the law and the kernels' formulas only.
TEST(LatticeForce, AgreesWithThePlainSumForEveryShape) {
  Dice dice(3);
  const Distance field = blended_balls(6);
  for (const double radius : {2.0, 6.0}) {
    for (ForceTool tool : tools(radius)) {
      tool.position_mm = {2.0 + dice.signed_unit(), 8.0, 3.0};
      tool.orientation = dice.orientation();
      tool.velocity_mm_per_s = 40.0 * dice.place();
      tool.angular_velocity_rad_per_s = 3.0 * dice.place();
      const double fine = choose_lattice(tool).voxel_mm / 2.5;
      const Window window =
          sampled(field, tool.position_mm, window_reach_mm(tool, choose_lattice(tool), 0.0), fine);
      const ForceResult plain = volume_force(window.view, tool, {}, ForceLaw::energy);
      ASSERT_FALSE(plain.outside_window);
      const ForceResult result = felt(field, tool, {}, ForceLaw::energy, dice.place());
      const double force = length(plain.contact_n);
      EXPECT_LE(length(result.contact_n - plain.contact_n), 0.005 * force);
      EXPECT_LE(length(result.contact_nmm - plain.contact_nmm), 0.005 * force * radius);
      EXPECT_NEAR(result.energy_nmm, plain.energy_nmm, 0.005 * plain.energy_nmm);
      EXPECT_LE(length(result.viscosity_n - plain.viscosity_n), 0.005 * length(plain.viscosity_n));
      EXPECT_LE(length(result.viscosity_nmm - plain.viscosity_nmm),
                0.01 * length(plain.viscosity_nmm));
      // A capsule visits the box around it.
      EXPECT_GE(result.samples, 0.95 * choose_lattice(tool).samples - 40.0);
      EXPECT_LE(result.samples, 1.5 * choose_lattice(tool).samples + 40.0);
    }
  }
}

/// Not within 1e-5: the same bits, whatever the machine.
TEST(LatticeForceSimd, GivesTheSameBitsWithEveryInstructionSet) {
  Dice dice(4);
  int compared = 0;
  for (ForceTool tool : tools(3.0)) {
    tool.orientation = dice.orientation();
    tool.position_mm = {1.0, 9.0, 2.0};
    tool.velocity_mm_per_s = {30.0, -10.0, 5.0};
    const Lattice lattice = choose_lattice(tool);
    const Window window = window_of(blended_balls(6), tool, lattice, dice.place());
    for (const ForceLaw law : kBothLaws) {
      const LatticeForce baseline(tool, {}, law, lattice.voxel_mm, Simd::baseline);
      const ForceResult expected = baseline.evaluate(window.view, tool);
      for (const Simd simd : {Simd::avx2, Simd::avx512}) {
        if (!has_simd(simd)) continue;
        ++compared;
        const LatticeForce force(tool, {}, law, lattice.voxel_mm, simd);
        const ForceResult result = force.evaluate(window.view, tool);
        EXPECT_EQ(result.contact_n, expected.contact_n);
        EXPECT_EQ(result.contact_nmm, expected.contact_nmm);
        EXPECT_EQ(result.viscosity_n, expected.viscosity_n);
        EXPECT_EQ(result.viscosity_nmm, expected.viscosity_nmm);
        EXPECT_EQ(result.energy_nmm, expected.energy_nmm);
        EXPECT_EQ(result.error_n, expected.error_n);
        EXPECT_EQ(result.samples, expected.samples);
      }
    }
  }
  if (compared == 0) GTEST_SKIP() << "this machine has neither AVX2 nor AVX-512";
}

TEST(LatticeForceSimd, DispatchesToTheBestOfTheMachine) {
  EXPECT_TRUE(has_simd(Simd::baseline));
  EXPECT_TRUE(has_simd(best_simd()));
  if (has_simd(Simd::avx512)) {
    EXPECT_EQ(best_simd(), Simd::avx512);
  } else if (has_simd(Simd::avx2)) {
    EXPECT_EQ(best_simd(), Simd::avx2);
  }
}

TEST(LatticeForce, HasNoMoreSamplesThanItsBudget) {
  for (const double radius : {0.01, 1.0, 100.0}) {
    for (const ForceTool& tool : tools(radius)) {
      const Lattice lattice = choose_lattice(tool);
      EXPECT_LE(lattice.samples, kMostSamples * 1.0001);
      EXPECT_GE(lattice.across, 4.0);
      EXPECT_LE(window_reach_mm(tool, lattice, 0.0) / lattice.voxel_mm, 29.0);
    }
  }
  EXPECT_DOUBLE_EQ(choose_lattice(ball_tool(4.0, {})).across, 8.0);
}

/// The force of the energy law is minus the gradient of the summed energy, to rounding: no
/// correction stands between the two.
TEST(LatticeForce, IsMinusTheGradientOfItsEnergy) {
  Dice dice(5);
  for (const ForceTool& shape : tools(4.0)) {
    ForceTool tool = shape;
    tool.position_mm = {2.0, 8.0, 3.0};
    tool.orientation = dice.orientation();
    const Lattice lattice = choose_lattice(tool);
    const Window window = sampled(blended_balls(6), tool.position_mm,
                                  window_reach_mm(tool, lattice, 1.0), lattice.voxel_mm);
    const LatticeForce force(tool, {}, ForceLaw::energy, lattice.voxel_mm);
    const ForceResult result = force.evaluate(window.view, tool);
    constexpr double kStep = 0.02;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ForceTool ahead = tool;
      ForceTool behind = tool;
      ahead.position_mm[axis] += kStep;
      behind.position_mm[axis] -= kStep;
      const double rise = force.evaluate(window.view, ahead).energy_nmm -
                          force.evaluate(window.view, behind).energy_nmm;
      EXPECT_NEAR(result.contact_n[axis], -rise / (2.0 * kStep), 2e-3 * length(result.contact_n));
    }
  }
}

/// Ripple: what remains of the lattice when the tool slides along a plane in any direction.
TEST(LatticeForce, DoesNotCogWhenItSlides) {
  Dice dice(6);
  double worst_rms = 0.0;
  double worst_swing = 0.0;
  for (const double radius : {2.0, 8.0, 32.0}) {
    for (const double depth : {0.05, 0.5, 1.5}) {
      const Vec3 n = dice.direction();
      const Vec3 along = normalized(cross(n, dice.direction()));
      ForceTool tool = ball_tool(radius, (radius * (1.0 - depth)) * n);
      const Lattice lattice = choose_lattice(tool);
      const Window window =
          sampled(plane(n), tool.position_mm,
                  window_reach_mm(tool, lattice, 3.0 * lattice.voxel_mm), lattice.voxel_mm);
      const LatticeForce force(tool, {}, ForceLaw::energy, lattice.voxel_mm);
      std::vector<Vec3> felt_along;
      for (int step = 0; step < 120; ++step) {
        ForceTool there = tool;
        there.position_mm += (0.02 * step * lattice.voxel_mm) * along;
        felt_along.push_back(force.evaluate(window.view, there).contact_n);
      }
      Vec3 mean;
      for (const Vec3& f : felt_along) mean += f / 120.0;
      double square = 0.0;
      double swing = 0.0;
      for (const Vec3& f : felt_along) {
        square += dot(f - mean, f - mean) / 120.0;
        swing = std::max(swing, 2.0 * length(f - mean));
      }
      worst_rms = std::max(worst_rms, std::sqrt(square) / length(mean));
      worst_swing = std::max(worst_swing, swing / length(mean));
    }
  }
  RecordProperty("ripple_rms", std::to_string(worst_rms));
  EXPECT_LE(worst_rms, 0.005);
  EXPECT_LE(worst_swing, 0.02);
}

/// A law that is smooth on the lattice's scale is not changed by the filter; one that is not loses
/// its kinks and keeps its area.
TEST(LawTable, KeepsASmoothLawAndIsNoughtOutside) {
  const ForceMaterial material;
  const ContactLaw law(material);
  const LawTable fine = filtered_potential(law, 0.05);
  for (const double phi : {-60.0, -30.0, -6.0, -4.0, 0.0, 3.0, 7.0}) {
    EXPECT_NEAR(fine.at(phi), law.potential_nmm(law.density(phi)), 2e-3) << phi;
  }
  for (const double voxel : {0.05, 1.0, 8.0, 40.0}) {
    const LawTable table = filtered_potential(law, voxel);
    EXPECT_NEAR(table.at(material.skin_mm + 2.0 * voxel), 0.0, 1e-9);
    EXPECT_EQ(table.at(1e6), 0.0);
    const double deep = -10.0 * (voxel + material.skin_mm);
    EXPECT_NEAR(table.at(deep), law.potential_nmm(law.density(deep)), 1e-4 * table.at(deep));
    const LawTable pressure = filtered_pressure(law, voxel);
    EXPECT_NEAR(pressure.at(deep), material.surface_force_n * material.clamp_ratio, 1e-5);
    EXPECT_EQ(pressure.at(1e6), 0.0);
  }
}

/// Fixed time is a promise: a lattice finer than the budget allows is not summed.
TEST(LatticeForce, RefusesMoreSamplesThanItsBudget) {
  const ForceTool tool = ball_tool(4.0, {});
  const Window window = sampled(plane({0, 0, 1}), {}, 9.0, 0.5);
  const ForceResult result =
      LatticeForce(tool, {}, ForceLaw::energy, 0.5).evaluate(window.view, tool);
  EXPECT_TRUE(result.outside_window);
  EXPECT_EQ(result.samples, 0);
}

TEST(LatticeForce, RefusesAWindowOfAnotherSpacing) {
  const ForceTool tool = ball_tool(4.0, {});
  const Window window = sampled(plane({0, 0, 1}), {}, 9.0, 0.9);
  const ForceResult result =
      LatticeForce(tool, {}, ForceLaw::energy, 1.0).evaluate(window.view, tool);
  EXPECT_TRUE(result.outside_window);
  EXPECT_EQ(result.contact_n, Vec3{});
}

/// Moves and turns the tool ever farther out of a window cut to fit it.
void expect_sane_outside(const LatticeForce& force, const Window& window, ForceTool tool,
                         Dice& dice) {
  EXPECT_FALSE(force.evaluate(window.view, tool).outside_window);
  for (int i = 0; i < 40; ++i) {
    tool.orientation = dice.orientation();
    tool.position_mm = (4.0 * (1 + i)) * dice.direction();
    const ForceResult result = force.evaluate(window.view, tool);
    EXPECT_TRUE(is_finite(result.contact_n) && is_finite(result.contact_nmm));
    EXPECT_TRUE(result.outside_window || i <= 10);
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Vec3& place : {Vec3{-1e300, 0, 0}, Vec3{nan, nan, nan}}) {
    tool.position_mm = place;
    const ForceResult result = force.evaluate(window.view, tool);
    EXPECT_TRUE(result.outside_window);
    EXPECT_EQ(result.contact_n, Vec3{});
  }
}

/// Wherever the tool is, even nowhere: no crash, no NaN, no read beyond the window's memory (the
/// address sanitizer watches).
TEST(LatticeForce, SaysWhenTheSupportLeavesTheWindow) {
  Dice dice(7);
  for (const ForceLaw law : kBothLaws) {
    for (const ForceTool& tool : tools(4.0)) {
      const Lattice lattice = choose_lattice(tool);
      const Window window =
          sampled(plane({0, 0, 1}), {}, window_reach_mm(tool, lattice, 0.1), lattice.voxel_mm);
      expect_sane_outside(LatticeForce(tool, {}, law, lattice.voxel_mm), window, tool, dice);
    }
  }
}

TEST(LatticeForce, CostsNothingOutsideTheSkin) {
  const ForceTool tool = ball_tool(2.0, {0, 0, 40});
  const ForceResult result = felt(plane({0, 0, 1}), tool, {}, ForceLaw::energy);
  EXPECT_LE(length(result.contact_n), 1e-6);
  EXPECT_LE(result.error_n, 1e-6);
}

/// `error_n` bounds the error on fields that the window holds exactly; what windows of clay add is
/// tested with them.
TEST(LatticeForceError, BoundsTheErrorOnExactFields) {
  Dice dice(8);
  int bounded = 0;
  int total = 0;
  double sum_of_bounds = 0.0;
  const int places = argil::test::effort(30, 150);
  const Distance scenes[] = {plane({1, 2, 3}), ball(24), torus(20, 8), edge(), blended_balls(6)};
  for (const Distance& scene : scenes) {
    for (int i = 0; i < places; ++i) {
      ForceMaterial material;
      material.exponent = std::pow(2.0, i % 3);
      const double radius = std::pow(2.0, 1 + i % 5);
      Vec3 place{30.0 * dice.signed_unit(), 30.0 * dice.signed_unit(), 20.0 * dice.signed_unit()};
      if (scene(place) < -radius || scene(place) > 0.95 * radius) continue;
      const ForceTool tool = ball_tool(radius, place);
      const ForceResult exact = force_at(scene, tool, 48, material, ForceLaw::energy);
      const ForceResult result = felt(scene, tool, material, ForceLaw::energy, dice.place());
      ++total;
      if (length(result.contact_n - exact.contact_n) <= result.error_n) ++bounded;
      sum_of_bounds += result.error_n / std::max(length(exact.contact_n), 0.15);
    }
  }
  ASSERT_GT(total, 2 * places);
  RecordProperty("mean_bound", std::to_string(sum_of_bounds / total));
  EXPECT_GE(bounded, 0.99 * total) << bounded << " of " << total;
  EXPECT_LE(sum_of_bounds / total, 0.05) << "a bound that bounds everything says nothing";
}

}  // namespace
}  // namespace argil::haptics
