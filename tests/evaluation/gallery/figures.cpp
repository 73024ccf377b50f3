// SPDX-License-Identifier: GPL-3.0-or-later
// The figures of the gallery on meshes whose figures are known.
#include "gallery/figures.h"

#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "measure/ripple.h"

namespace argil::test {
namespace {

using evaluation::Body;
using evaluation::figures_of;
using evaluation::Plate;
using evaluation::work_place;

constexpr double kBall = evaluation::kGalleryBall;
constexpr double kTool = evaluation::kGalleryTool;
constexpr double kVoxel = evaluation::kGalleryVoxel;

/// A point of a section through a surface that was turned about an axis.
struct SectionPoint {
  double along;   // the axis
  double across;  // 0 at both ends
};

/// The closed surface that a section makes when it is turned, outward where the section begins at
/// the far end of the axis. `shift`: what is added to a point of it by its place in the section and
/// the turn, out of the origin.
TriangleMesh turned_mesh(
    const Vec3& axis, const std::vector<SectionPoint>& section, int around,
    const std::function<double(std::size_t, double)>& shift = [](std::size_t, double) {
      return 0.0;
    }) {
  const Vec3 u = normalized(cross(axis, Vec3{0.3, 0.2, 0.9}));
  const Vec3 v = cross(axis, u);
  TriangleMesh mesh;
  const auto add = [&](std::size_t i, double turn) {
    const Vec3 out = std::cos(turn) * u + std::sin(turn) * v;
    const Vec3 at = section[i].along * axis + section[i].across * out;
    mesh.positions.push_back(at + shift(i, turn) * normalized(at));
  };
  const auto rings = static_cast<int>(section.size()) - 2;
  add(0, 0.0);
  for (int i = 1; i <= rings; ++i) {
    for (int k = 0; k < around; ++k) {
      add(static_cast<std::size_t>(i), 2.0 * std::numbers::pi * k / around);
    }
  }
  add(section.size() - 1, 0.0);
  const auto id = [&](int i, int k) {
    return static_cast<std::uint32_t>(1 + (i - 1) * around + k % around);
  };
  const auto last = static_cast<std::uint32_t>(mesh.positions.size() - 1);
  for (int k = 0; k < around; ++k) {
    mesh.triangles.push_back({0, id(1, k), id(1, k + 1)});
    mesh.triangles.push_back({last, id(rings, k + 1), id(rings, k)});
    for (int i = 1; i < rings; ++i) {
      mesh.triangles.push_back({id(i, k), id(i + 1, k), id(i + 1, k + 1)});
      mesh.triangles.push_back({id(i, k), id(i + 1, k + 1), id(i, k + 1)});
    }
  }
  return mesh;
}

/// A section by its distance from the origin at an angle from the axis, closest at `fine`.
std::vector<SectionPoint> polar_section(double fine, int rings,
                                        const std::function<double(double)>& radius) {
  std::vector<SectionPoint> section;
  for (int i = 0; i <= 2 * rings; ++i) {
    const double part = std::pow(std::abs(i - rings) / static_cast<double>(rings), 2.0);
    const double angle = i <= rings ? fine * (1.0 - part) : fine + (std::numbers::pi - fine) * part;
    section.push_back({radius(angle) * std::cos(angle), radius(angle) * std::sin(angle)});
  }
  return section;
}

TriangleMesh plain_ball(double radius) {
  return turned_mesh(work_place().out, polar_section(0.2, 150, [=](double) { return radius; }),
                     400);
}

Plate plate_with(Action action) {
  for (Plate& plate : evaluation::all_plates()) {
    if (plate.action == action) return std::move(plate);
  }
  ADD_FAILURE() << "no plate";
  return {};
}

std::map<std::string, double> values_of(Action action, const TriangleMesh& mesh) {
  std::map<std::string, double> values;
  for (const auto& figure : figures_of(plate_with(action), plain_ball(kBall), mesh)) {
    values[figure.name] = figure.value;
  }
  return values;
}

TEST(GalleryPlates, AreThereForEveryAction) {
  const auto plates = evaluation::all_plates();
  ASSERT_EQ(plates.size(), kActionCount);
  for (std::size_t n = 0; n < kActionCount; ++n) {
    EXPECT_EQ(plates[n].action, kActionInfos[n].action);
    for (const auto& each : plates[n].strokes) {
      EXPECT_TRUE(validate_stroke(each.stroke).ok()) << kActionInfos[n].name;
    }
    // Blender either does it or it is said why not.
    const bool has_brush = !plates[n].strokes[0].brush.name.empty() || !plates[n].boolean.empty();
    EXPECT_NE(has_brush, !plates[n].no_counterpart.empty()) << kActionInfos[n].name;
  }
}

TEST(GalleryFigures, TellHowFarAndHowMuchABallGrew) {
  auto values = values_of(Action::inflate, plain_ball(kBall + 0.5));
  EXPECT_NEAR(values["out"], 0.5, 1e-4);
  EXPECT_EQ(values["in"], 0.0);
  const double volume =
      4.0 / 3.0 * std::numbers::pi * (std::pow(kBall + 0.5, 3.0) - std::pow(kBall, 3.0));
  EXPECT_NEAR(values["volume"], volume, 0.01 * volume);
  EXPECT_LT(values["ripples, rms"], 0.003);
  EXPECT_NEAR(evaluation::reach_of(Body::ball, plain_ball(kBall - 0.25)).farthest_mm(), 0.25, 1e-4);
}

/// A bowl cut out of the ball to the last digit, and the same with a rim that waves about its
/// circle.
TEST(GalleryFigures, MeasureTheSawOfARim) {
  constexpr int kRings = 120;
  // Both surfaces meet where the tool's angle from its own far end is that, and the ball's this.
  const double of_tool = std::acos(kTool / (2.0 * kBall));
  const double of_ball = std::acos(1.0 - kTool * kTool / (2.0 * kBall * kBall));
  std::vector<SectionPoint> section;
  for (int i = 0; i < kRings; ++i) {
    const double angle = of_tool * (1.0 - std::pow(1.0 - i / static_cast<double>(kRings), 2.0));
    section.push_back({kBall - kTool * std::cos(angle), kTool * std::sin(angle)});
  }
  const std::size_t rim = section.size();
  for (int i = 0; i <= kRings; ++i) {
    const double part = std::pow(i / static_cast<double>(kRings), 2.0);
    const double angle = of_ball + (std::numbers::pi - of_ball) * part;
    section.push_back({kBall * std::cos(angle), kBall * std::sin(angle)});
  }
  const auto cut = [&](double wave_mm) {
    return turned_mesh(work_place().out, section, 800, [=](std::size_t i, double turn) {
      return i == rim ? wave_mm * (1.0 + std::cos(9.0 * turn)) : 0.0;
    });
  };
  auto even = values_of(Action::carve, cut(0.0));
  EXPECT_LT(even["saw of the rim, rms"], 0.002);
  EXPECT_LT(even["rim off its circle"], 0.002);
  EXPECT_LT(even["surface near it, rms"], 0.005);
  // It waves out of the ball, and counts along the bisector of the normals of ball and bowl. At the
  // rim the triangle of both centres has two sides as long as the ball's radius.
  const double between = std::numbers::pi - of_tool;
  const double counted = 0.05 * std::cos(0.5 * between) / std::sqrt(2.0) / kVoxel;
  auto waved = values_of(Action::carve, cut(0.05));
  EXPECT_NEAR(waved["saw of the rim, rms"], counted, 0.01 * counted);
}

TEST(GalleryFigures, KnowAVByItsDepthWidthAndPoint) {
  constexpr double kDepth = 1.0;
  constexpr double kHalfWidth = 1.5;  // so it is 1.5 wide at half its depth
  const auto groove = [&](double side) {
    const auto radius = [=](double angle) {
      const double beside = std::abs(kBall * std::cos(angle)) / kHalfWidth;
      return kBall - side * kDepth * std::max(0.0, 1.0 - beside);
    };
    return turned_mesh(work_place().north, polar_section(0.5 * std::numbers::pi, 400, radius), 400);
  };
  for (const auto& [action, name, side] :
       {std::tuple{Action::crease, "depth", 1.0}, {Action::ridge, "height", -1.0}}) {
    auto values = values_of(action, groove(side));
    EXPECT_NEAR(values[name], kDepth, 0.01) << name;
    EXPECT_NEAR(values["that over width"], kDepth / kHalfWidth, 0.05) << name;
    // The width is counted in tenths of a mm.
    EXPECT_NEAR(values["sharpness (V: 1)"], 1.0, 0.15) << name;
    EXPECT_LT(values["along the line, rms"], 0.003) << name;
  }
}

TEST(GalleryFigures, KnowAPlaneFromABallAndWhatAMaskHeld) {
  auto ball = values_of(Action::trim, plain_ball(kBall));
  EXPECT_NEAR(ball["from a plane, rms"], ball["from a plane, before"], 1e-12);
  // Of a cap of radius a the height over its rim has the rms a^2 / (2 R sqrt 12) about its mean.
  const double a = 0.4 * kTool;
  EXPECT_NEAR(ball["from a plane, rms"], a * a / (2.0 * kBall * std::sqrt(12.0)), 0.002);
  const auto cut = polar_section(0.2, 150, [](double angle) {
    return std::min(kBall, 0.99 * kBall / std::max(0.1, std::cos(angle)));
  });
  const TriangleMesh flat = turned_mesh(work_place().out, cut, 400);
  EXPECT_LT(values_of(Action::trim, flat)["from a plane, rms"], 1e-6);
  EXPECT_NEAR(values_of(Action::mask, plain_ball(kBall + 0.1))["masked moved"], 0.1, 1e-4);
}

TEST(RippleRms, IsAWavesOwnWhereItIsShortAndNothingWhereItIsLong) {
  constexpr double kHeight = 0.02;
  const auto sheet = [&](double wavelength, int per_mm) {
    TriangleMesh mesh;
    const int side = 10 * per_mm;
    for (int i = 0; i <= side; ++i) {
      for (int j = 0; j <= side; ++j) {
        const double x = static_cast<double>(i) / per_mm;
        mesh.positions.push_back({x, static_cast<double>(j) / per_mm,
                                  kHeight * std::sin(2.0 * std::numbers::pi * x / wavelength)});
      }
    }
    const auto id = [&](int i, int j) { return static_cast<std::uint32_t>(i * (side + 1) + j); };
    for (int i = 0; i < side; ++i) {
      for (int j = 0; j < side; ++j) {
        mesh.triangles.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
        mesh.triangles.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
      }
    }
    return mesh;
  };
  const auto inside = [](const Vec3& p) {
    return p.x > 2.0 && p.x < 8.0 && p.y > 2.0 && p.y < 8.0;
  };
  const double own = kHeight / std::sqrt(2.0);
  EXPECT_NEAR(evaluation::ripple_rms(sheet(0.5, 20), 1.0, inside), own, 0.15 * own);
  // However many triangles there are.
  EXPECT_NEAR(evaluation::ripple_rms(sheet(0.5, 40), 1.0, inside), own, 0.15 * own);
  EXPECT_LT(evaluation::ripple_rms(sheet(10.0, 20), 1.0, inside), 0.02 * own);
  EXPECT_EQ(evaluation::ripple_rms(sheet(0.5, 20), 1.0, [](const Vec3&) { return false; }), 0.0);
}

}  // namespace
}  // namespace argil::test
