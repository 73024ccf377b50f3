// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/engine/tool_mesh.h"

#include <cmath>

#include <gtest/gtest.h>

#include "argil/engine/clay.h"
#include "argil/engine/pick.h"

namespace argil {
namespace {

TriangleMesh octahedron(double size) {
  TriangleMesh mesh;
  mesh.positions = {{size, 0, 0},  {-size, 0, 0}, {0, size, 0},
                    {0, -size, 0}, {0, 0, size},  {0, 0, -size}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                    {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  return mesh;
}

TEST(ToolMesh, FollowsItsMesh) {
  const auto made = ToolMesh::make(octahedron(7.0));
  ASSERT_TRUE(made.ok()) << made.error().message;
  const double spacing = 2.0 * 3.0 / ToolMesh::kResolution;
  // Within a face the distance is that to its plane, x + y + z = 3.
  for (const Vec3 p : {Vec3{1.2, 1, 1}, Vec3{0.8, 0.9, 0.7}, Vec3{1.5, 1.4, 1.6}}) {
    EXPECT_NEAR(made.value()->distance(p, {3, 3, 3}), (p.x + p.y + p.z - 3.0) / std::sqrt(3.0),
                0.25 * spacing);
  }
  EXPECT_NEAR(made.value()->distance({3, 0, 0}, {3, 3, 3}), 0.0, 0.6 * spacing);
  EXPECT_NEAR(made.value()->distance({9, 0, 0}, {3, 3, 3}), 6.0, 0.6 * spacing);
}

TEST(ToolMesh, StampsAndEngraves) {
  Tool tool;
  tool.shape = Shape::mesh;
  tool.radii_mm = {3, 3, 3};
  tool.mesh = ToolMesh::make(octahedron(1.0)).value();
  for (const Action action : {Action::add, Action::carve}) {
    Clay clay = Clay::block({12, 12, 12}, ClayOptions{.voxel_mm = 0.2}).value();
    tool.action = action;
    Stroke stroke;
    stroke.tool = tool;
    stroke.samples = {{0.0, {6, 0, 0}, {}, 1.0}};
    ASSERT_TRUE(clay.apply(stroke).ok());
    EXPECT_TRUE(clay.validate().empty()) << clay.validate().front();
    const auto surface_x = [&](double y, double z) {
      const auto hit = pick(clay, Ray{{100.0, y, z}, {-1.0, 0.0, 0.0}});
      return hit.ok() && hit.value() ? hit.value()->point_mm.x : std::nan("");
    };
    const double sign = action == Action::add ? 1.0 : -1.0;
    EXPECT_NEAR(surface_x(0.7, 0.7), 6.0 + sign * 1.6, 0.1);
    EXPECT_NEAR(surface_x(4.0, 0.0), 6.0, 0.02);
  }
}

TEST(ToolMesh, RefusesAnOpenOrEmptyMesh) {
  TriangleMesh open = octahedron(1.0);
  open.triangles.pop_back();
  EXPECT_NE(ToolMesh::make(open).error().message.find("open"), std::string::npos);
  EXPECT_FALSE(ToolMesh::make(TriangleMesh{}).ok());
}

}  // namespace
}  // namespace argil
