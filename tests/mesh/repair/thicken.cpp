// SPDX-License-Identifier: GPL-3.0-or-later
// Open sheets of known shape that are given a thickness.
#include "repair/thicken.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/mesh/repair.h"

#include "support/shapes.h"

namespace argil::mesh {
namespace {

/// n by n squares from 0 to `side` in x and y, at the height of `height(x, y)`.
template <class Height>
TriangleMesh sheet(double side, std::uint32_t n, const Height& height) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i <= n; ++i) {
    for (std::uint32_t j = 0; j <= n; ++j) {
      const double x = side * i / n;
      const double y = side * j / n;
      mesh.positions.push_back({x, y, height(x, y)});
    }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t v = i * (n + 1) + j;
      mesh.triangles.push_back({v, v + n + 1, v + n + 2});
      mesh.triangles.push_back({v, v + n + 2, v + 1});
    }
  }
  return mesh;
}

MendedMesh thickened(const TriangleMesh& mesh, const Thickening& how) {
  auto result = mend_mesh(mesh, how);
  if (!result) {
    ADD_FAILURE() << result.error().message;
    return {};
  }
  EXPECT_TRUE(result.value().report.verdict.printable);
  return std::move(result).value();
}

TEST(ThickenedSheets, AFlatOneBecomesAPlate) {
  const TriangleMesh flat = sheet(20.0, 4, [](double, double) { return 0.0; });
  const MendedMesh plate = thickened(flat, {.thickness_mm = 2.0});
  EXPECT_EQ(plate.report.thickened_sheets, 1);
  EXPECT_EQ(plate.report.verdict.volume_mm3, 800.0);
  EXPECT_EQ(plate.report.verdict.size_mm, (Vec3{20.0, 20.0, 2.0}));
  const MendedMesh below = thickened(flat, {.thickness_mm = 2.0, .inward = true});
  double highest = -10.0;
  for (const Vec3& p : below.mesh.positions) highest = std::max(highest, p.z);
  EXPECT_EQ(highest, 0.0);
}

TEST(ThickenedSheets, RoundRimsAreHalfCircles) {
  const TriangleMesh flat = sheet(20.0, 4, [](double, double) { return 0.0; });
  const MendedMesh plate = thickened(flat, {.thickness_mm = 2.0, .rim = SheetRim::round});
  EXPECT_NEAR(plate.report.verdict.size_mm.x, 22.0, 0.6);  // corners go askew
  const double octagons = 8.0 * std::sin(std::numbers::pi / 8.0) / std::numbers::pi;
  const double rims = 80.0 * 0.5 * std::numbers::pi * octagons;
  EXPECT_NEAR(plate.report.verdict.volume_mm3, 800.0 + rims, 0.1 * rims);
}

TEST(ThickenedSheets, AreAsThickAsAskedAlongAFold) {
  // Two squares at a right angle, and at a sharp one.
  for (const double slope : {0.0, 0.5, 1.0, 2.0}) {
    SCOPED_TRACE(slope);
    const TriangleMesh folded =
        sheet(20.0, 8, [&](double x, double) { return slope * std::abs(x - 10.0); });
    const MendedMesh plate = thickened(folded, {.thickness_mm = 1.0});
    const double area = 400.0 * std::sqrt(1.0 + slope * slope);
    EXPECT_NEAR(plate.report.verdict.volume_mm3, area, 0.03 * area);
  }
}

TEST(ThickenedSheets, ABowlBecomesAShell) {
  const TriangleMesh bowl = test::cut_above(test::ball_mesh(10.0, 5), 0.0);
  const MendedMesh shell = thickened(bowl, {.thickness_mm = 1.0});
  EXPECT_EQ(shell.report.thickened_sheets, 1);
  const double exact = 2.0 / 3.0 * std::numbers::pi * (std::pow(10.5, 3) - std::pow(9.5, 3));
  EXPECT_NEAR(shell.report.verdict.volume_mm3, exact, 0.01 * exact);
  const MendedMesh inner = thickened(bowl, {.thickness_mm = 1.0, .inward = true});
  const double within = 2.0 / 3.0 * std::numbers::pi * (std::pow(10.0, 3) - std::pow(9.0, 3));
  EXPECT_NEAR(inner.report.verdict.volume_mm3, within, 0.01 * within);
}

TEST(ThickenedSheets, BodiesWithHolesAreClosedInstead) {
  const TriangleMesh open = test::cut_above(test::ball_mesh(10.0, 5), -8.0);
  const MendedMesh ball = thickened(open, {.thickness_mm = 1.0});
  EXPECT_EQ(ball.report.thickened_sheets, 0);
  EXPECT_GT(ball.report.verdict.volume_mm3, 3000.0);
}

/// Thicker than it bends: the inner side folds through itself and is cut off where it does.
TEST(ThickenedSheets, MayBeThickerThanTheyBend) {
  const TriangleMesh wave =
      sheet(30.0, 60, [](double x, double) { return 2.0 * std::sin(0.9 * x); });
  const MendedMesh plate = thickened(wave, {.thickness_mm = 4.0});
  EXPECT_EQ(plate.report.verdict.components, 1);
  EXPECT_GT(plate.report.verdict.volume_mm3, 30.0 * 30.0 * 4.0);
}

TEST(ThickenedSheets, WithoutANumberThatIsNone) {
  EXPECT_THAT(mend_mesh(test::box_mesh({1, 1, 1}), {.thickness_mm = -1.0}).error().message,
              testing::HasSubstr("thickness"));
}

}  // namespace
}  // namespace argil::mesh
