// SPDX-License-Identifier: GPL-3.0-or-later
// What a printer asks of a mesh beyond being sound.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/mesh/check.h"
#include "argil/mesh/printer.h"

#include "support/shapes.h"

namespace argil::mesh {
namespace {

using test::ball_mesh;
using test::box_mesh;
using test::inside_out;
using test::joined;

const MeshProblem* problem_of(const MeshVerdict& verdict, const std::string& kind) {
  const auto found = std::find_if(verdict.problems.begin(), verdict.problems.end(),
                                  [&](const MeshProblem& p) { return p.kind == kind; });
  return found == verdict.problems.end() ? nullptr : &*found;
}

std::int64_t marked(const MeshVerdict& verdict, Mark mark) {
  return std::count(verdict.marks.begin(), verdict.marks.end(), mark);
}

/// A bar of 10 x 10 mm, 20 high, that leans over by an angle from the vertical.
TriangleMesh leaning_bar(double degrees) {
  TriangleMesh bar = box_mesh({10, 10, 20});
  const double lean = std::tan(degrees * std::numbers::pi / 180.0);
  for (Vec3& p : bar.positions) p.x += lean * p.z;
  return bar;
}

MeshVerdict verdict_of(const TriangleMesh& mesh, const Printer& printer,
                       std::int64_t file_bytes = 0) {
  Result<MeshVerdict> verdict = check_print(mesh, printer, file_bytes);
  EXPECT_TRUE(verdict) << verdict.error().message;
  return std::move(verdict).value();
}

Printer printer_with_overhang(double degrees) {
  Printer printer;
  printer.max_overhang_deg = degrees;
  return printer;
}

TEST(CheckPrint, AsksNothingOfWhatIsSound) {
  const MeshVerdict v = verdict_of(box_mesh({10, 20, 30}), {});
  EXPECT_TRUE(v.printable);
  EXPECT_EQ(v.size_mm, (Vec3{10, 20, 30}));
  EXPECT_EQ(v.overhang_mm2, 0.0);
  EXPECT_EQ(marked(v, Mark::none), 12);
}

/// None of its faces lies opposite another.
TEST(CheckPrint, FindsThatATinyPartIsThin) {
  const double a = 0.5 / std::sqrt(8.0);
  TriangleMesh tetrahedron{{{a, a, a}, {a, -a, -a}, {-a, a, -a}, {-a, -a, a}}, {}, {}};
  tetrahedron.triangles = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
  Printer printer;
  EXPECT_TRUE(verdict_of(tetrahedron, printer).printable);
  printer.min_wall_mm = 0.8;
  const MeshVerdict v = verdict_of(tetrahedron, printer);
  EXPECT_FALSE(v.printable);
  EXPECT_NEAR(v.min_wall_mm, 2.0 * a, 1e-12);
  EXPECT_EQ(marked(v, Mark::thin_wall), 4);
  const TriangleMesh with_cavity =
      joined(box_mesh({5, 5, 5}), inside_out(box_mesh({0.3, 0.3, 0.3})));
  EXPECT_TRUE(verdict_of(with_cavity, printer).printable) << "that is air";
  // Beside another it is what can be left off.
  printer.min_part_mm3 = 1.0;
  const MeshVerdict beside =
      verdict_of(joined(box_mesh({5, 5, 5}, {9, 0, 0}), tetrahedron), printer);
  EXPECT_TRUE(beside.printable);
  EXPECT_EQ(beside.small_components, 1);
  EXPECT_EQ(marked(beside, Mark::thin_wall), 0);
}

TEST(CheckPrint, FindsWhatLeansOutTooFar) {
  const Printer printer = printer_with_overhang(45.0);
  EXPECT_EQ(verdict_of(leaning_bar(44.9), printer).overhang_mm2, 0.0);
  const MeshVerdict v = verdict_of(leaning_bar(45.1), printer);
  const double side = 10.0 * 20.0 / std::cos(45.1 * std::numbers::pi / 180.0);
  EXPECT_NEAR(v.overhang_mm2, side, 1e-9 * side);
  EXPECT_TRUE(v.printable) << "supports are the slicer's";
  EXPECT_EQ(marked(v, Mark::overhang), 2);
  ASSERT_NE(problem_of(v, "overhang"), nullptr);
  EXPECT_NEAR(problem_of(v, "overhang")->size_mm, std::sqrt(side), 1e-9);
}

TEST(CheckPrint, CountsWhatStandsOnTheBedAsNoOverhang) {
  const Printer printer = printer_with_overhang(45.0);
  EXPECT_EQ(verdict_of(box_mesh({10, 10, 10}), printer).overhang_mm2, 0.0);
  const TriangleMesh two = joined(box_mesh({10, 10, 10}), box_mesh({4, 4, 4}, {0, 0, 20}));
  const MeshVerdict v = verdict_of(two, printer);
  EXPECT_DOUBLE_EQ(v.overhang_mm2, 16.0);
  EXPECT_EQ(problem_of(v, "overhang")->at_mm.z, 18.0);
}

/// Of a ball what looks down more than the angle is a cap of 2 pi r^2 (1 - sin angle), less what
/// stands on the bed, 2 pi r 0.1.
TEST(CheckPrint, MeasuresTheOverhangOfABall) {
  const MeshVerdict v = verdict_of(ball_mesh(10.0, 6), printer_with_overhang(60.0));
  const double cap =
      std::numbers::pi * (200.0 * (1.0 - std::sin(std::numbers::pi / 3.0)) - 20.0 * 0.1);
  EXPECT_NEAR(v.overhang_mm2, cap, 0.05 * cap);
  EXPECT_EQ(std::count_if(v.problems.begin(), v.problems.end(),
                          [](const MeshProblem& p) { return p.kind == "overhang"; }),
            1);
}

TEST(CheckPrint, FindsWhatACavityTraps) {
  const TriangleMesh shell =
      joined(ball_mesh(10, 3), inside_out(ball_mesh(4, 3, {1.0, 2.0, -1.0})));
  Printer printer;
  const MeshVerdict any = verdict_of(shell, printer);
  EXPECT_TRUE(any.printable);
  EXPECT_EQ(any.cavities, 1);
  EXPECT_EQ(marked(any, Mark::trapped), 0);
  printer.needs_drains = true;
  const MeshVerdict resin = verdict_of(shell, printer);
  EXPECT_FALSE(resin.printable);
  ASSERT_NE(problem_of(resin, "trapped_volume"), nullptr);
  EXPECT_NEAR(length(problem_of(resin, "trapped_volume")->at_mm - Vec3{1.0, 2.0, -1.0}), 0.0,
              1e-12);
  EXPECT_EQ(marked(resin, Mark::trapped), 8 * 64);
}

TEST(CheckPrint, TellsOfCrumbs) {
  Printer printer;
  printer.min_part_mm3 = 1.0;
  const MeshVerdict v =
      verdict_of(joined(ball_mesh(10, 3), ball_mesh(0.4, 1, {20, 0, 0})), printer);
  EXPECT_EQ(v.small_components, 1);
  EXPECT_TRUE(v.printable);
  EXPECT_NEAR(problem_of(v, "crumb")->at_mm.x, 20.0, 1e-12);
  EXPECT_EQ(verdict_of(ball_mesh(0.4, 1), printer).small_components, 0)
      << "the part itself is none";
}

TEST(CheckPrint, TurnsThePartOnItsBed) {
  Printer printer;
  printer.bed_mm = {200, 100, 50};
  EXPECT_TRUE(verdict_of(box_mesh({90, 190, 50}), printer).printable);
  const MeshVerdict wide = verdict_of(box_mesh({110, 190, 50}), printer);
  EXPECT_FALSE(wide.printable);
  EXPECT_DOUBLE_EQ(problem_of(wide, "too_large")->size_mm, 10.0);
  EXPECT_DOUBLE_EQ(problem_of(verdict_of(box_mesh({9, 9, 53}), printer), "too_large")->size_mm,
                   3.0);
}

TEST(CheckPrint, CountsTrianglesAndBytes) {
  Printer printer;
  printer.max_triangles = 12;
  printer.max_file_mb = 2.0;
  EXPECT_TRUE(verdict_of(box_mesh({1, 1, 1}), printer, 2 << 20).printable);
  EXPECT_NE(problem_of(verdict_of(box_mesh({1, 1, 1}), printer, (2 << 20) + 1), "file_too_large"),
            nullptr);
  const MeshVerdict many = verdict_of(ball_mesh(1, 1), printer);
  EXPECT_FALSE(many.printable);
  EXPECT_NE(problem_of(many, "too_many_triangles"), nullptr);
}

TEST(CheckPrint, MarksTheTrianglesThatAreBroken) {
  const MeshVerdict open = verdict_of(test::without(box_mesh({2, 2, 2}), 0), {});
  EXPECT_EQ(marked(open, Mark::broken), 3);
  const MeshVerdict crossing =
      verdict_of(joined(box_mesh({2, 2, 2}), box_mesh({2, 2, 2}, {1.1, 1.3, 0.9})), {});
  EXPECT_GT(marked(crossing, Mark::broken), 4);
  TriangleMesh unusable = box_mesh({1, 1, 1});
  unusable.triangles[5][1] = 77;
  EXPECT_TRUE(verdict_of(unusable, printer_with_overhang(45.0)).marks.empty());
}

TEST(PrintCheck, StopsWhenAsked) {
  double last = 0.0;
  const auto stop_half_way = [&](std::string_view, double fraction) {
    EXPECT_GE(fraction, last);
    last = fraction;
    return fraction < 0.5;
  };
  const auto verdict = check_print(ball_mesh(10, 8), {}, 0, stop_half_way);
  ASSERT_FALSE(verdict);
  EXPECT_EQ(verdict.error().kind, ErrorKind::interrupted);
}

}  // namespace
}  // namespace argil::mesh
