// SPDX-License-Identifier: GPL-3.0-or-later
// Rims that belong together: halves that gape, walls without their rims; and some that do not.
#include "repair/rim_bands.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "argil/mesh/check.h"
#include "argil/mesh/repair.h"

#include "support/shapes.h"

namespace argil::mesh {
namespace {

/// A tube along z without its ends, which looks outward where `is_outward`.
TriangleMesh open_tube(double radius, double low, double high, int sides, bool is_outward) {
  TriangleMesh mesh;
  for (const double z : {low, high}) {
    for (int k = 0; k < sides; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / sides;
      mesh.positions.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
    }
  }
  const auto count = static_cast<std::uint32_t>(sides);
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint32_t next = (k + 1) % count;
    mesh.triangles.push_back({k, next, next + count});
    mesh.triangles.push_back({k, next + count, k + count});
  }
  return is_outward ? mesh : test::inside_out(mesh);
}

MendedMesh mended_mesh(const TriangleMesh& mesh) {
  auto mended = mend_mesh(mesh);
  EXPECT_TRUE(mended);
  return mended ? std::move(mended).value() : MendedMesh{};
}

TEST(RimBands, AWallWithoutRimsBecomesAPipe) {
  const TriangleMesh wall =
      test::joined(open_tube(10.0, 0.0, 30.0, 64, true), open_tube(8.0, 0.0, 30.0, 48, false));
  const MendedMesh mended = mended_mesh(wall);
  EXPECT_TRUE(mended.report.verdict.printable);
  EXPECT_EQ(mended.report.verdict.components, 1);
  EXPECT_EQ(mended.report.closing.holes_closed, 4);
  EXPECT_EQ(mended.report.closing.holes_left, 0);
  const double volume = std::numbers::pi * (100.0 - 64.0) * 30.0;
  EXPECT_NEAR(mended.report.verdict.volume_mm3, volume, 0.02 * volume);
}

/// The two ends of one tube are not joined, however short it is, nor tubes far from each other.
TEST(RimBands, LidsStayOnWhatIsApart) {
  const MendedMesh one = mended_mesh(open_tube(10.0, 0.0, 16.0, 64, true));
  EXPECT_NEAR(one.report.verdict.volume_mm3, std::numbers::pi * 1600.0, 16.0);
  const MendedMesh two = mended_mesh(
      test::joined(open_tube(10.0, 0.0, 20.0, 64, true), open_tube(10.0, 30.0, 50.0, 64, true)));
  EXPECT_TRUE(two.report.verdict.printable);
  EXPECT_EQ(two.report.verdict.components, 2);
}

TEST(RimBands, TubesEndToEndWithAGapAreOne) {
  const MendedMesh two = mended_mesh(
      test::joined(open_tube(10.0, 0.0, 20.0, 64, true), open_tube(10.0, 20.5, 40.0, 40, true)));
  EXPECT_TRUE(two.report.verdict.printable);
  EXPECT_EQ(two.report.verdict.components, 1);
  EXPECT_NEAR(two.report.verdict.volume_mm3, std::numbers::pi * 4000.0, 80.0);
}

}  // namespace
}  // namespace argil::mesh
