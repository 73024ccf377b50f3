// SPDX-License-Identifier: GPL-3.0-or-later
// What a repair says that it guessed.
#include "convert/repair_loss.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "argil/mesh/check.h"
#include "argil/mesh/close.h"
#include "argil/mesh/compact.h"
#include "argil/mesh/rounding.h"
#include "argil/mesh/triangle_geometry.h"

#include "compare/surface_distance.h"
#include "support/shapes.h"

namespace argil::io {
namespace {

const Progress kNobody;

/// What of a ball of 10 is above or below a slanted plane through its middle, whose rim is jagged.
TriangleMesh half_ball(bool is_upper) {
  const TriangleMesh ball = mesh::rounded_to_float(test::ball_mesh(10.0, 4));
  const Vec3 up{0.3, -0.2, 1.0};
  return mesh::only_triangles(ball, [&](std::size_t t) {
    return (dot(mesh::middle(mesh::corners_of(ball, t)), up) > 0.0) == is_upper;
  });
}

/// Two halves so far apart.
TriangleMesh cracked_ball(double gap_mm) {
  TriangleMesh upper = half_ball(true);
  for (Vec3& p : upper.positions) p.z += gap_mm;
  return mesh::rounded_to_float(test::joined(half_ball(false), upper));
}

RepairGuess guess_of_closing(const TriangleMesh& open) {
  const mesh::ClosedMesh closed = mesh::close_mesh(open).value();
  EXPECT_TRUE(closed.report.closed);
  TriangleMesh facing = closed.mesh;
  facing.triangles.resize(closed.given_triangles);
  std::vector<bool> is_given(closed.mesh.triangles.size(), false);
  std::fill_n(is_given.begin(), closed.given_triangles, true);
  return measure_guess(facing, closed.mesh, is_given, 0.1, true, Pace(kNobody, ""));
}

/// A box without one of its sides, at z = 0.
TriangleMesh open_box(bool is_upper) {
  const double middle = is_upper ? 5.0 : -5.0;
  const TriangleMesh box = test::box_mesh({10, 10, 10}, {0, 0, middle});
  return mesh::only_triangles(box, [&](std::size_t t) {
    const mesh::Corners corners = mesh::corners_of(box, t);
    return mesh::middle(corners).z != 0.0;
  });
}

TEST(RepairGuess, ALidOnAnOpenBoxIsNone) {
  EXPECT_TRUE(guess_of_closing(open_box(true)).places.empty());
  EXPECT_TRUE(guess_of_closing(half_ball(true)).share < 0.01);
}

TEST(RepairGuess, LidsBetweenTwoHalvesAreAndHavePlaces) {
  TriangleMesh upper = open_box(true);
  for (Vec3& p : upper.positions) p.z += 0.5;
  const RepairGuess guess = guess_of_closing(test::joined(open_box(false), upper));
  EXPECT_GT(guess.share, 0.1);
  ASSERT_FALSE(guess.places.empty());
  EXPECT_LE(guess.places.size(), 10U);
  EXPECT_NEAR(guess.places.front().distance_mm, 5.0, 0.3);
  EXPECT_LE(length(guess.places.front().at_mm), 1.0);
}

/// No wall stays between the halves.
TEST(RepairGuess, ACrackedBallBecomesOneBall) {
  const auto repaired = repair_mesh(cracked_ball(0.08));
  ASSERT_TRUE(repaired) << repaired.error().message;
  const RepairReport& report = repaired.value().report;
  EXPECT_TRUE(report.verdict.printable);
  EXPECT_EQ(report.verdict.components, 1);
  EXPECT_FALSE(report.lost_too_much() || report.guessed_too_much());
  const TriangleMesh ball = test::ball_mesh(10.0, 4);
  EXPECT_LE(greatest_distance(repaired.value().mesh, ball, 1e-3).at_most_mm, 0.1);
  EXPECT_LE(greatest_distance(ball, repaired.value().mesh, 1e-3).at_most_mm, 0.1);
}

/// One triangle of a surface that is far away everywhere: nothing of it is found by blocks.
TEST(RepairGuess, HearsThatItShallStopAmongFewLargeTriangles) {
  int asked = 0;
  const Progress stop = [&](std::string_view, double) { return ++asked < 3; };
  const TriangleMesh large = test::box_mesh({1e4, 1e4, 1e4});
  const std::vector<bool> is_given(large.triangles.size(), false);
  EXPECT_THROW(measure_guess(half_ball(true), large, is_given, 0.1, true, Pace(stop, "")),
               Interrupted);
}

}  // namespace
}  // namespace argil::io
