// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/mesh/check.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "argil/io/mesh_file.h"

#include "support/measure/self_intersection.h"
#include "support/models.h"
#include "support/shapes.h"

namespace argil::mesh {
namespace {

using test::ball_mesh;
using test::box_mesh;
using test::inside_out;
using test::joined;
using test::torus_mesh;
using test::without;

std::int64_t problems_of(const MeshVerdict& verdict, const std::string& kind) {
  return std::count_if(verdict.problems.begin(), verdict.problems.end(),
                       [&](const MeshProblem& p) { return p.kind == kind; });
}

TEST(CheckMesh, FindsABoxPrintable) {
  const MeshVerdict v = check_mesh(box_mesh({10, 20, 30}));
  EXPECT_TRUE(v.printable && v.closed && v.manifold && v.outward);
  EXPECT_DOUBLE_EQ(v.volume_mm3, 6000.0);
  EXPECT_DOUBLE_EQ(v.area_mm2, 2200.0);
  EXPECT_EQ(v.components, 1);
  EXPECT_EQ(v.euler, 2);
  EXPECT_EQ(v.min_wall_mm, -1.0);
  EXPECT_TRUE(v.problems.empty());
}

TEST(CheckMesh, CountsTheHandleOfATorus) {
  const MeshVerdict v = check_mesh(torus_mesh(20, 5, 40, 24));
  EXPECT_TRUE(v.printable);
  EXPECT_EQ(v.euler, 0);
}

TEST(CheckMesh, PlacesAHole) {
  const MeshVerdict v = check_mesh(without(box_mesh({2, 2, 2}), 0));
  EXPECT_FALSE(v.printable || v.closed);
  EXPECT_TRUE(v.manifold);
  EXPECT_EQ(v.boundary_edges, 3);
  ASSERT_EQ(problems_of(v, "boundary_edge"), 3);
  for (const MeshProblem& p : v.problems) {
    EXPECT_EQ(p.at_mm.z, -1.0);
    EXPECT_GE(p.size_mm, 2.0);
  }
}

TEST(CheckMesh, SeesATriangleTurnedOver) {
  TriangleMesh mesh = box_mesh({2, 2, 2});
  std::swap(mesh.triangles[4][0], mesh.triangles[4][1]);
  const MeshVerdict v = check_mesh(mesh);
  EXPECT_FALSE(v.printable || v.outward);
  EXPECT_TRUE(v.closed && v.manifold);
  EXPECT_EQ(v.misoriented_edges, 3);
}

TEST(CheckMesh, SeesAMeshInsideOut) {
  const MeshVerdict v = check_mesh(inside_out(box_mesh({2, 2, 2})));
  EXPECT_FALSE(v.printable || v.outward);
  EXPECT_TRUE(v.closed && v.manifold);
  EXPECT_EQ(problems_of(v, "inward"), 1);
  EXPECT_DOUBLE_EQ(v.volume_mm3, -8.0);
}

TEST(CheckMesh, TakesACavityButNotAFilledOne) {
  const TriangleMesh outer = box_mesh({10, 10, 10});
  const TriangleMesh inner = box_mesh({4, 4, 4});
  const MeshVerdict cavity = check_mesh(joined(outer, inside_out(inner)));
  EXPECT_TRUE(cavity.printable);
  EXPECT_EQ(cavity.components, 2);
  EXPECT_EQ(cavity.euler, 4);
  EXPECT_FALSE(check_mesh(joined(outer, inner)).outward);
  EXPECT_FALSE(check_mesh(joined(inside_out(outer), inner)).outward);
}

TEST(CheckMesh, TakesSeveralPartsAndRefusesOneInsideOut) {
  const TriangleMesh left = box_mesh({2, 2, 2}, {-5, 0, 0});
  const TriangleMesh right = ball_mesh(1, 2, {5, 0, 0});
  EXPECT_TRUE(check_mesh(joined(left, right)).printable);
  EXPECT_FALSE(check_mesh(joined(inside_out(left), right)).outward);
  EXPECT_FALSE(check_mesh(joined(left, inside_out(right))).outward);
}

/// Two boxes that share an edge or a corner by index.
TriangleMesh touching_boxes(const Vec3& offset) {
  TriangleMesh mesh = joined(box_mesh({1, 1, 1}), box_mesh({1, 1, 1}, offset));
  for (Triangle& t : mesh.triangles) {
    for (std::uint32_t& v : t) {
      const auto first = std::find(mesh.positions.begin(), mesh.positions.end(), mesh.positions[v]);
      v = static_cast<std::uint32_t>(first - mesh.positions.begin());
    }
  }
  return mesh;
}

TEST(CheckMesh, CountsNonManifoldEdgesAndVertices) {
  const MeshVerdict edge = check_mesh(touching_boxes({1, 1, 0}));
  EXPECT_EQ(edge.nonmanifold_edges, 1);
  EXPECT_EQ(edge.nonmanifold_vertices, 0);
  EXPECT_FALSE(edge.manifold || edge.printable);
  const MeshVerdict corner = check_mesh(touching_boxes({1, 1, 1}));
  EXPECT_EQ(corner.nonmanifold_edges, 0);
  EXPECT_EQ(corner.nonmanifold_vertices, 1);
  EXPECT_FALSE(corner.manifold || corner.printable);
  EXPECT_EQ(corner.components, 2);
}

TEST(CheckMesh, CountsCrossingPairsExactly) {
  // One triangle pierces another; they share nothing.
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}, {9, 9, 0}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  const MeshVerdict v = check_mesh(mesh);
  EXPECT_EQ(v.self_intersections, 1);
  ASSERT_EQ(problems_of(v, "self_intersection"), 1);
  mesh.positions[3] = {3, 3, -1};  // now past the long side
  mesh.positions[4] = {3, 3, 1};
  EXPECT_EQ(check_mesh(mesh).self_intersections, 0);
}

TEST(CheckMesh, SeesTwoTrianglesFoldedOntoEachOther) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {4, 0, 0}, {1, 3, 0}, {2, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}};
  EXPECT_EQ(check_mesh(mesh).self_intersections, 1);
  mesh.positions[3].z = 1e-300;  // open by the least bit is open
  EXPECT_EQ(check_mesh(mesh).self_intersections, 0);
}

TEST(CheckMesh, SeesBallsThatOverlapAndCountsThemTheSameEitherWay) {
  const TriangleMesh a = ball_mesh(5, 3);
  const TriangleMesh b = ball_mesh(5, 3, {4, 1, 0.5});
  const MeshVerdict ab = check_mesh(joined(a, b));
  EXPECT_GT(ab.self_intersections, 50);
  EXPECT_EQ(ab.self_intersections, check_mesh(joined(b, a)).self_intersections);
  EXPECT_EQ(problems_of(ab, "self_intersection"),
            std::min<std::int64_t>(100, ab.self_intersections));
}

TEST(CheckMesh, CountsTheSamePairsInALargeMeshAsCgalDoes) {
  // More triangles than are looked at at a time, and large ones that reach through all of them.
  TriangleMesh mesh = joined(ball_mesh(5, 7), ball_mesh(5, 6, {4, 1, 0.5}));
  mesh = joined(mesh, box_mesh({40, 0.5, 0.7}));
  const auto expected = test::find_soup_faults(mesh).crossing_pairs;
  ASSERT_GT(expected, 1000U);
  EXPECT_EQ(check_mesh(mesh).self_intersections, static_cast<std::int64_t>(expected));
}

/// Triangles around the origin, each in a plane of its own: any two cross.
TriangleMesh triangles_through_origin(std::uint32_t count) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double turn = 2.399963 * i;  // the golden angle
    const double z = (2.0 * i + 1.0) / count - 1.0;
    const Vec3 normal{std::sqrt(1.0 - z * z) * std::cos(turn),
                      std::sqrt(1.0 - z * z) * std::sin(turn), z};
    const Vec3 u = normalized(cross(normal, Vec3{1.0, 0.3, -0.2}));
    const Vec3 v = cross(normal, u);
    for (int k = 0; k < 3; ++k) {
      const double angle = turn + 2.0 * std::numbers::pi / 3.0 * k;
      mesh.positions.push_back(10.0 * (std::cos(angle) * u + std::sin(angle) * v));
    }
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

/// As many as pairs of triangles would take gigabytes, and hours of a mesh that has a million.
TEST(CheckMesh, StopsCountingCrossingsAtAMillion) {
  const MeshVerdict v = check_mesh(triangles_through_origin(2000));
  EXPECT_EQ(v.self_intersections, kMostCrossings);
  EXPECT_FALSE(v.printable);
  EXPECT_EQ(problems_of(v, "self_intersection"), 100);
  EXPECT_EQ(check_mesh(triangles_through_origin(2000)).marks, v.marks);
}

TEST(CheckMesh, PassesOverVerticesThatNoTriangleNames) {
  TriangleMesh mesh = joined(box_mesh({10, 10, 10}), box_mesh({5, 5, 5}, {20, 0, 0}));
  mesh.positions.push_back({1000, 1000, 1000});
  const MeshVerdict v = check_mesh(mesh);
  EXPECT_TRUE(v.printable);
  EXPECT_LT(v.size_mm.x, 40.0);
}

TEST(CheckMesh, SaysWhichPartFacesTheWrongWay) {
  const TriangleMesh wrong = inside_out(box_mesh({4, 4, 4}, {20, 0, 0}));
  const TriangleMesh mesh =
      joined(joined(box_mesh({10, 10, 10}), wrong), box_mesh({6, 6, 6}, {40, 0, 0}));
  const MeshVerdict v = check_mesh(mesh);
  EXPECT_FALSE(v.outward);
  ASSERT_EQ(problems_of(v, "inward"), 1);
  const auto found = std::find_if(v.problems.begin(), v.problems.end(),
                                  [](const MeshProblem& p) { return p.kind == "inward"; });
  EXPECT_LT(length(found->at_mm - bounds(wrong).center()), 1e-9);
  EXPECT_NEAR(found->size_mm, length(Vec3{4, 4, 4}), 1e-9);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    EXPECT_EQ(v.marks[t] == Mark::broken, t >= 12 && t < 24) << t;
  }
}

TEST(CheckMesh, CountsDegenerateAndDuplicateTriangles) {
  TriangleMesh mesh = box_mesh({3, 3, 3});
  mesh.triangles.push_back({0, 0, 1});
  mesh.positions.push_back({0, -1.5, -1.5});  // in the middle of an edge
  mesh.triangles.push_back({0, 1, 8});
  mesh.triangles.push_back(mesh.triangles[2]);
  const MeshVerdict v = check_mesh(mesh);
  EXPECT_EQ(v.degenerate, 2);
  EXPECT_EQ(v.duplicate, 1);
  EXPECT_FALSE(v.printable);
}

TEST(CheckMesh, MeasuresTheThinnestWall) {
  const TriangleMesh mesh = box_mesh({10, 20, 0.8});
  const MeshVerdict thick = check_mesh(mesh, 0.5);
  EXPECT_NEAR(thick.min_wall_mm, 0.8, 1e-6);
  EXPECT_TRUE(thick.printable);
  const MeshVerdict thin = check_mesh(mesh, 1.0);
  EXPECT_FALSE(thin.printable);
  EXPECT_EQ(problems_of(thin, "thin_wall"), 4);
}

TEST(CheckMesh, MeasuresTheWallOverACavityNotThroughIt) {
  const TriangleMesh shell = joined(ball_mesh(10, 4), inside_out(ball_mesh(9, 4)));
  const MeshVerdict v = check_mesh(shell, 0.5);
  EXPECT_TRUE(v.printable);
  EXPECT_NEAR(v.min_wall_mm, 1.0, 0.02);
}

TEST(CheckMesh, NeverFindsNothingPrintable) {
  EXPECT_FALSE(check_mesh({}).printable);
  TriangleMesh mesh = box_mesh({1, 1, 1});
  mesh.positions[3].x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(check_mesh(mesh).printable);
  mesh = box_mesh({1, 1, 1});
  mesh.triangles[5][1] = 77;
  EXPECT_FALSE(check_mesh(mesh).printable);
  EXPECT_EQ(problems_of(check_mesh(mesh), "missing_vertex"), 1);
}

TEST(CheckMesh, KeepsAtMostAHundredProblemsOfAKind) {
  TriangleMesh mesh = ball_mesh(10, 4);
  for (std::size_t i = 0; i < 300; ++i) mesh = without(std::move(mesh), i);
  const MeshVerdict v = check_mesh(mesh);
  EXPECT_GT(v.boundary_edges, 100);
  EXPECT_EQ(problems_of(v, "boundary_edge"), 100);
}

TEST(CheckMesh, KnowsTheSharedModels) {
  ARGIL_MODEL_OR_SKIP(spot, "spot.obj");
  const MeshVerdict closed = check_mesh(io::read_mesh(spot).value());
  EXPECT_TRUE(closed.closed && closed.manifold && closed.outward);
  ARGIL_MODEL_OR_SKIP(bunny, "stanford-bunny.obj");
  const MeshVerdict open = check_mesh(io::read_mesh(bunny).value());
  EXPECT_FALSE(open.closed);
  EXPECT_EQ(open.boundary_edges, 223);
  ARGIL_MODEL_OR_SKIP(teapot, "teapot.obj");
  EXPECT_EQ(check_mesh(io::read_mesh(teapot).value()).boundary_edges, 1036);
}

}  // namespace
}  // namespace argil::mesh
