// SPDX-License-Identifier: GPL-3.0-or-later
// What small pictures are drawn from.
#include "document/picture_shot.h"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "picture/piece_frame.h"
#include "settings/thumbnail.h"
#include "support/bumpy_clay.h"

namespace argil::viewer {
namespace {

/// Two balls, 40 mm apart along x, of which the second is red and turned.
Sculpture two_balls() {
  std::vector<Sculpture::ReadyPiece> pieces;
  pieces.push_back({{.name = "Left"}, Clay::ball(10.0, {}).value()});
  PieceLook look{.name = "Right"};
  look.placement.position_mm = {40.0, 0.0, 0.0};
  look.placement.orientation = {std::numbers::sqrt2 / 2.0, 0.0, std::numbers::sqrt2 / 2.0, 0.0};
  look.color = Rgb8{200, 0, 0};
  pieces.push_back({look, Clay::ball(5.0, {}).value()});
  return Sculpture::of(std::move(pieces), 0).value();
}

void hide(Sculpture& sculpture, const char* name) {
  ChangePiece change{name};
  change.is_visible = false;
  ASSERT_TRUE(sculpture.apply(change).ok());
}

TEST(PictureShots, HaveAllVisiblePiecesWhereTheyStandInTheirColours) {
  Sculpture sculpture = two_balls();
  const auto shot = shoot(sculpture, {});
  ASSERT_TRUE(shot);
  const Box3 box = bounds(shot->mesh);
  EXPECT_NEAR(box.min.x, -10.0, 0.1);
  EXPECT_NEAR(box.max.x, 45.0, 0.1);
  ASSERT_EQ(shot->colors.size(), shot->mesh.triangles.size());
  ASSERT_EQ(shot->mesh.normals.size(), shot->mesh.positions.size());
  for (std::size_t n = 0; n < shot->mesh.triangles.size(); ++n) {
    const Vec3& corner = shot->mesh.positions[shot->mesh.triangles[n][0]];
    const Vec3& normal = shot->mesh.normals[shot->mesh.triangles[n][0]];
    const bool is_right = corner.x > 20.0;
    EXPECT_EQ(shot->colors[n], is_right ? linear_of(Rgb8{200, 0, 0}) : kClayColor);
    const Vec3 middle = is_right ? Vec3{40.0, 0.0, 0.0} : Vec3{};
    ASSERT_GT(dot(normalized(corner - middle), normal), 0.98);
  }
  hide(sculpture, "Right");
  const auto left_alone = shoot(sculpture, {});
  ASSERT_TRUE(left_alone);
  EXPECT_LT(bounds(left_alone->mesh).max.x, 11.0);
  EXPECT_TRUE(left_alone->colors.empty());
  hide(sculpture, "Left");
  EXPECT_FALSE(shoot(sculpture, {}));
}

TEST(PictureShots, OfALargeClayHaveNoMoreThanAPictureShows) {
  const Sculpture sculpture(test::bumpy_ball(30.0, 0.15).value());
  DisplaySurface whole;
  ASSERT_TRUE(whole.update(sculpture.clay()));
  const auto shot = shoot(sculpture, {});
  ASSERT_TRUE(shot);
  EXPECT_GT(whole.stats().triangles, 1'000'000);
  EXPECT_LT(shot->mesh.triangles.size(), 100'000U);
  EXPECT_GT(shot->mesh.triangles.size(), 10'000U);
  EXPECT_NEAR(bounds(shot->mesh).max.x, 30.0, 1.0);
}

TEST(PictureShots, AreDrawnFromEverywhere) {
  const Sculpture sculpture(Clay::ball(10.0, {}).value());
  for (const Vec3& eye : {Vec3{0.0, 0.0, 100.0}, Vec3{0.0, 0.0, -100.0}, Vec3{0.1, 0.0, 100.0},
                          Vec3{100.0, 0.0, 0.0}, Vec3{0.0, 0.0, 0.0}, Vec3{1e11, 0.0, 0.0}}) {
    DisplayView view;
    view.eye_mm = eye;
    view.pixel_rad = 0.001;
    const auto shot = shoot(sculpture, view);
    ASSERT_TRUE(shot);
    const auto image = draw(*shot, {});
    ASSERT_TRUE(image.ok()) << eye.x << " " << eye.z << ": " << image.error().message;
    EXPECT_EQ(image.value().width, kThumbnailWidth);
    EXPECT_EQ(image.value().height, kThumbnailHeight);
  }
}

}  // namespace
}  // namespace argil::viewer
