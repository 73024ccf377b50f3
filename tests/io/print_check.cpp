// SPDX-License-Identifier: GPL-3.0-or-later
// What a printer asks of a mesh beyond being sound.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/io/mesh_check.h"
#include "argil/io/mesh_file.h"
#include "argil/io/printer.h"

#include "support/scratch.h"
#include "support/shapes.h"

namespace argil::io {
namespace {

using test::ball_mesh;
using test::box_mesh;
using test::inside_out;
using test::joined;
using testing::HasSubstr;

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
  EXPECT_EQ(v.crumbs, 1);
  EXPECT_TRUE(v.printable);
  EXPECT_NEAR(problem_of(v, "crumb")->at_mm.x, 20.0, 1e-12);
  EXPECT_EQ(verdict_of(ball_mesh(0.4, 1), printer).crumbs, 0) << "the part itself is none";
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

class PrinterFile : public testing::Test {
 protected:
  std::string refusal(const std::string& text) {
    test::fill(folder_ / "p.json", text);
    const auto read = read_printer(folder_ / "p.json");
    return read ? "accepted" : read.error().message;
  }
  test::ScratchFolder folder_;
};

TEST_F(PrinterFile, OfTheThreeGenericPrintersAreRead) {
  const auto printers = std::filesystem::path("printers");
  const Printer filament = read_printer(printers / "filament.json").value();
  EXPECT_EQ(filament.name, "filament");
  EXPECT_EQ(filament.max_overhang_deg, 50.0);
  EXPECT_FALSE(filament.needs_drains);
  EXPECT_TRUE(read_printer(printers / "resin.json").value().needs_drains);
  const Printer service = read_printer(printers / "service.json").value();
  EXPECT_EQ(service.max_triangles, 1'000'000);
  EXPECT_EQ(service.max_file_mb, 64.0);
}

TEST_F(PrinterFile, IsRefusedWithTheKeyAndTheRange) {
  EXPECT_THAT(refusal("{"), HasSubstr("not JSON"));
  EXPECT_THAT(refusal("{\"name\":\"a\"}"), HasSubstr("argil_printer"));
  const std::string deep = std::string(200'000, '[') + std::string(200'000, ']');
  EXPECT_THAT(refusal("{\"argil_printer\":" + deep + "}"), HasSubstr("nests more than 64 deep"));
  EXPECT_THAT(refusal("{\"argil_printer\":2,\"name\":\"a\"}"), HasSubstr("is 2; must be 1"));
  const auto with = [&](const std::string& rest) {
    return refusal("{\"argil_printer\":1,\"name\":\"a\"," + rest + "}");
  };
  EXPECT_THAT(with("\"bed\":[1,2,3]"), HasSubstr("did you mean 'bed_mm'"));
  EXPECT_THAT(with("\"bed_mm\":[1,2,0]"), HasSubstr("greater than 0"));
  EXPECT_THAT(with("\"min_wall_mm\":-1"), HasSubstr("is -1; must be"));
  EXPECT_THAT(with("\"max_overhang_deg\":90"), HasSubstr("below 90"));
  EXPECT_THAT(with("\"needs_drains\":1"), HasSubstr("true or false"));
  EXPECT_THAT(with("\"max_triangles\":1e300"), HasSubstr("must be"));
  EXPECT_EQ(with("\"max_file_mb\":0"), "accepted");
  EXPECT_FALSE(read_printer(folder_ / "gone.json").ok());
}

/// The colors are read by others; here the bytes: 15 for a vertex.
TEST(MeshFileColors, StandBesideTheVerticesOfAPly) {
  const test::ScratchFolder folder;
  const TriangleMesh box = box_mesh({1, 2, 3});
  WriteOptions options;
  options.colors.assign(box.positions.size(), {10, 20, 30});
  options.colors[2] = {200, 100, 50};
  ASSERT_TRUE(write_mesh(folder / "box.ply", box, options));
  const std::string bytes = test::content_of(folder / "box.ply");
  const std::string end = "end_header\n";
  const std::size_t body = bytes.find(end) + end.size();
  EXPECT_THAT(bytes.substr(0, body), HasSubstr("property uchar blue\nelement face"));
  const std::size_t third = body + 2 * 15 + 12;
  EXPECT_EQ(bytes.substr(third, 3), std::string("\xc8\x64\x32"));
  EXPECT_EQ(read_mesh(folder / "box.ply").value().positions, box.positions);
  options.colors.pop_back();
  const auto refused = write_mesh(folder / "box.ply", box, options);
  ASSERT_FALSE(refused.ok());
  EXPECT_THAT(refused.error().message, HasSubstr("7 colors for 8 vertices"));
  EXPECT_EQ(test::content_of(folder / "box.ply"), bytes);
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
}  // namespace argil::io
