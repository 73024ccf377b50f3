// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/brush.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "support/alpha_maker.h"

namespace argil::viewer {
namespace {

TEST(Brush, HasAnImageForEachMirrorAndTurn) {
  Brush brush;
  const Vec3 normal = normalized(Vec3{1.0, 0.2, 0.3});
  const SurfaceHit hit{{5.0, 1.0, 2.0}, normal};
  ASSERT_EQ(images_of(hit, brush).size(), 1U);
  EXPECT_EQ(images_of(hit, brush)[0].point_mm, hit.point_mm);
  brush.mirror.z = true;
  brush.radial = {6, 2};
  const std::vector<SurfaceHit> images = images_of(hit, brush);
  ASSERT_EQ(images.size(), 12U);
  for (std::size_t n = 0; n < images.size(); ++n) {
    const Vec3& place = images[n].point_mm;
    EXPECT_NEAR(std::hypot(place.x, place.y), std::hypot(5.0, 1.0), 1e-9);
    EXPECT_NEAR(std::abs(place.z), 2.0, 1e-9);
    EXPECT_NEAR(dot(images[n].normal, place), dot(normal, hit.point_mm), 1e-9);
    for (std::size_t m = 0; m < n; ++m) EXPECT_GT(length(images[m].point_mm - place), 0.1);
  }
}

TEST(Brush, EveryActionMakesAToolThatTheClayTakes) {
  for (const ToolInfo& info : tool_infos()) {
    for (const bool is_inverted : {false, true}) {
      for (const double strength : {0.0, 0.01, 0.5, 1.0}) {
        Brush brush;
        brush.action = info.action;
        brush.is_inverted = is_inverted;
        brush.strength = strength;
        const Tool tool = tool_of(brush_with(brush, {}), 3.0);
        EXPECT_TRUE(validate_tool(tool).ok()) << info.name;
        EXPECT_TRUE(validate_brush(tool, style_of(brush)).ok()) << info.name;
      }
    }
  }
}

TEST(Brush, EveryActionOfTheEngineIsAToolAndOneStampsAndEveryShapeIsTaken) {
  std::set<Action> actions;
  int stamps = 0;
  for (const ToolInfo& info : tool_infos()) {
    actions.insert(info.action);
    stamps += info.is_stamp ? 1 : 0;
    for (const Shape shape :
         {Shape::ball, Shape::ellipsoid, Shape::box, Shape::capsule, Shape::mesh}) {
      for (const double height : {kLeastHeight, 1.0, kMostHeight}) {
        Brush brush;
        choose(brush, info);
        EXPECT_TRUE(is_chosen(brush, info));
        brush.shape = shape;
        brush.height = height;
        // Without its mesh it is a ball; smoothing with Shift has no edges either.
        EXPECT_TRUE(validate_tool(tool_of(brush, 3.0)).ok()) << info.title;
        const Brush smoothing = brush_with(brush, {true, false, false});
        EXPECT_TRUE(validate_tool(tool_of(smoothing, 3.0)).ok()) << info.title;
        EXPECT_FALSE(smoothing.is_stamp);
      }
    }
  }
  EXPECT_EQ(actions.size(), kActionCount);
  EXPECT_EQ(stamps, 1);
}

TEST(Brush, AStampStandsOutByItsStrengthTimesItsHeightAndTurnsAboutTheNormal) {
  TriangleMesh slab;  // 4 x 4 x 2
  for (int corner = 0; corner < 8; ++corner) {
    slab.positions.push_back({(corner & 1) != 0 ? 2.0 : -2.0, (corner & 2) != 0 ? 2.0 : -2.0,
                              (corner & 4) != 0 ? 1.0 : -1.0});
  }
  slab.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  Brush brush;
  brush.action = Action::add;
  brush.is_stamp = true;
  brush.shape = Shape::mesh;
  brush.strength = 0.25;
  brush.turn_deg = 90.0;
  const auto mesh = ToolMesh::make(slab);
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  brush.mesh = mesh.value();
  ASSERT_TRUE(validate_tool(tool_of(brush, 3.0)).ok());
  const SurfaceHit hit{{10.0, 0.0, 0.0}, {1.0, 0.0, 0.0}};
  const StrokeSample sample = sample_at(brush, 3.0, hit, 0.0, 1.0);
  // Half of its height is 1.5, of which a quarter is not sunk.
  EXPECT_NEAR(sample.position_mm.x + 1.5, 10.375, 1e-9);
  EXPECT_NEAR(length(rotate(sample.orientation, {0.0, 0.0, 1.0}) - hit.normal), 0.0, 1e-12);
  brush.turn_deg = 0.0;
  const StrokeSample straight = sample_at(brush, 3.0, hit, 0.0, 1.0);
  const Vec3 turned = rotate(sample.orientation, {1.0, 0.0, 0.0});
  EXPECT_NEAR(length(turned - rotate(straight.orientation, {0.0, 1.0, 0.0})), 0.0, 1e-12);
}

TEST(Brush, GivesItsOptionsToTheTool) {
  Brush brush;
  brush.falloff = Falloff::sphere;
  brush.plane_offset = 0.1;
  brush.tip_roundness = 0.4;
  brush.volume_preservation = 0.6;
  brush.crease_pinch_factor = 0.7;
  brush.wavelength = 0.8;
  brush.seed = 9;
  brush.alpha = test::ramp_image(4);
  brush.alpha_mode = AlphaMode::tiled;
  brush.amplitude = 0.5;
  brush.mid_level = 0.3;
  brush.angle_deg = 20.0;
  brush.use_rake = true;
  brush.tile = 1.5;
  EXPECT_EQ(tool_of(brush, 3.0).alpha, nullptr) << "inflate takes none";
  brush.action = Action::emboss;
  const Tool tool = tool_of(brush, 3.0);
  EXPECT_EQ(tool.falloff, Falloff::sphere);
  ASSERT_TRUE(validate_tool(tool).ok());
  EXPECT_EQ(tool.alpha, brush.alpha);
  EXPECT_EQ(tool.alpha_mode, AlphaMode::tiled);
  EXPECT_EQ(tool.amplitude_mm, 1.5);
  EXPECT_EQ(tool.mid_level, 0.3);
  EXPECT_EQ(tool.angle_deg, 20.0);
  EXPECT_TRUE(tool.use_rake);
  EXPECT_EQ(tool.tile_mm, 4.5);
  EXPECT_EQ(tool.plane_offset, 0.1);
  EXPECT_EQ(tool.tip_roundness, 0.4);
  EXPECT_EQ(tool.volume_preservation, 0.6);
  EXPECT_EQ(tool.crease_pinch_factor, 0.7);
  EXPECT_NEAR(tool.wavelength_mm, 2.4, 1e-12);
  EXPECT_EQ(tool.seed, 9U);
  brush.action = Action::grab;  // takes no such steep one
  EXPECT_EQ(tool_of(brush, 3.0).falloff, Falloff::smooth);
  brush.wavelength = 2.0;
  EXPECT_TRUE(validate_tool(tool_of(brush, kMostRadiusMm)).ok());
}

TEST(Brush, CtrlIsTheOppositeAndShiftSmooths) {
  Brush brush;
  brush.action = Action::add;
  EXPECT_EQ(brush_with(brush, {false, true, false}).action, Action::carve);
  EXPECT_EQ(brush_with(brush, {true, false, false}).action, Action::smooth);
  brush.action = Action::inflate;
  EXPECT_LT(tool_of(brush_with(brush, {false, true, false}), 1.0).strength, 0.0);
  brush.is_inverted = true;  // and twice the opposite is the brush itself
  EXPECT_GT(tool_of(brush_with(brush, {false, true, false}), 1.0).strength, 0.0);
}

TEST(Brush, AnAddedBallStandsOutByItsStrength) {
  Brush brush;
  brush.action = Action::add;
  brush.strength = 0.25;
  const SurfaceHit hit{{10.0, 0.0, 0.0}, {1.0, 0.0, 0.0}};
  const StrokeSample sample = sample_at(brush, 4.0, hit, 0.0, 1.0);
  EXPECT_NEAR(sample.position_mm.x + 4.0, 11.0, 1e-12);  // its top: a quarter radius out
  brush.action = Action::carve;
  EXPECT_NEAR(sample_at(brush, 4.0, hit, 0.0, 1.0).position_mm.x - 4.0, 9.0, 1e-12);
  const Vec3 axis = rotate(sample.orientation, {0.0, 0.0, 1.0});
  EXPECT_NEAR(length(axis - hit.normal), 0.0, 1e-12);
}

}  // namespace
}  // namespace argil::viewer
