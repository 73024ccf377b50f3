// SPDX-License-Identifier: GPL-3.0-or-later
// What a window does to the force: the same sum on the same nodes, once with the clay's window and
// once with the formula the clay was made from.
#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "argil/engine/window.h"
#include "argil/haptics/force/tool_force.h"

#include "clay/clay_access.h"
#include "edit/build_levels.h"
#include "haptics/force/fields.h"
#include "support/complete_level.h"
#include "support/effort.h"
#include "support/force_scenes.h"

namespace argil {
namespace {

using test::ForceScene;

constexpr double kForceVoxel = 0.25;

enum class Made { from_formula, as_imported };

Clay clay_of(const ForceScene& scene, Made made) {
  // Close enough for the window alone to be judged.
  const ClayOptions options{.voxel_mm = kForceVoxel, .tolerance_voxels = 0.02};
  if (made == Made::as_imported) {
    return clay_of_levels(stack_from_finest(test::complete_level(scene, kForceVoxel), options),
                          options);
  }
  Box3 bounds;
  bounds.include(Vec3{-scene.half_mm, -scene.half_mm, -scene.half_mm});
  bounds.include(Vec3{scene.half_mm, scene.half_mm, scene.half_mm});
  return Clay::from_distance(scene.distance, bounds, options).value();
}

struct Measured {
  std::vector<double> force_errors;  ///< shares of the force, or of 5 % of the surface force
  double squares_mm2 = 0.0;          ///< of the distance, within three voxels of the surface
  double estimates_mm2 = 0.0;        ///< squares of distance_error_mm
  std::size_t nodes = 0;
  std::size_t windows = 0;

  double p95() {
    std::sort(force_errors.begin(), force_errors.end());
    return force_errors[force_errors.size() * 95 / 100];
  }
  double distance_error_mm() const { return std::sqrt(squares_mm2 / static_cast<double>(nodes)); }
  double estimate_mm() const { return std::sqrt(estimates_mm2 / static_cast<double>(windows)); }
};

void add_forces(const FieldWindowView& window, const FieldWindowView& exact,
                const haptics::ForceTool& tool, Measured& measured) {
  for (const double exponent : {1.0, 2.0, 4.0}) {
    haptics::ForceMaterial material;
    material.exponent = exponent;
    const auto force = [&](const FieldWindowView& view) {
      return haptics::volume_force(view, tool, material, haptics::ForceLaw::energy).contact_n;
    };
    const Vec3 wanted = force(exact);
    const double scale = std::max(length(wanted), 0.05 * material.surface_force_n);
    measured.force_errors.push_back(length(force(window) - wanted) / scale);
  }
}

void add_window(const Clay& clay, const ForceScene& scene, const haptics::ForceTool& tool,
                Measured& measured) {
  const double radius = tool.radii_mm.x;
  const double voxel = radius / 4.0;
  const double reach = haptics::kKernelSupport * radius + 2.0 * voxel;
  const double depth = (2.0 + haptics::kKernelSupport) * radius + 8.0;
  const auto window =
      read_window(clay, {tool.position_mm, voxel, reach, depth}, Extension::layers).value();
  const auto exact = haptics::fields::sampled(scene.distance, tool.position_mm, reach, voxel);
  ASSERT_EQ(window.view.nodes, exact.view.nodes);
  add_forces(window.view, exact.view, tool, measured);
  std::size_t near = 0;
  for (std::size_t n = 0; n < window.storage.size(); ++n) {
    const auto wanted = static_cast<double>(exact.values[n]);
    if (!(std::abs(wanted) < 3.0 * voxel)) continue;
    const double off = static_cast<double>(window.storage[n]) - wanted;
    measured.squares_mm2 += off * off;
    ++near;
  }
  measured.nodes += near;
  if (near == 0) return;
  measured.estimates_mm2 += window.view.distance_error_mm * window.view.distance_error_mm;
  ++measured.windows;
}

/// Tools from 2 R deep to 0.95 R above the surface.
Measured measure(const std::string& name, double radius_mm, Made made) {
  const ForceScene scene = test::force_scene(name, radius_mm, kForceVoxel);
  const Clay clay = clay_of(scene, made);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> side(-1.0, 1.0);
  constexpr int kPlaces = 9;
  Measured measured;
  for (int n = 0; n < kPlaces; ++n) {
    const double height = radius_mm * (-2.0 + 2.95 * n / (kPlaces - 1));
    const double u = side(random);
    const Vec3 place = scene.place(height, u, side(random));
    add_window(clay, scene, haptics::fields::ball_tool(radius_mm, place), measured);
  }
  return measured;
}

/// A tool of 4 finest voxels' radius touches features of few voxels; larger ones have their level.
/// Usually each tool meets one of the two clays.
void expect_force_within(const std::string& name, double smallest_p95, double p95) {
  for (const Made made : {Made::from_formula, Made::as_imported}) {
    for (const double radius : {4.0, 16.0, 1.3 * 8.0}) {
      const bool is_usual = (made == Made::as_imported) == (radius < 16.0);
      if (!test::effort(is_usual, true)) continue;
      EXPECT_LE(measure(name, radius * kForceVoxel, made).p95(), radius < 5.0 ? smallest_p95 : p95)
          << name << ", a tool of " << radius << " voxels, "
          << (made == Made::as_imported ? "imported" : "from its formula");
    }
  }
}

TEST(WindowForceError, IsNoughtOnAPlane) { expect_force_within("plane", 1e-4, 1e-4); }
TEST(WindowForceError, IsSmallInABall) { expect_force_within("ball", 0.025, 0.02); }
TEST(WindowForceError, IsSmallInATorus) { expect_force_within("torus", 0.02, 0.012); }
TEST(WindowForceError, IsSmallAtAnEdge) { expect_force_within("edge", 0.004, 0.01); }
TEST(WindowForceError, IsSmallOnRoughness) { expect_force_within("rough", 0.005, 0.016); }
TEST(WindowForceError, IsSmallInASlot) { expect_force_within("slot", 0.008, 0.025); }
TEST(WindowForceError, IsSmallOnASheet) { expect_force_within("sheet", 0.015, 0.004); }

/// The greatest error, in voxels, of a window's nodes 2.5 to 9 voxels outside an edge.
double worst_outside_an_edge() {
  constexpr double kRadiusMm = 8.0 * kForceVoxel;
  const ForceScene scene = test::force_scene("edge", kRadiusMm, kForceVoxel);
  const Clay clay = clay_of(scene, Made::as_imported);
  double worst = 0.0;
  for (const double along : {-0.4, 0.0, 0.3}) {
    const Vec3 place = scene.place(6.0 * kForceVoxel, along, 0.0);
    const auto window =
        read_window(clay, {place, kForceVoxel, 6.0 * kForceVoxel, 10.0}, Extension::layers).value();
    const FieldWindowView& view = window.view;
    for (int i = 0; i < view.nodes[0]; ++i) {
      for (int j = 0; j < view.nodes[1]; ++j) {
        for (int k = 0; k < view.nodes[2]; ++k) {
          const Vec3 steps{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
          const double wanted = scene.distance(view.origin_mm + view.voxel_mm * steps);
          if (wanted < 2.5 * kForceVoxel || wanted > 9.0 * kForceVoxel) continue;
          const double off = std::abs(static_cast<double>(view.at(i, j, k)) - wanted);
          worst = std::max(worst, off / kForceVoxel);
        }
      }
    }
  }
  return worst;
}

/// Above an edge all nodes are nearest to a few points of its layer, far to the side of their rays.
TEST(WindowLayers, KnowTheFanAboveAnEdge) { EXPECT_LT(worst_outside_an_edge(), 0.10); }

/// Below a hundredth of a voxel nobody asks. Where all nodes are copies it says too much. Usually
/// each scene has one spacing.
TEST(WindowError, FollowsWhatIsMeasured) {
  int compared = 0;
  for (const std::string name : {"edge", "rough", "slot", "sheet"}) {
    for (const double voxels :
         test::effort<std::vector<double>>({name == "slot" ? 1.3 : 2.6}, {1.3, 1.9, 2.6, 4.0})) {
      const double voxel = voxels * kForceVoxel;
      const Measured measured = measure(name, 4.0 * voxel, Made::as_imported);
      if (measured.distance_error_mm() < 0.01 * voxel) continue;
      ++compared;
      const double ratio = measured.estimate_mm() / measured.distance_error_mm();
      EXPECT_GT(ratio, 1.0 / 2.5) << name << ", nodes every " << voxels << " voxels";
      EXPECT_LT(ratio, 2.5) << name << ", nodes every " << voxels << " voxels";
    }
  }
  EXPECT_GE(compared, test::effort(3, 8));  // of four and of sixteen
}

}  // namespace
}  // namespace argil
