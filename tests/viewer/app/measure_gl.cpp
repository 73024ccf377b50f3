// SPDX-License-Identifier: GPL-3.0-or-later
// Measuring and the search of commands in a real window, by mouse and keys.
#include <cmath>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "argil/io/project_file.h"

#include "picture/piece_frame.h"
#include "viewer/support/picture_alike.h"
#include "viewer/support/two_pieces.h"

namespace argil {
namespace {

Vec3 vec_of(const nlohmann::json& numbers) {
  return {numbers.at(0).get<double>(), numbers.at(1).get<double>(), numbers.at(2).get<double>()};
}

class ViewMeasureGl : public test::TwoPiecesTest {
 protected:
  /// With the panels hidden, so that all of the picture can be clicked on.
  nlohmann::json measured(const std::string& script) {
    const test::WindowRun run =
        play("settle\nkey Tab\nmove 20 460\nframes 2\n" + script + "settle\nframes 2\n", "s.vdb");
    EXPECT_EQ(run.status, 0) << run.words;
    EXPECT_EQ(run.report.at("gl_errors"), 0);
    EXPECT_EQ(run.report.at("complaints").size(), 0U) << run.report.dump();
    EXPECT_EQ(run.report.at("dabs"), 0) << "nothing is sculpted";
    return run.report.at("measurements");
  }

  std::string click(const Vec3& place) const {
    return "move " + at(place) + "\npress left\nrelease left\nsettle\nframes 2\n";
  }

  /// Where the window's camera sees a plane under the whole pixel next to a place.
  Vec3 on_plane(const Vec3& place, std::size_t axis) const {
    const viewer::Camera::Pixel at = camera_.pixel_of(place);
    const Ray ray = camera_.ray_at(
        {static_cast<double>(std::lround(at.x)), static_cast<double>(std::lround(at.y))});
    return ray.origin_mm +
           (place[axis] - ray.origin_mm[axis]) / ray.direction[axis] * ray.direction;
  }
};

TEST_F(ViewMeasureGl, DistanceAngleAndThicknessAreThoseOfTheSolids) {
  // Of the block's front, y = -10, and of its right side, x = 12.
  const Vec3 one{-8.0, -10.0, -6.0};
  const Vec3 corner{6.0, -10.0, -7.0};
  const Vec3 side{12.0, 4.0, -4.0};
  const nlohmann::json list =
      measured("key Shift+U\nframes 2\n" + click(one) + click(corner) + "key Ctrl+U\nframes 2\n" +
               click(one) + click(corner) + click(side) + "key Alt+U\nframes 2\n" + click(one));
  ASSERT_EQ(list.size(), 3U);
  const Vec3 a = on_plane(one, 1);
  const Vec3 b = on_plane(corner, 1);
  const Vec3 c = on_plane(side, 0);
  EXPECT_EQ(list[0].at("kind"), "distance");
  EXPECT_NEAR(list[0].at("value").get<double>(), length(a - b), 0.01 * kPieceVoxelMm);
  EXPECT_EQ(list[1].at("kind"), "angle");
  const double cosine = dot(normalized(a - b), normalized(c - b));
  EXPECT_NEAR(list[1].at("value").get<double>(), std::acos(cosine) * 180.0 / 3.14159265358979,
              0.02);
  EXPECT_EQ(list[2].at("kind"), "thickness");
  EXPECT_NEAR(list[2].at("value").get<double>(), 20.0, 0.01 * kPieceVoxelMm);
  EXPECT_LT(length(vec_of(list[2].at("points_mm")[1]) - Vec3{a.x, 10.0, a.z}),
            0.02 * kPieceVoxelMm);
}

TEST_F(ViewMeasureGl, FromOnePieceToAnotherAndAlongWithAnEndThatIsDragged) {
  const Vec3 toward = normalized(camera_.lens({}).eye_mm - head_place_.position_mm);
  const Vec3 front = head_place_.position_mm + 9.0 * toward;
  const Vec3 one{-8.0, -10.0, -6.0};
  const Vec3 other{3.0, -10.0, -2.0};
  const std::string pick = "key Shift+U\nframes 2\n" + click(front) + click(one);
  const nlohmann::json first = measured(pick);
  ASSERT_EQ(first.size(), 1U);
  const Vec3 on_head = vec_of(first[0].at("points_mm")[0]);
  EXPECT_NEAR(length(on_head - head_place_.position_mm), 9.0, 0.05 * kPieceVoxelMm);
  EXPECT_LT(length(on_head - front), 0.2) << "a pixel";
  const nlohmann::json second =
      measured(pick + "drag left " + at(one) + " " + at(other) + " 8\nsettle\n");
  ASSERT_EQ(second.size(), 1U);
  EXPECT_LT(length(vec_of(second[0].at("points_mm")[1]) - on_plane(other, 1)),
            0.01 * kPieceVoxelMm);
  EXPECT_EQ(vec_of(second[0].at("points_mm")[0]), on_head);
}

TEST_F(ViewMeasureGl, MeasuresTheMaterialThatASliceShows) {
  // Across y, in the middle.
  const Vec3 left{-9.0, 0.0, -3.0};
  const Vec3 right{8.0, 0.0, -5.0};
  const nlohmann::json list = measured(
      "key Tab\nframes 3\nclick Slice\nframes 3\nclick Across\nframes 3\nclick Across/y\n"
      "settle\nframes 3\nkey Tab\nframes 3\nkey Shift+U\nframes 2\n" +
      click(left) + click(right) + "key Alt+U\nframes 2\n" + click(right));
  ASSERT_EQ(list.size(), 2U);
  EXPECT_LT(length(vec_of(list[0].at("points_mm")[0]) - on_plane(left, 1)), 1e-6);
  EXPECT_LT(length(vec_of(list[0].at("points_mm")[1]) - on_plane(right, 1)), 1e-6);
  // The shortest line through a place near a corner: to its two sides, as a ladder leans.
  const Vec3 at = on_plane(right, 1);
  const double ladder =
      std::pow(std::pow(12.0 - at.x, 2.0 / 3.0) + std::pow(12.0 + at.z, 2.0 / 3.0), 1.5);
  EXPECT_NEAR(list[1].at("value").get<double>(), ladder, 0.1);
}

TEST_F(ViewMeasureGl, TheListCopiesRemovesAndHides) {
  const Vec3 one{-8.0, -10.0, -6.0};
  const Vec3 other{6.0, -10.0, -7.0};
  const nlohmann::json list = measured(
      "key Alt+U\nframes 2\n" + click(one) + "move 20 440\nsettle\nframes 3\nshot shown.png\n" +
      click(other) +
      "key Ctrl+Alt+U\nframes 3\nclick Copy##1\nframes 2\nclick x##2\nframes 2\n"
      "click In the picture\nmove 20 440\nsettle\nframes 3\nshot hidden.png\n"
      "key Ctrl+Shift+S\nframes 3\nclick ##name\nkey Ctrl+A\nkey Ctrl+V\nframes 3\ntype .vdb\n"
      "key Enter\nsettle\n");
  ASSERT_EQ(list.size(), 1U);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "20.00 mm.vdb")) << "what was copied is its name";
  // The number of the chosen one is framed in yellow beside its point.
  const auto yellow = [&](const char* file) {
    const Image picture = test::read_picture(folder_ / file);
    int count = 0;
    for (std::size_t n = 0; n + 2 < picture.rgb.size(); n += 3) {
      if (picture.rgb[n] > 180 && picture.rgb[n + 1] > 150 && picture.rgb[n + 2] < 110) ++count;
    }
    return count;
  };
  EXPECT_GT(yellow("shown.png"), yellow("hidden.png") + 100);
}

TEST_F(ViewMeasureGl, TheSearchRunsWhatIsTypedAndWhatIsClicked) {
  const nlohmann::json list = measured(
      "key Ctrl+K\ntype thickness\nframes 2\nkey Enter\nframes 2\n" + click({-8.0, -10.0, -6.0}) +
      "key Ctrl+K\ntype ang\nframes 3\nclick Angle##foundMeasure\nframes 2\n" +
      click({-8.0, -10.0, -6.0}) + click({6.0, -10.0, -7.0}) + click({0.0, -10.0, 2.0}));
  ASSERT_EQ(list.size(), 2U);
  EXPECT_EQ(list[0].at("kind"), "thickness");
  EXPECT_EQ(list[1].at("kind"), "angle");
}

}  // namespace
}  // namespace argil
