// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "argil/engine/alpha_image.h"
#include "argil/engine/clay.h"
#include "argil/engine/pick.h"
#include "argil/engine/surface.h"

#include "support/alpha_maker.h"
#include "support/measure/mesh_topology.h"
#include "support/stroke_maker.h"

namespace argil {
namespace {

using test::checker_image;
using test::image_of;
using test::letter_image;
using test::ramp_image;
using testing::IsEmpty;

constexpr double kEmbossVoxel = 0.25;
constexpr double kEmbossRadius = 8.0;
constexpr double kTop = 10.0;

Clay emboss_slab() {
  return Clay::block({44, 44, 2 * kTop}, ClayOptions{.voxel_mm = kEmbossVoxel}).value();
}

/// On the slab's top, 1 mm high.
Stroke emboss_stroke(std::shared_ptr<const AlphaImage> image, const std::vector<Vec3>& places) {
  Stroke stroke = stroke_of(Action::emboss, kEmbossRadius, 1.0, places);
  stroke.tool.alpha = std::move(image);
  stroke.tool.amplitude_mm = 1.0;
  return stroke;
}
Stroke one_stamp(std::shared_ptr<const AlphaImage> image) {
  return emboss_stroke(std::move(image), {{0, 0, kTop}});
}

Clay embossed(const Stroke& stroke) {
  Clay clay = emboss_slab();
  EXPECT_TRUE(clay.apply(stroke).ok());
  EXPECT_THAT(clay.validate(), IsEmpty());
  return clay;
}

double raised(const Clay& clay, double x, double y) {
  const auto hit = pick(clay, Ray{{x, y, 50.0}, {0, 0, -1}});
  return hit.ok() && hit.value() ? hit.value()->point_mm.z - kTop : std::nan("");
}

/// How far a surface lies from the exact one, in voxels and along its normal, over a square in the
/// middle.
struct HeightError {
  double rms = 0.0;
  double most = 0.0;
};
HeightError height_error(const Clay& clay, double half,
                         const std::function<double(double, double)>& exact) {
  HeightError error;
  int count = 0;
  for (double x = -half; x <= half; x += 0.11) {
    for (double y = -half; y <= half; y += 0.13, ++count) {
      constexpr double kStep = 0.02;
      const double slope_x = (exact(x + kStep, y) - exact(x - kStep, y)) / (2 * kStep);
      const double slope_y = (exact(x, y + kStep) - exact(x, y - kStep)) / (2 * kStep);
      const double lean = std::sqrt(1.0 + slope_x * slope_x + slope_y * slope_y);
      const double off = std::abs(raised(clay, x, y) - exact(x, y)) / (lean * kEmbossVoxel);
      error.rms += off * off;
      error.most = std::max(error.most, off);
    }
  }
  error.rms = std::sqrt(error.rms / count);
  return error;
}

/// What a stamp in the middle is to leave within its rim.
double exact_stamp(const AlphaImage& image, double radius, double x, double y) {
  return image.at(0, 0.5 + 0.5 * x / radius, 0.5 - 0.5 * y / radius, AlphaImage::Beyond::edge);
}

// ---- one stamp ---------------------------------------------------------------------------------

TEST(ActionEmboss, IsTheImageToAFractionOfAVoxel) {
  struct Case {
    const char* name;
    std::shared_ptr<const AlphaImage> image;
    double rms;
    double most;
  };
  const Case cases[] = {
      {"ramp", ramp_image(64), 0.005, 0.03},
      {"checks of 8 voxels", checker_image(64, 8), 0.15, 0.5},
      {"one pixel of 4 voxels",
       image_of(16, 16, [](int column, int row) { return column == 8 && row == 6 ? 1 : 0; }), 0.01,
       0.1},
      {"waves of 16 voxels",
       image_of(64, 64,
                [](int column, int row) {
                  return 0.5 + 0.25 * std::sin(0.3927 * (column + 0.5)) +
                         0.25 * std::sin(0.3927 * (row + 0.5));
                }),
       0.05, 0.15},
  };
  for (const Case& each : cases) {
    const Clay clay = embossed(one_stamp(each.image));
    const HeightError error = height_error(clay, 6.0, [&](double x, double y) {
      return exact_stamp(*each.image, kEmbossRadius, x, y);
    });
    std::printf("%s: rms %.4f, most %.4f voxels\n", each.name, error.rms, error.most);
    EXPECT_LT(error.rms, each.rms) << each.name;
    EXPECT_LT(error.most, each.most) << each.name;
    EXPECT_EQ(test::find_mesh_faults(extract_surface(clay)), test::MeshFaults{}) << each.name;
  }
}

/// An image of 8 bits would have two steps here, .125 mm high each: half a voxel.
TEST(ActionEmboss, HasNoStepsOfEightBits) {
  const auto faint = image_of(
      64, 64, [](int column, int) { return (30000.0 + 512.0 * (column + 0.5) / 64) / 65535.0; });
  Stroke stroke = one_stamp(faint);
  stroke.tool.amplitude_mm = kEmbossRadius;
  stroke.tool.mid_level = 30000.0 / 65535.0;
  const Clay clay = embossed(stroke);
  for (double x = -5.0; x <= 5.0; x += 0.05) {
    const double exact = kEmbossRadius * 512.0 / 65535.0 * (0.5 + 0.5 * x / kEmbossRadius);
    EXPECT_NEAR(raised(clay, x, 0.0), exact, 0.02 * kEmbossVoxel) << x;
  }
}

TEST(ActionEmboss, AveragesPixelsThatAreFinerThanVoxels) {
  const Clay clay = embossed(one_stamp(checker_image(512, 1)));
  const HeightError error = height_error(clay, 6.0, [](double, double) { return 0.5; });
  std::printf("checks of 1/8 voxel: rms %.4f, most %.4f voxels off half the height\n", error.rms,
              error.most);
  EXPECT_LT(error.most, 0.02);
}

TEST(ActionEmboss, FallsOffAtItsRimAndKeepsWhatLiesBeyond) {
  const Clay before = emboss_slab();
  const Clay clay = embossed(one_stamp(nullptr));
  EXPECT_NEAR(raised(clay, 0, 0), 1.0, 0.02 * kEmbossVoxel);
  const double rim = 0.18 * kEmbossRadius;
  for (double x = 0.0; x < kEmbossRadius + 3.0; x += 0.1) {
    const double q = std::max(0.0, x - (kEmbossRadius - rim)) / rim;
    const double exact = q < 1.0 ? (1.0 - q * q) * (1.0 - q * q) : 0.0;
    EXPECT_NEAR(raised(clay, x, 0.2), exact, 0.1 * kEmbossVoxel) << x;
    EXPECT_NEAR(raised(clay, 0.2, x), exact, 0.1 * kEmbossVoxel) << x;
  }
  for (double x = 0.0; x < 20.0; x += 0.7) {
    EXPECT_NEAR(clay.distance_at({x, 9.5, kTop - 0.1}), -0.1, 0.002 * kEmbossVoxel) << x;
    EXPECT_EQ(clay.distance_at({x, 0, -kTop}), before.distance_at({x, 0, -kTop}));
  }
}

TEST(ActionEmboss, SinksWithANegativeStrengthAndBelowItsMidLevel) {
  Stroke stroke = one_stamp(ramp_image(64));
  stroke.tool.strength = -0.5;
  const Clay sunk = embossed(stroke);
  stroke.tool.strength = 1.0;
  stroke.tool.mid_level = 0.5;
  const Clay both = embossed(stroke);
  for (double x = -6.0; x <= 6.0; x += 0.37) {
    const double grey = 0.5 + 0.5 * x / kEmbossRadius;
    EXPECT_NEAR(raised(sunk, x, 1.0), -0.5 * grey, 0.03 * kEmbossVoxel) << x;
    EXPECT_NEAR(raised(both, x, 1.0), grey - 0.5, 0.03 * kEmbossVoxel) << x;
  }
}

/// Turned by a quarter it is what the turned image would leave.
TEST(ActionEmboss, TurnsTheImageCounterClockwise) {
  const auto letter = letter_image();
  const auto turned = image_of(16, 16, [&](int column, int row) {
    return letter->pixels()[static_cast<std::size_t>(column * 16 + 15 - row)] / 65535.0;
  });
  Stroke stroke = one_stamp(letter);
  stroke.tool.angle_deg = 90.0;
  const Clay by_angle = embossed(stroke);
  const Clay by_image = embossed(one_stamp(turned));
  stroke.tool.angle_deg = -270.0;
  EXPECT_EQ(embossed(stroke).hash(), by_angle.hash());
  double most = 0.0;
  for (double x = -6.5; x <= 6.5; x += 0.3) {
    for (double y = -6.5; y <= 6.5; y += 0.3) {
      most = std::max(most, std::abs(raised(by_angle, x, y) - raised(by_image, x, y)));
    }
  }
  EXPECT_LT(most, 1e-3 * kEmbossVoxel);
  // A turn by any angle: the letter's stem is where it leads.
  stroke.tool.angle_deg = 30.0;
  const Clay oblique = embossed(stroke);
  const double c = std::cos(3.14159265358979 / 6.0);
  for (double v = -4.0; v <= 4.0; v += 0.5) {
    const double u = -2.5;
    EXPECT_NEAR(raised(oblique, c * u - 0.5 * v, 0.5 * u + c * v),
                exact_stamp(*letter, kEmbossRadius, u, v), 0.1 * kEmbossVoxel);
  }
}

TEST(ActionEmboss, KeepsTheProportionsOfAnImage) {
  const auto wide = image_of(32, 8, [](int column, int) { return column < 16 ? 1 : 0.5; });
  const Clay clay = embossed(one_stamp(wide));
  EXPECT_NEAR(raised(clay, -4.0, 0.0), 1.0, 0.02 * kEmbossVoxel);
  EXPECT_NEAR(raised(clay, 4.0, 0.0), 0.5, 0.02 * kEmbossVoxel);
  EXPECT_NEAR(raised(clay, -4.0, 1.4), 1.0, 0.02 * kEmbossVoxel);
  EXPECT_NEAR(raised(clay, -4.0, 2.1), 0.0, 0.02 * kEmbossVoxel);
}

/// High over the voxels of its pixels: nothing of it is lost between the leaves.
TEST(ActionEmboss, RaisesSpikesAndWallsAsHighAsTheyAre) {
  const auto spikes = image_of(64, 64, [](int column, int row) {
    return column % 16 / 3 == 2 && row % 16 / 3 == 2 ? 1 : 0;
  });
  Stroke stroke = one_stamp(spikes);
  stroke.tool.amplitude_mm = 6.0;  // 24 voxels; the spikes are 3 wide
  const Clay clay = embossed(stroke);
  const HeightError error = height_error(clay, 6.0, [&](double x, double y) {
    return 6.0 * exact_stamp(*spikes, kEmbossRadius, x, y);
  });
  std::printf("spikes of 3 by 24 voxels: rms %.3f, most %.3f voxels\n", error.rms, error.most);
  for (const double x : {-5.0, -1.0, 3.0}) {
    for (const double y : {-3.0, 1.0, 5.0}) {
      const double top = 6.0 * exact_stamp(*spikes, kEmbossRadius, x - 0.125, y + 0.125);
      EXPECT_NEAR(raised(clay, x - 0.125, y + 0.125), top, 1.5 * kEmbossVoxel) << x << ' ' << y;
    }
  }
  EXPECT_EQ(test::find_mesh_faults(extract_surface(clay)), test::MeshFaults{});
}

// ---- on a form ---------------------------------------------------------------------------------

/// Along the normals of a ball, by the image as it is seen along the stamp's normal.
TEST(ActionEmboss, StandsOnTheNormalsOfABall) {
  constexpr double kBall = 20.0;
  Clay clay = Clay::ball(kBall, ClayOptions{.voxel_mm = kEmbossVoxel}).value();
  const Clay plain = Clay::ball(kBall, ClayOptions{.voxel_mm = kEmbossVoxel}).value();
  const auto ramp = ramp_image(64);
  Stroke stroke = one_stamp(ramp);
  stroke.samples[0].position_mm = {0, 0, kBall};
  ASSERT_TRUE(clay.apply(stroke).ok());
  double most = 0.0;
  double rms = 0.0;
  int count = 0;
  for (double x = -6.0; x <= 6.0; x += 0.31) {
    for (double y = -5.0; y <= 5.0; y += 0.37, ++count) {
      const Vec3 foot{x, y, std::sqrt(kBall * kBall - x * x - y * y)};
      const auto hit = pick(clay, Ray{2.0 * foot, -foot});
      const auto former = pick(plain, Ray{2.0 * foot, -foot});
      const double height = length(hit.value()->point_mm - former.value()->point_mm);
      const double off = std::abs(height - exact_stamp(*ramp, kEmbossRadius, x, y)) / kEmbossVoxel;
      most = std::max(most, off);
      rms += off * off;
    }
  }
  rms = std::sqrt(rms / count);
  std::printf("ramp on a ball: rms %.4f, most %.4f voxels\n", rms, most);
  EXPECT_LT(rms, 0.05);
  EXPECT_LT(most, 0.12);
  EXPECT_THAT(clay.validate(), IsEmpty());
}

/// What was there is lifted as it is.
TEST(ActionEmboss, CarriesDetailAlong) {
  Clay plain = emboss_slab();
  const Stroke knob = stroke_of(Action::add, 0.8, 1.0, {{1.0, 0.5, kTop + 0.2}});
  ASSERT_TRUE(plain.apply(knob).ok());
  Clay lifted = emboss_slab();
  ASSERT_TRUE(lifted.apply(knob).ok());
  ASSERT_TRUE(lifted.apply(one_stamp(nullptr)).ok());
  for (double x = -1.0; x <= 3.0; x += 0.1) {
    const double change = raised(lifted, x, 0.5) - raised(plain, x, 0.5);
    EXPECT_NEAR(change, 1.0, 0.35 * kEmbossVoxel) << x;
  }
}

TEST(ActionEmboss, LeavesTheBackOfAThinWall) {
  Clay clay = Clay::block({30, 30, 3}, ClayOptions{.voxel_mm = kEmbossVoxel}).value();
  Stroke stroke = emboss_stroke(checker_image(32, 4), {{0, 0, 1.5}});
  ASSERT_TRUE(clay.apply(stroke).ok());
  for (double x = -7.0; x <= 7.0; x += 0.3) {
    EXPECT_NEAR(clay.distance_at({x, 0.4, -1.5}), 0.0, 0.02 * kEmbossVoxel) << x;
  }
}

// ---- along a stroke ----------------------------------------------------------------------------

TEST(ActionEmboss, SetsImagesAsFarApartAsTheSpacingSaysAndNoneOnTheirHalfWay) {
  const auto pixel = image_of(16, 16, [](int column, int row) {
    return column >= 7 && column < 9 && row >= 7 && row < 9 ? 1 : 0;
  });
  Stroke stroke = emboss_stroke(pixel, {{-10, 0, kTop}, {11.5, 0, kTop}});
  stroke.tool.radii_mm = {4, 4, 4};
  stroke.spacing = 2.0;  // 8 mm
  EXPECT_EQ(dabs_of(stroke).size(), 3U);
  const Clay clay = embossed(stroke);
  const double top = exact_stamp(*pixel, 4.0, 0.0, 0.0);
  for (const double x : {-10.0, -2.0, 6.0}) {
    EXPECT_NEAR(raised(clay, x, 0.0), top, 0.1 * kEmbossVoxel) << x;
  }
  for (const double x : {-6.0, 2.0, 10.0, 11.5}) {
    EXPECT_NEAR(raised(clay, x, 0.0), 0.0, 0.01 * kEmbossVoxel) << x;
  }
}

TEST(ActionEmboss, DoesNotPileUp) {
  Stroke stroke = emboss_stroke(letter_image(), {{-6, 0, kTop}, {6, 0, kTop}, {-6, 0, kTop}});
  for (const double spacing : {0.05, 0.3}) {
    stroke.spacing = spacing;
    const Clay clay = embossed(stroke);
    double most = 0.0;
    for (double x = -12.0; x <= 12.0; x += 0.2) {
      for (double y = -7.0; y <= 7.0; y += 0.5) most = std::max(most, raised(clay, x, y));
    }
    EXPECT_LT(most, 1.0 + 0.03 * kEmbossVoxel) << spacing;
    EXPECT_GT(most, 0.9) << spacing;
  }
}

TEST(ActionEmboss, FollowsTheStrokeWithUseRake) {
  const auto letter = letter_image();
  Stroke stroke = emboss_stroke(letter, {{0, -8, kTop}, {0, 8, kTop}});
  stroke.tool.use_rake = true;
  stroke.spacing = 2.0;
  ASSERT_EQ(dabs_of(stroke).size(), 2U);
  const Clay clay = embossed(stroke);
  // Its right side points along y, so that its stem (x = -2.5) lies across.
  for (const double y : {-8.0, 8.0}) {
    for (double v = -4.0; v <= 4.0; v += 0.5) {
      EXPECT_NEAR(raised(clay, -v, y - 2.5), exact_stamp(*letter, kEmbossRadius, -2.5, v),
                  0.1 * kEmbossVoxel)
          << y << ' ' << v;
    }
  }
}

TEST(ActionEmboss, IsDraggedToItsSizeAndTurn) {
  const auto letter = letter_image();
  Stroke dragged = emboss_stroke(letter, {{0, 0, kTop}, {2, 1, kTop}, {0, 6, kTop}});
  dragged.tool.alpha_mode = AlphaMode::anchored;
  dragged.tool.radii_mm = {1.0, 1.0, 1.0};  // what the hand says counts
  Stroke set = one_stamp(letter);
  set.tool.radii_mm = {6.0, 6.0, 6.0};
  set.tool.angle_deg = 90.0;
  EXPECT_EQ(embossed(dragged).hash(), embossed(set).hash());
  // A press without a drag is a stamp.
  dragged.samples.resize(1);
  set.tool.radii_mm = {1.0, 1.0, 1.0};
  set.tool.angle_deg = 0.0;
  EXPECT_EQ(embossed(dragged).hash(), embossed(set).hash());
}

TEST(ActionEmboss, RepeatsTilesWithTheirPeriod) {
  Stroke stroke = emboss_stroke(letter_image(), {{-6, 0, kTop}, {6, 0, kTop}});
  stroke.tool.alpha_mode = AlphaMode::tiled;
  stroke.tool.tile_mm = 8.0;
  const Clay clay = embossed(stroke);
  double most = 0.0;
  double high = 0.0;
  for (double x = -8.0; x <= 0.0; x += 0.17) {
    for (double y = -5.0; y <= 5.0; y += 0.19) {
      const double here = raised(clay, x, y);
      most = std::max(most, std::abs(raised(clay, x + 8.0, y) - here));
      if (y < -3.0) most = std::max(most, std::abs(raised(clay, x, y + 8.0) - here));
      high = std::max(high, here);
    }
  }
  std::printf("tiles: %.4f voxels from one to the next\n", most / kEmbossVoxel);
  EXPECT_GT(high, 0.8);
  EXPECT_LT(most, 0.1 * kEmbossVoxel);
  // As read from above: the letter's stem is on its left, its foot at the bottom.
  EXPECT_NEAR(raised(clay, 2.8, -3.2), letter_image()->at(0, 0.35, 0.4, AlphaImage::Beyond::edge),
              0.1 * kEmbossVoxel);
  // Another stroke beside it goes on with the same tiles.
  Stroke beside = stroke;
  beside.samples = {{0.0, {0, 5, kTop}, {}, 1.0}};
  Clay second = emboss_slab();
  ASSERT_TRUE(second.apply(beside).ok());
  for (double x = -3.0; x <= 3.0; x += 0.2) {
    EXPECT_NEAR(raised(second, x, 2.0), raised(clay, x, 2.0), 0.02 * kEmbossVoxel) << x;
  }
}

TEST(ActionEmboss, IsMirroredByMirroredStrokes) {
  for (const AlphaMode mode : {AlphaMode::space, AlphaMode::anchored, AlphaMode::tiled}) {
    Stroke stroke = emboss_stroke(letter_image(), {{11, 3, kTop}, {13, 8, kTop}});
    stroke.tool.alpha_mode = mode;
    stroke.tool.angle_deg = 20.0;
    stroke.tool.use_rake = true;
    stroke.tool.tile_mm = 5.0;
    stroke.mirror.x = true;
    const Clay clay = embossed(stroke);
    double high = 0.0;
    for (double x = 3.0; x <= 20.0; x += 0.3) {
      for (double y = -4.0; y <= 15.0; y += 0.4) {
        const double here = raised(clay, x, y);
        high = std::max(high, here);
        EXPECT_NEAR(raised(clay, -x, y), here, 1e-3 * kEmbossVoxel) << x << ' ' << y;
      }
    }
    EXPECT_GT(high, 0.8);
  }
}

/// In pieces, with any number of threads, and taken back.
TEST(ActionEmboss, IsTheSameHoweverItIsDone) {
  for (const AlphaMode mode : {AlphaMode::space, AlphaMode::anchored, AlphaMode::tiled}) {
    Stroke stroke = emboss_stroke(letter_image(), {{8, 0, 6}, {7, 5, 6}, {4, 8, 5}});
    stroke.tool.radii_mm = {4.0, 4.0, 4.0};
    stroke.tool.alpha_mode = mode;
    stroke.tool.use_rake = true;
    stroke.mirror.z = true;
    stroke.spacing = 1.2;
    const auto start = [] { return Clay::ball(10.0, ClayOptions{.voxel_mm = 0.3}).value(); };
    Clay whole = start();
    const std::uint64_t before = whole.hash();
    ASSERT_TRUE(whole.apply(stroke).ok());
    Clay pieces = start();
    ASSERT_TRUE(pieces.begin_stroke(stroke.tool, stroke).ok());
    for (const StrokeSample& sample : stroke.samples) {
      ASSERT_TRUE(pieces.extend_stroke({&sample, 1}).ok());
    }
    ASSERT_TRUE(pieces.end_stroke().ok());
    EXPECT_EQ(pieces.hash(), whole.hash());
    Clay alone = start();
    {
      const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
      ASSERT_TRUE(alone.apply(stroke).ok());
    }
    EXPECT_EQ(alone.hash(), whole.hash());
    EXPECT_NE(whole.hash(), before);
    ASSERT_TRUE(whole.undo());
    EXPECT_EQ(whole.hash(), before);
  }
}

TEST(ActionEmboss, RefusesWhatIsOutOfItsRange) {
  const auto refusal = [](const std::function<void(Tool&)>& set) {
    Tool tool;
    tool.action = Action::emboss;
    set(tool);
    const auto valid = validate_tool(tool);
    return valid ? std::string() : valid.error().message;
  };
  EXPECT_EQ(refusal([](Tool&) {}), "");
  EXPECT_EQ(refusal([](Tool& tool) { tool.amplitude_mm = -1.0; }),
            "amplitude_mm is -1; must be from 0 to 1000");
  EXPECT_EQ(refusal([](Tool& tool) { tool.mid_level = std::nan(""); }),
            "mid_level is nan; must be from 0 to 1");
  EXPECT_EQ(refusal([](Tool& tool) { tool.angle_deg = 400.0; }),
            "angle_deg is 400; must be from -360 to 360");
  EXPECT_EQ(refusal([](Tool& tool) { tool.tile_mm = 1e4; }),
            "tile_mm is 10000; must be from 0 to 1000");
  EXPECT_EQ(refusal([](Tool& tool) {
              tool.action = Action::inflate;
              tool.alpha = letter_image();
            }),
            "an image was given to inflate; use emboss");
}

}  // namespace
}  // namespace argil
