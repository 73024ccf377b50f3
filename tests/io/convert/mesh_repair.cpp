// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes broken on purpose, whose right answer is known.
#include "argil/io/mesh_repair.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/io/mesh_file.h"
#include "argil/mesh/rounding.h"

#include "compare/surface_distance.h"
#include "mesh_format/mesh_write.h"
#include "support/effort.h"
#include "support/loose_triangles.h"
#include "support/models.h"
#include "support/scratch.h"
#include "support/shapes.h"

namespace argil::io {
namespace {

using test::ball_mesh;
using test::box_mesh;
using test::joined;
using testing::HasSubstr;

/// In mm, of a ball of 10: what counts as one voxel here.
constexpr double kVoxelMm = 0.1;

double hausdorff_mm(const TriangleMesh& a, const TriangleMesh& b) {
  constexpr double kSlack = 1e-3;
  return std::max(greatest_distance(a, b, kSlack).at_most_mm,
                  greatest_distance(b, a, kSlack).at_most_mm);
}

RepairedMesh repaired(const TriangleMesh& mesh, double voxel_mm = kVoxelMm) {
  auto result = repair_mesh(mesh, {voxel_mm});
  if (!result) {
    ADD_FAILURE() << result.error().message;
    return {};
  }
  EXPECT_TRUE(result.value().report.verdict.printable);
  EXPECT_TRUE(mesh::check_mesh(result.value().mesh).printable);
  return std::move(result).value();
}

/// Repairs `broken`, made from `clean`, and expects all but `touched` triangles as they were.
RepairReport expect_local(const TriangleMesh& broken, const TriangleMesh& clean,
                          std::int64_t touched) {
  const RepairedMesh result = repaired(broken);
  EXPECT_EQ(result.report.path, RepairPath::local);
  EXPECT_LE(hausdorff_mm(result.mesh, clean), kVoxelMm);
  const auto all = static_cast<std::int64_t>(clean.triangles.size());
  EXPECT_GE(result.report.kept_triangles, all - touched);
  return result.report;
}

TriangleMesh clean_ball() { return mesh::rounded_to_float(ball_mesh(10.0, 4)); }

TEST(MeshRepair, LeavesAPrintableMeshAlone) {
  const TriangleMesh ball = clean_ball();
  const RepairedMesh result = repaired(ball);
  EXPECT_EQ(result.report.path, RepairPath::nothing);
  EXPECT_EQ(result.mesh.positions, ball.positions);
  EXPECT_EQ(result.mesh.triangles, ball.triangles);
  EXPECT_EQ(result.report.max_change_mm, 0.0);
}

TEST(MeshRepair, FillsHoles) {
  TriangleMesh broken = clean_ball();
  for (const std::size_t t : {1900, 1200, 700, 699, 698, 3}) {
    broken = test::without(std::move(broken), t);
  }
  const RepairReport report = expect_local(broken, clean_ball(), 6);
  EXPECT_GE(report.closing.holes_closed, 4);
}

TEST(MeshRepair, TurnsFlippedFaces) {
  TriangleMesh broken = clean_ball();
  std::mt19937 random(4);
  for (int n = 0; n < 200; ++n) {
    Triangle& t = broken.triangles[random() % broken.triangles.size()];
    std::swap(t[1], t[2]);
  }
  const RepairedMesh result = repaired(broken);
  EXPECT_EQ(result.mesh.positions.size(), clean_ball().positions.size());
  expect_local(broken, clean_ball(), 200);
}

TEST(MeshRepair, TurnsAWholePartOutward) {
  expect_local(test::inside_out(clean_ball()), clean_ball(), 2048);
}

/// Cubes of 2 mm at whole coordinates, each with its own vertices.
TriangleMesh cubes_at(const std::vector<Vec3>& places) {
  TriangleMesh cubes;
  for (const Vec3& place : places) {
    cubes = test::joined(cubes, test::box_mesh({2.0, 2.0, 2.0}, 2.0 * place));
  }
  return cubes;
}

/// The exact union, whether walls end at the outside or meet each other within.
TEST(MeshRepair, MakesCubesWithFacesInCommonOne) {
  const std::vector<Vec3> grid{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0},
                               {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
  for (const std::size_t count : {2U, 3U, 4U, 8U}) {
    const auto cubes = static_cast<std::int64_t>(count);
    const std::int64_t walls = count == 8 ? 12 : cubes - (count == 4 ? 0 : 1);
    const RepairedMesh result = repaired(cubes_at({grid.begin(), grid.begin() + count}));
    EXPECT_EQ(result.report.path, RepairPath::local) << count << " cubes";
    EXPECT_EQ(result.report.interior_faces, 4 * walls) << count << " cubes";
    EXPECT_EQ(result.report.kept_triangles, 12 * cubes - 4 * walls) << count << " cubes";
    EXPECT_EQ(result.report.verdict.volume_mm3, 8.0 * static_cast<double>(cubes));
    EXPECT_EQ(result.report.verdict.components, 1);
  }
}

/// As programs write it that show both sides: one of each pair is meant.
TEST(MeshRepair, KeepsWhatIsThereBothWaysRound) {
  const TriangleMesh ball = clean_ball();
  const TriangleMesh both = test::joined(ball, test::inside_out(ball));
  EXPECT_EQ(expect_local(both, ball, 0).interior_faces, 0);
  // Nor where one edge of it lies on something else.
  const TriangleMesh cube = cubes_at({{0, 0, 0}});
  const TriangleMesh beside =
      test::joined(test::joined(cube, test::inside_out(cube)), cubes_at({{1, 1, 0}}));
  const RepairReport report = repaired(beside).report;
  EXPECT_EQ(report.interior_faces, 0);
  EXPECT_EQ(report.verdict.components, 2);
}

TEST(MeshRepair, DropsDuplicatedFaces) {
  TriangleMesh broken = clean_ball();
  for (std::size_t t = 0; t < 500; t += 7) broken.triangles.push_back(broken.triangles[t]);
  for (std::size_t t = 700; t < 800; t += 7) {
    const Triangle& c = broken.triangles[t];
    broken.triangles.push_back({c[1], c[0], c[2]});
  }
  EXPECT_EQ(expect_local(broken, clean_ball(), 0).closing.dropped_triangles, 87);
}

/// Triangles that share positions but no vertices, as in an STL of a careless writer, some a little
/// off.
TEST(MeshRepair, JoinsSeams) {
  const TriangleMesh clean = clean_ball();
  TriangleMesh soup;
  std::mt19937 random(5);
  for (const Triangle& t : clean.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    for (const std::uint32_t v : t) {
      Vec3 p = clean.positions[v];
      if (random() % 8 == 0) p.x += 2e-6;
      soup.positions.push_back(p);
    }
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  const RepairedMesh result = repaired(soup);
  EXPECT_EQ(result.report.path, RepairPath::local);
  EXPECT_EQ(result.mesh.triangles.size(), clean.triangles.size());
  EXPECT_LE(hausdorff_mm(result.mesh, clean), 1e-5);
}

/// Every fortieth triangle is split at the middle of one edge, or two, and its neighbour is not.
TEST(MeshRepair, SplitsEdgesAtTJunctions) {
  const TriangleMesh clean = clean_ball();
  TriangleMesh broken = clean;
  std::int64_t junctions = 0;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    broken.positions.push_back((clean.positions[a] + clean.positions[b]) / 2.0);
    ++junctions;
    return static_cast<std::uint32_t>(broken.positions.size() - 1);
  };
  for (std::size_t t = 0; t < clean.triangles.size(); t += 40) {
    const auto [a, b, c] = clean.triangles[t];
    const std::uint32_t ab = middle(a, b);
    if (t % 80 == 0) {
      broken.triangles[t] = {a, ab, c};
      broken.triangles.push_back({ab, b, c});
      continue;
    }
    const std::uint32_t bc = middle(b, c);
    broken.triangles[t] = {a, ab, c};
    broken.triangles.push_back({ab, bc, c});
    broken.triangles.push_back({ab, b, bc});
  }
  const RepairReport report = expect_local(broken, clean, 3 * junctions);
  EXPECT_EQ(report.split_edges, junctions);
  EXPECT_EQ(report.closing.holes_closed, 0);
}

TEST(MeshRepair, UnitesPartsThatCross) {
  const TriangleMesh two = joined(clean_ball(), mesh::rounded_to_float(ball_mesh(6, 4, {9, 1, 2})));
  const RepairedMesh result = repaired(two);
  EXPECT_EQ(result.report.path, RepairPath::local);
  EXPECT_EQ(result.report.united_parts, 1);
  EXPECT_EQ(result.report.verdict.components, 1);
  EXPECT_GT(result.report.kept_triangles, 2 * 2048 / 2);
  // Nothing of the union is farther from the two than rounding.
  EXPECT_LE(result.report.max_change_mm, 2e-6);
  // The lens of two balls, radii R and r at distance d.
  const double d = std::sqrt(86.0);
  const double sum = 16.0 - d;
  const double lens =
      std::numbers::pi * sum * sum *
      (d * d + 2.0 * d * 6.0 - 3.0 * 36.0 + 2.0 * d * 10.0 + 6.0 * 6.0 * 10.0 - 3.0 * 100.0) /
      (12.0 * d);
  const double volume = 4.0 / 3.0 * std::numbers::pi * (1000.0 + 216.0) - lens;
  EXPECT_NEAR(result.report.verdict.volume_mm3, volume, 0.01 * volume);
}

TEST(MeshRepair, DropsAShellInsideAnother) {
  const TriangleMesh outer = clean_ball();
  const RepairedMesh result = repaired(joined(outer, ball_mesh(4, 3, {1, 2, 1})));
  EXPECT_EQ(result.report.path, RepairPath::local);
  EXPECT_EQ(result.mesh.triangles.size(), outer.triangles.size());
  EXPECT_EQ(result.report.kept_triangles, static_cast<std::int64_t>(outer.triangles.size()));
}

TEST(MeshRepair, KeepsACavity) {
  const TriangleMesh shell = joined(clean_ball(), test::inside_out(ball_mesh(4, 3)));
  TriangleMesh broken = test::without(shell, 5);
  const RepairReport report = expect_local(broken, shell, 1);
  EXPECT_EQ(report.verdict.cavities, 1);
}

/// Neighbours that changed places: all around them crosses.
TEST(MeshRepair, RefillsWhatCrossesItself) {
  const TriangleMesh clean = clean_ball();
  TriangleMesh broken = clean;
  for (const std::size_t t : {100U, 900U}) {
    std::swap(broken.positions[clean.triangles[t][0]], broken.positions[clean.triangles[t][1]]);
  }
  ASSERT_GT(mesh::check_mesh(broken).self_intersections, 0);
  const RepairReport report = expect_local(broken, clean, 400);
  EXPECT_GT(report.crossings, 0);
}

TriangleMesh boxes_that_touch(const Vec3& step) {
  TriangleMesh two = joined(box_mesh({10, 10, 10}), box_mesh({10, 10, 10}, 10.0 * step));
  // Weld.
  for (std::uint32_t v = 8; v < 16; ++v) {
    for (std::uint32_t w = 0; w < 8; ++w) {
      if (two.positions[v] != two.positions[w]) continue;
      for (Triangle& t : two.triangles) std::replace(t.begin(), t.end(), v, w);
    }
  }
  return two;
}

TEST(MeshRepair, PartsWhatOnlyTouches) {
  for (const Vec3& step : {Vec3{1, 1, 0}, Vec3{1, 1, 1}}) {
    const TriangleMesh two = boxes_that_touch(step);
    ASSERT_FALSE(mesh::check_mesh(two).manifold);
    const RepairedMesh result = repaired(two);
    EXPECT_EQ(result.report.path, RepairPath::local);
    EXPECT_EQ(result.report.parted_vertices, step.z == 0.0 ? 2 : 1);
    EXPECT_LE(hausdorff_mm(result.mesh, two), 2e-3);
    EXPECT_EQ(result.report.verdict.components, 2);
  }
}

TEST(MeshRepair, DropsFins) {
  const TriangleMesh clean = clean_ball();
  TriangleMesh broken = clean;
  broken.positions.push_back({0, 0, 15});
  broken.positions.push_back({0, 3, 16});
  const auto top = static_cast<std::uint32_t>(clean.positions.size());
  const auto& [a, b, c] = clean.triangles[77];
  broken.triangles.push_back({a, b, top});
  broken.triangles.push_back({b, top + 1, top});
  const RepairReport report = expect_local(broken, clean, 0);
  EXPECT_EQ(report.dropped_fins, 2);
}

/// A tube that runs through its own side.
TEST(MeshRepair, CutsWhatCrossesWhereItDoes) {
  const TriangleMesh knot = mesh::rounded_to_float(test::self_crossing_mesh());
  const std::int64_t crossings = mesh::check_mesh(knot).self_intersections;
  ASSERT_GT(crossings, 100);
  const RepairedMesh result = repaired(knot);
  EXPECT_EQ(result.report.path, RepairPath::local);
  EXPECT_EQ(result.report.crossings, crossings);
  EXPECT_LE(result.report.max_change_mm, 2e-6);
}

/// Needles through one point, all of which cross: what nobody counts is not mended pair by pair.
TEST(MeshRepairSlow, MakesAnewWhatCrossesItselfTooOftenToCount) {
  TriangleMesh needles;
  for (int n = 0; n < 600; ++n) {
    const double turn = 2.399963 * n;  // the golden angle
    const double z = (n + 0.5) / 600.0;
    const Vec3 along{std::sqrt(1.0 - z * z) * std::cos(turn),
                     std::sqrt(1.0 - z * z) * std::sin(turn), z};
    const Vec3 u = normalized(cross(along, Vec3{1.0, 0.3, -0.2}));
    const Vec3 v = cross(along, u);
    TriangleMesh needle = box_mesh({2.0, 2.0, 20.0});
    for (Vec3& p : needle.positions) p = p.x * u + p.y * v + p.z * along;
    needles = joined(needles, needle);
  }
  ASSERT_EQ(mesh::check_mesh(needles).self_intersections, mesh::kMostCrossings);
  const RepairedMesh result = repaired(needles, 0.5);
  EXPECT_EQ(result.report.path, RepairPath::field);
  EXPECT_EQ(result.report.crossings, mesh::kMostCrossings);
  EXPECT_EQ(result.report.united_parts, 0);
  EXPECT_GT(result.report.verdict.volume_mm3, 4.0 / 3.0 * std::numbers::pi * 8.0);
}

/// A tube of 3 mm along a figure eight, coarse enough that taking out what crosses cuts it in two.
TEST(MeshRepair, DoesNotCutATubeThroughItselfInTwo) {
  constexpr std::uint32_t kAlong = 60;
  constexpr std::uint32_t kAround = 12;
  TriangleMesh tube;
  for (std::uint32_t i = 0; i < kAlong; ++i) {
    const double t = 2.0 * std::numbers::pi * i / kAlong;
    const Vec3 along = normalized(Vec3{std::cos(t), std::cos(2.0 * t), 0.0});
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const double around = 2.0 * std::numbers::pi * k / kAround;
      tube.positions.push_back(Vec3{20.0 * std::sin(t), 10.0 * std::sin(2.0 * t), 0.0} +
                               3.0 * std::cos(around) * Vec3{along.y, -along.x, 0.0} +
                               Vec3{0.0, 0.0, 3.0 * std::sin(around)});
      const std::uint32_t next = (i + 1) % kAlong * kAround;
      const std::uint32_t beside = (k + 1) % kAround;
      tube.triangles.push_back({i * kAround + k, next + k, next + beside});
      tube.triangles.push_back({i * kAround + k, next + beside, i * kAround + beside});
    }
  }
  const mesh::MeshVerdict before = mesh::check_mesh(tube);
  ASSERT_GT(before.self_intersections, 0);
  const RepairedMesh result = repaired(tube, test::effort(4.0, 1.0) * kVoxelMm);
  EXPECT_EQ(result.report.verdict.components, 1);
  EXPECT_GT(std::abs(result.report.verdict.volume_mm3), 0.9 * std::abs(before.volume_mm3));
}

TEST(MeshRepair, MakesTheSharedModelsPrintable) {
  for (const char* name : {"stanford-bunny.obj", "spot.obj", "teapot.obj", "cow.obj"}) {
    ARGIL_MODEL_OR_SKIP(file, name);
    const auto mesh = read_mesh(file);
    ASSERT_TRUE(mesh);
    const Vec3 size = bounds(mesh.value()).size();
    const double voxels_along = test::effort(64.0, 128.0);
    const auto result =
        repair_mesh(mesh.value(), {std::max({size.x, size.y, size.z}) / voxels_along});
    ASSERT_TRUE(result) << name << ": " << result.error().message;
    const RepairReport& report = result.value().report;
    EXPECT_TRUE(report.verdict.printable) << name;
    std::printf(
        "%s: way %d, %lld of %zu triangles kept, farthest change %.3g of the largest side\n", name,
        static_cast<int>(report.path), static_cast<long long>(report.kept_triangles),
        mesh.value().triangles.size(), report.max_change_mm / std::max({size.x, size.y, size.z}));
  }
}

/// Each triangle by itself, every corner somewhere within `near_mm` of where it belongs.
TriangleMesh apart(const TriangleMesh& mesh, double near_mm) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> off(-near_mm, near_mm);
  TriangleMesh soup = test::loose_triangles(mesh);
  for (Vec3& p : soup.positions) p += Vec3{off(random), off(random), off(random)};
  return soup;
}

TEST(MeshRepair, JoinsTrianglesWhoseCornersNearlyMeet) {
  const TriangleMesh ball = ball_mesh(20.0, 2);
  for (const double near_mm : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
    const auto repaired = repair_mesh(apart(ball, near_mm));
    ASSERT_TRUE(repaired) << near_mm << ": " << repaired.error().message;
    const RepairReport& report = repaired.value().report;
    EXPECT_EQ(report.path, RepairPath::local) << near_mm;
    EXPECT_TRUE(report.verdict.printable) << near_mm;
    EXPECT_EQ(repaired.value().mesh.triangles.size(), ball.triangles.size()) << near_mm;
    EXPECT_NEAR(report.verdict.volume_mm3, signed_volume(ball), 1e-3 * signed_volume(ball));
  }
}

/// Corners so far apart that nobody can tell which belong together.
TEST(MeshRepair, MakesTheRestAnewThroughTheField) {
  const double voxel_mm = test::effort(4.0, 1.0) * kVoxelMm;
  const RepairedMesh result = repaired(apart(ball_mesh(10.0, 3), 0.5), voxel_mm);
  EXPECT_EQ(result.report.path, RepairPath::field);
  EXPECT_EQ(result.report.voxel_mm, voxel_mm);
  EXPECT_LE(result.report.max_change_mm, 0.5 + voxel_mm);
}

/// Farther apart than a quarter of their edges nobody can tell what belongs together.
TEST(MeshRepair, DoesNotJoinWhatIsApart) {
  TriangleMesh halves = joined(ball_mesh(5.0, 2), ball_mesh(5.0, 2, {10.5, 0.0, 0.0}));
  const auto repaired = repair_mesh(halves);
  ASSERT_TRUE(repaired) << repaired.error().message;
  EXPECT_EQ(repaired.value().report.verdict.components, 2);
  EXPECT_EQ(repaired.value().report.joined_vertices, 0);
}

/// Each part's vertices are numbered by itself: the corner that they share belongs to one of them.
TEST(MeshRepair, OfPartsThatShareACornerReadsNobodyElsesVertices) {
  TriangleMesh mesh = joined(ball_mesh(5.0, 1), ball_mesh(5.0, 3, {20.0, 0.0, 0.0}));
  const auto last = static_cast<std::uint32_t>(mesh.positions.size() - 1);
  for (Triangle& t : mesh.triangles) {
    for (std::uint32_t& v : t) v = v == 0 ? last : v;
  }
  mesh = joined(mesh, ball_mesh(4.0, 2, {3.0, 0.0, 0.0}));
  const auto repaired = repair_mesh(mesh, {.voxel_mm = 0.2});
  ASSERT_TRUE(repaired) << repaired.error().message;
  EXPECT_TRUE(repaired.value().report.verdict.printable);
}

/// Of a fin only the place where it stood is left.
TEST(MeshRepair, SaysWhatIsLostAndWhere) {
  TriangleMesh broken = clean_ball();
  broken.positions.insert(broken.positions.end(), {{0, 0, 15}, {0, 3, 16}});
  const auto top = static_cast<std::uint32_t>(broken.positions.size() - 2);
  const auto [a, b, c] = broken.triangles[77];
  broken.triangles.push_back({a, b, top});
  broken.triangles.push_back({b, top + 1, top});
  const RepairReport fin = repaired(broken).report;
  EXPECT_TRUE(fin.lost_too_much());
  ASSERT_FALSE(fin.loss.places.empty());
  EXPECT_NEAR(length(fin.loss.places.front().at_mm), 15.5, 1.0);
  // Holes, crossings and what lies inside are no loss.
  EXPECT_FALSE(repaired(test::without(clean_ball(), 3)).report.lost_too_much());
  const RepairReport two = repaired(joined(clean_ball(), ball_mesh(6, 4, {9, 1, 2}))).report;
  EXPECT_FALSE(two.lost_too_much());
  EXPECT_EQ(two.loss.share, 0.0);
  EXPECT_GT(two.loss.samples, 0);
}

/// A sheet beside a solid goes, and is named; with a thickness it stays.
TEST(MeshRepair, DropsOrThickensASheetBesideASolid) {
  TriangleMesh both = box_mesh({10, 10, 10});
  const auto first = static_cast<std::uint32_t>(both.positions.size());
  both.positions.insert(both.positions.end(), {{20, 0, 0}, {40, 0, 0}, {40, 20, 0}, {20, 20, 0}});
  both.triangles.push_back({first, first + 1, first + 2});
  both.triangles.push_back({first, first + 2, first + 3});
  const RepairReport dropped = repaired(both).report;
  EXPECT_EQ(dropped.dropped_sheets, 1);
  EXPECT_EQ(dropped.loss.parts, 1);
  EXPECT_TRUE(dropped.lost_too_much());
  RepairOptions options;
  options.thickening.thickness_mm = 2.0;
  const auto kept = repair_mesh(both, options);
  ASSERT_TRUE(kept) << kept.error().message;
  EXPECT_EQ(kept.value().report.thickened_sheets, 1);
  EXPECT_FALSE(kept.value().report.lost_too_much());
  EXPECT_NEAR(kept.value().report.verdict.volume_mm3, 1000.0 + 800.0, 1e-6);
}

TEST(MeshRepair, RefusesWhatHasNoInside) {
  TriangleMesh sheet;
  sheet.positions = {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_THAT(repair_mesh(sheet).error().message, HasSubstr("flat"));
  for (Vec3& p : sheet.positions) p = {p.x, p.y, 0.3 * p.x - 0.7 * p.y};
  EXPECT_THAT(repair_mesh(sheet).error().message, HasSubstr("flat"));
  EXPECT_THAT(repair_mesh({}).error().message, HasSubstr("no triangles"));
  TriangleMesh nan = box_mesh({1, 1, 1});
  nan.positions[0].x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(repair_mesh(nan).error().message, HasSubstr("not finite"));
  EXPECT_THAT(repair_mesh(box_mesh({1, 1, 1}), {-1.0}).error().message, HasSubstr("-1"));
}

TEST(MeshRepair, StopsWhenAsked) {
  const Progress stop = [](std::string_view, double) { return false; };
  const auto result = repair_mesh(test::without(clean_ball(), 3), {}, stop);
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().kind, ErrorKind::interrupted);
}

/// Records of 50 bytes: normal, corners, attribute.
std::multiset<std::string> stl_records(const std::filesystem::path& file) {
  const std::string bytes = test::content_of(file);
  std::multiset<std::string> records;
  for (std::size_t at = 84; at + 50 <= bytes.size(); at += 50) records.insert(bytes.substr(at, 50));
  return records;
}

TEST(MeshRepair, LeavesTheBytesOfUntouchedTriangles) {
  const test::ScratchFolder folder;
  // Away from the origin, since a coordinate of -0 is read as 0.
  const TriangleMesh ball = ball_mesh(10.0, 4, {20.3, 30.1, -40.7});
  ASSERT_TRUE(write_mesh(folder / "broken.stl", test::without(ball, 100)));
  const RepairedMesh result = repaired(read_mesh(folder / "broken.stl").value());
  ASSERT_TRUE(write_mesh(folder / "whole.stl", result.mesh));
  const auto before = stl_records(folder / "broken.stl");
  const auto after = stl_records(folder / "whole.stl");
  EXPECT_EQ(before.size(), 2047U);
  std::vector<std::string> changed;
  std::set_difference(before.begin(), before.end(), after.begin(), after.end(),
                      std::back_inserter(changed));
  EXPECT_EQ(changed.size(), 0U);
}

}  // namespace
}  // namespace argil::io
