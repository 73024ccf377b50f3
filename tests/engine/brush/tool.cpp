// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/engine/tool.h"

#include <cmath>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "argil/engine/stroke.h"

namespace argil {
namespace {

double between(std::mt19937& random, double lo, double hi) {
  return lo + (hi - lo) * (static_cast<double>(random()) / 4294967296.0);
}

/// The distance by brute force: the parametrised surface on a fine net, then three finer nets
/// around the best point. An independent method: no equation is solved.
double net_distance(const Vec3& p, const Vec3& r) {
  double best = 1e300;
  double best_u = 0.0;
  double best_v = 0.0;
  double span_u = 3.2;
  double span_v = 1.6;
  for (int pass = 0; pass < 9; ++pass) {
    const double mid_u = best_u;
    const double mid_v = best_v;
    for (int i = -40; i <= 40; ++i) {
      for (int j = -40; j <= 40; ++j) {
        const double u = mid_u + span_u * i / 40.0;
        const double v = mid_v + span_v * j / 40.0;
        const Vec3 q{r.x * std::cos(v) * std::cos(u), r.y * std::cos(v) * std::sin(u),
                     r.z * std::sin(v)};
        const double d = length(p - q);
        if (d < best) {
          best = d;
          best_u = u;
          best_v = v;
        }
      }
    }
    span_u /= 12.0;
    span_v /= 12.0;
  }
  return best;
}

TEST(EllipsoidDistanceProperty, AgreesWithTheClosestPointOfAFineNet) {
  std::mt19937 random(1);
  for (int n = 0; n < 60; ++n) {
    const Vec3 r{between(random, 0.5, 4.0), between(random, 0.5, 4.0), between(random, 0.5, 4.0)};
    const Vec3 p{between(random, -5.0, 5.0), between(random, -5.0, 5.0),
                 between(random, -5.0, 5.0)};
    EXPECT_NEAR(std::abs(ellipsoid_distance(p, r)), net_distance(p, r), 1e-6)
        << "seed 1, sample " << n;
  }
}

TEST(EllipsoidDistance, HasTheSignOfTheImplicitEquation) {
  std::mt19937 random(2);
  for (int n = 0; n < 20000; ++n) {
    const Vec3 r{between(random, 0.2, 4.0), between(random, 0.2, 4.0), between(random, 0.2, 4.0)};
    const Vec3 p{between(random, -5.0, 5.0), between(random, -5.0, 5.0),
                 between(random, -5.0, 5.0)};
    const double f = p.x * p.x / (r.x * r.x) + p.y * p.y / (r.y * r.y) + p.z * p.z / (r.z * r.z);
    if (std::abs(f - 1.0) < 1e-9) continue;
    EXPECT_EQ(ellipsoid_distance(p, r) < 0.0, f < 1.0);
  }
}

TEST(EllipsoidDistance, IsExactAtCentreAxesAndForEqualRadii) {
  EXPECT_NEAR(ellipsoid_distance({0, 0, 0}, {3, 2, 1}), -1.0, 1e-9);
  EXPECT_NEAR(ellipsoid_distance({5, 0, 0}, {3, 2, 1}), 2.0, 1e-9);
  EXPECT_NEAR(ellipsoid_distance({0, 0, -0.25}, {3, 2, 1}), -0.75, 1e-9);
  EXPECT_NEAR(ellipsoid_distance({3, 0, 0}, {3, 2, 1}), 0.0, 1e-9);
  EXPECT_DOUBLE_EQ(ellipsoid_distance({1, 2, 2}, {1.5, 1.5, 1.5}), 1.5);
}

TEST(EllipsoidDistance, NeverChangesFasterThanThePointMoves) {
  std::mt19937 random(3);
  for (int n = 0; n < 20000; ++n) {
    const Vec3 r{between(random, 0.2, 4.0), between(random, 0.2, 4.0), between(random, 0.2, 4.0)};
    const Vec3 p{between(random, -3.0, 3.0), between(random, -3.0, 3.0),
                 between(random, -3.0, 3.0)};
    const Vec3 q = p + Vec3{between(random, -0.01, 0.01), 0.0, between(random, -0.01, 0.01)};
    EXPECT_LE(std::abs(ellipsoid_distance(p, r) - ellipsoid_distance(q, r)),
              length(p - q) * (1.0 + 1e-6) + 1e-8);
  }
}

TEST(ValidateTool, NamesTheFieldThatIsOutOfRange) {
  const auto message = [](const Tool& tool) {
    const auto ok = validate_tool(tool);
    return ok ? std::string("accepted") : ok.error().message;
  };
  Tool tool{Action::add, Shape::ellipsoid, {1, 2, 3}, 1.0};
  EXPECT_EQ(message(tool), "accepted");
  tool.shape = Shape::ball;
  EXPECT_NE(message(tool).find("radii_mm of a ball"), std::string::npos);
  tool = {Action::add, Shape::ellipsoid, {1, 21, 1}, 1.0};
  EXPECT_NE(message(tool).find("20 times"), std::string::npos);
  tool = {Action::carve, Shape::ball, {1, 1, 1}, -0.5};
  EXPECT_NE(message(tool).find("strength is -0.5"), std::string::npos);
  tool.action = Action::inflate;
  EXPECT_EQ(message(tool), "accepted");
}

TEST(ShapeDistance, OfBoxesAndCapsulesIsExact) {
  EXPECT_NEAR(box_distance({4, 6, 0}, {1, 2, 3}), 5.0, 1e-12);
  EXPECT_NEAR(box_distance({0.5, 0, 0}, {1, 2, 3}), -0.5, 1e-12);
  EXPECT_NEAR(capsule_distance({3, 4, 1}, {2, 2, 5}), 3.0, 1e-12);
  EXPECT_NEAR(capsule_distance({0, 3, 7}, {2, 2, 5}), 3.0, 1e-12);
  EXPECT_NEAR(capsule_distance({0, 0, 0}, {2, 2, 5}), -2.0, 1e-12);
}

TEST(ToolShape, RefusesWhatItCannotBe) {
  const auto message = [](const Tool& tool) {
    const Result<void> ok = validate_tool(tool);
    return ok ? std::string("accepted") : ok.error().message;
  };
  EXPECT_NE(message({Action::add, Shape::capsule, {2, 1, 3}, 1.0}).find("capsule"),
            std::string::npos);
  EXPECT_NE(message({Action::smooth, Shape::box, {2, 1, 3}, 1.0}).find("ball or an ellipsoid"),
            std::string::npos);
  EXPECT_NE(message({Action::add, Shape::mesh, {2, 1, 3}, 1.0}).find("no mesh"), std::string::npos);
  Tool tool;
  tool.pressure_to_size = 1.5;
  EXPECT_NE(message(tool).find("pressure_to_size is 1.5"), std::string::npos);
  tool.pressure_to_size = std::nan("");
  EXPECT_NE(message(tool).find("pressure_to_size"), std::string::npos);
  tool.pressure_to_size = 0.0;
  for (const double bad : {-0.01, 1.01, std::nan("")}) {
    tool.sharpness = bad;
    EXPECT_NE(message(tool).find("sharpness is "), std::string::npos) << bad;
  }
  tool.sharpness = 0.0;
  for (const double bad : {0.29, 1.01, std::nan("")}) {
    tool.width = bad;
    EXPECT_NE(message(tool).find("width is "), std::string::npos) << bad;
  }
  tool.width = 0.3;
  EXPECT_TRUE(validate_tool(tool).ok());
  struct Option {
    double Tool::*field;
    const char* name;
    double out_of_range;
  };
  for (const Option& option : {Option{&Tool::plane_offset, "plane_offset", -2.1},
                               Option{&Tool::tip_roundness, "tip_roundness", 0.0},
                               Option{&Tool::volume_preservation, "volume_preservation", 1.1},
                               Option{&Tool::crease_pinch_factor, "crease_pinch_factor", -0.1},
                               Option{&Tool::wavelength_mm, "wavelength_mm", 1001.0}}) {
    const double usual = tool.*option.field;
    for (const double wrong : {option.out_of_range, std::nan("")}) {
      tool.*option.field = wrong;
      EXPECT_NE(message(tool).find(option.name), std::string::npos) << option.name;
    }
    tool.*option.field = usual;
  }
}

TEST(Dabs, FollowTheSpacingAlongThePolylineNotItsSamples) {
  Stroke stroke;
  stroke.tool.radii_mm = {2, 2, 2};
  stroke.spacing = 0.5;  // 1 mm
  stroke.samples = {{0, {0, 0, 0}, {}, 0.0}, {1, {1.5, 0, 0}, {}, 0.5}, {2, {1.5, 3, 0}, {}, 1.0}};
  const std::vector<Dab> dabs = dabs_of(stroke);
  ASSERT_EQ(dabs.size(), 6U);  // the last sweeps what is left of the way
  EXPECT_NEAR(dabs[1].at.position_mm.x, 1.0, 1e-12);
  EXPECT_NEAR(dabs[2].at.position_mm.y, 0.5, 1e-12);
  EXPECT_NEAR(dabs[4].at.position_mm.y, 2.5, 1e-12);
  EXPECT_NEAR(dabs[5].at.position_mm.y, 3.0, 1e-12);
  EXPECT_EQ(dabs[5].from.position_mm, dabs[4].at.position_mm);
  EXPECT_NEAR(dabs[1].at.pressure, 1.0 / 3.0, 1e-12);
  stroke.samples.resize(1);
  EXPECT_EQ(dabs_of(stroke).size(), 1U);
}

TEST(Dabs, AreMirroredInEveryPlaneAskedFor) {
  Stroke stroke;
  stroke.tool.radii_mm = {1, 1, 1};
  stroke.mirror = {true, false, true};
  const Quat turn = normalized(Quat{0.9, 0.1, 0.2, 0.3});
  stroke.samples = {{0, {1, 2, 3}, turn, 1.0}};
  const std::vector<Dab> dabs = dabs_of(stroke);
  ASSERT_EQ(dabs.size(), 4U);
  EXPECT_EQ(dabs[1].at.position_mm, (Vec3{-1, 2, 3}));
  EXPECT_EQ(dabs[3].at.position_mm, (Vec3{-1, 2, -3}));
  // The image of a turned axis is the axis turned by the mirrored pose, up to its sign.
  const Vec3 axis = rotate(turn, {0, 1, 0});
  const Vec3 image = rotate(dabs[1].at.orientation, {0, 1, 0});
  EXPECT_NEAR(image.x, -axis.x, 1e-12);
  EXPECT_NEAR(image.y, axis.y, 1e-12);
  EXPECT_NEAR(image.z, axis.z, 1e-12);
}

}  // namespace
}  // namespace argil
