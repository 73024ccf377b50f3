// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/engine/window.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/haptics/tool_force.h"

#include "haptics/fields.h"
#include "level_stack.h"

namespace argil {
namespace {

using haptics::fields::Distance;

Vec3 place_of_node(const Coord& node, double voxel) {
  return voxel * Vec3{static_cast<double>(node.x()), static_cast<double>(node.y()),
                      static_cast<double>(node.z())};
}

/// Stores the band of `field` on one level, wherever it crosses the cube of half side `half_mm`.
void store_band(LevelStack& stack, int level, const Distance& field, double half_mm) {
  const double h = stack.voxel_mm(level);
  const double band = kHalfWidthVoxels * h;
  const int places = static_cast<int>(std::ceil(half_mm / (h * kLeafSide)));
  auto& tree = stack.grid(level).tree();
  for (int i = -places; i < places; ++i) {
    for (int j = -places; j < places; ++j) {
      for (int k = -places; k < places; ++k) {
        const Coord origin = Coord(i, j, k) << 3;
        const double middle = field(place_of_node(origin.offsetBy(4), h));
        if (std::abs(middle) > band + 7.0 * h) {
          if (middle < 0.0 && level == stack.top()) {
            tree.addTile(1, origin, static_cast<float>(-band), false);
          }
          continue;
        }
        auto* leaf = tree.touchLeaf(origin);
        for (openvdb::Index n = 0; n < kLeafNodes; ++n) {
          const double d = field(place_of_node(leaf->offsetToGlobalCoord(n), h));
          leaf->setValueOn(n, static_cast<float>(std::clamp(d, -band, band)));
        }
      }
    }
  }
}

/// A clay of an exact distance: the band stored on all levels from `finest_stored` up.
Clay clay_of(const Distance& field, double half_mm, double voxel_mm, int levels,
             int finest_stored = 0) {
  auto stack = std::make_unique<LevelStack>(voxel_mm, levels);
  for (int level = finest_stored; level < levels; ++level) {
    store_band(*stack, level, field, half_mm);
  }
  ClayOptions options;
  options.voxel_mm = voxel_mm;
  return Clay::from_levels(std::move(stack), options);
}

struct Figures {
  double p95 = 0.0;
  double max = 0.0;
  std::size_t nodes = 0;
};

/// Errors in voxels of the window's level against the field clamped to +-depth.
Figures errors(const FieldWindowView& view, const Distance& field, double depth_mm) {
  std::vector<double> all;
  for (int i = 0; i < view.nodes[0]; ++i) {
    for (int j = 0; j < view.nodes[1]; ++j) {
      for (int k = 0; k < view.nodes[2]; ++k) {
        const double exact = field(view.origin_mm + place_of_node({i, j, k}, view.voxel_mm));
        if (std::abs(exact) > depth_mm) continue;
        all.push_back(std::abs(static_cast<double>(view.at(i, j, k)) - exact) / view.voxel_mm);
      }
    }
  }
  if (all.empty()) return {};
  std::sort(all.begin(), all.end());
  return {all[all.size() * 95 / 100], all.back(), all.size()};
}

void expect_march(const Clay& clay, const Distance& field, int level, const Vec3& center,
                  double reach, double depth, double p95, double max) {
  const auto window = read_window(clay, level, center, reach, depth, Extension::march);
  ASSERT_TRUE(window.ok()) << window.error().message;
  const Figures figures = errors(window.value().view, field, depth);
  EXPECT_GT(figures.nodes, 1000U);
  EXPECT_LE(figures.p95, p95);
  EXPECT_LE(figures.max, max);
}

Clay ball_clay() { return clay_of(haptics::fields::ball(16), 22, 0.5, 3); }

TEST(WindowMarch, MatchesTheBallAtEveryStoredLevel) {
  const Clay clay = ball_clay();
  const Distance field = haptics::fields::ball(16);
  expect_march(clay, field, 0, {9, 9, 9}, 7.0, 14.0, 0.02, 0.3);
  expect_march(clay, field, 1, {9, 9, 9}, 12.0, 14.0, 0.04, 0.4);
  expect_march(clay, field, 2, {9, 9, 9}, 24.0, 14.0, 0.03, 0.3);
}

/// There the distance comes from a level four times coarser: 0.5 voxel here is 0.12 of that one's.
TEST(WindowMarch, KnowsSurfacesOutsideTheWindow) {
  const Clay clay = ball_clay();
  const Distance field = haptics::fields::ball(16);
  expect_march(clay, field, 0, {6, 1, 2}, 4.0, 16.0, 0.5, 1.0);     // around the centre
  expect_march(clay, field, 0, {20, 10, 3}, 3.0, 16.0, 0.12, 0.2);  // outside
}

TEST(WindowMarch, MatchesATorus) {
  const Distance field = haptics::fields::torus(18, 7);
  const Clay clay = clay_of(field, 30, 0.5, 3);
  expect_march(clay, field, 0, {18, 0, 3}, 9.0, 6.0, 0.04, 0.3);
  expect_march(clay, field, 1, {18, 0, 3}, 16.0, 6.0, 0.03, 0.2);
}

TEST(WindowMarch, InterpolatesWhereOnlyCoarserLeavesAre) {
  const Distance field = haptics::fields::ball(16);
  const Clay clay = clay_of(field, 22, 0.25, 4, 2);
  // Trilinear interpolation between nodes 1 mm apart loses up to 1 / 8 * 2 / 16 mm.
  expect_march(clay, field, 0, {16, 0, 0}, 3.0, 8.0, 0.07, 0.1);
}

TEST(WindowMarch, InterpolatesNegativeLevels) {
  const Clay clay = ball_clay();
  const auto window = read_window(clay, -2, {16, 1, -2}, 1.0, 4.0, Extension::march);
  ASSERT_TRUE(window.ok()) << window.error().message;
  const FieldWindowView& view = window.value().view;
  EXPECT_EQ(view.level, -2);
  EXPECT_EQ(view.voxel_mm, 0.125);
  // 0.5^2 / 8 * (2 / 16) mm by interpolation, in voxels of 0.125 mm.
  EXPECT_LE(errors(view, haptics::fields::ball(16), 4.0).max, 0.04);
}

TEST(WindowMarch, WorksOnASingleLevelByLeavingNodesOut) {
  const Distance field = haptics::fields::ball(16);
  const Clay clay = clay_of(field, 22, 0.5, 1);
  expect_march(clay, field, 0, {6, 1, 2}, 4.0, 16.0, 0.6, 1.0);
  expect_march(clay, field, 0, {14, 1, 2}, 6.0, 19.0, 0.2, 0.4);
}

TEST(WindowMarch, StopsBeyondItsDepth) {
  const Clay clay = ball_clay();
  const auto window = read_window(clay, 0, {16, 0, 0}, 10.0, 3.0, Extension::march);
  ASSERT_TRUE(window.ok());
  const FieldWindowView& view = window.value().view;
  const auto [low, high] = std::minmax_element(view.distance_mm.begin(), view.distance_mm.end());
  EXPECT_EQ(*low, -4.0F);
  EXPECT_EQ(*high, 4.0F);
  EXPECT_LE(errors(view, haptics::fields::ball(16), 3.0).max, 0.1);
}

TEST(WindowMarch, CoversItsReachWithNodesOfTheLevel) {
  const Clay clay = ball_clay();
  const auto window = read_window(clay, 1, {15.3, 0.2, -0.7}, 5.0, 8.0, Extension::march);
  ASSERT_TRUE(window.ok());
  const FieldWindowView& view = window.value().view;
  EXPECT_EQ(view.level, 1);
  EXPECT_EQ(view.voxel_mm, 1.0);
  EXPECT_EQ(view.origin_mm, (Vec3{10, -5, -6}));
  EXPECT_EQ(view.nodes, (std::array<int, 3>{12, 12, 12}));
  EXPECT_EQ(view.distance_mm.size(), 12U * 12U * 12U);
  EXPECT_EQ(view.distance_mm.data(), window.value().storage.data());
}

TEST(WindowMarch, IsAllOutsideWithoutClay) {
  const Clay clay = Clay::from_levels(std::make_unique<LevelStack>(0.5, 2), ClayOptions{});
  for (const Extension extension : {Extension::march, Extension::exact}) {
    const auto window = read_window(clay, 0, {}, 4.0, 8.0, extension);
    ASSERT_TRUE(window.ok());
    EXPECT_THAT(window.value().storage, ::testing::Each(::testing::Gt(0.0F)));
  }
}

TEST(WindowMarch, RefusesWhatItCannotDo) {
  const Clay clay = ball_clay();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto message = [&](int level, const Vec3& center, double reach, double depth) {
    const auto window = read_window(clay, level, center, reach, depth, Extension::march);
    return window.ok() ? std::string() : window.error().message;
  };
  EXPECT_THAT(message(3, {}, 1, 1), ::testing::HasSubstr("level 3 is not one of the clay's"));
  EXPECT_THAT(message(-11, {}, 1, 1), ::testing::HasSubstr("use -10 to 2"));
  EXPECT_THAT(message(0, {}, 200, 1), ::testing::HasSubstr("more than 512"));
  EXPECT_THAT(message(0, {}, 1, 5000), ::testing::HasSubstr("more than 512"));
  EXPECT_THAT(message(0, {}, 1, std::numeric_limits<double>::infinity()),
              ::testing::HasSubstr("more than 512"));
  EXPECT_THAT(message(0, {nan, 0, 0}, 1, 1), ::testing::HasSubstr("finite"));
  EXPECT_THAT(message(0, {}, nan, 1), ::testing::HasSubstr("finite"));
  EXPECT_THAT(message(0, {1e9, 0, 0}, 1, 1), ::testing::HasSubstr("beyond where clay can be"));
}

/// What is felt through a window of the clay against a window filled from the formula.
double force_error(const Clay& clay, const Distance& field, const Vec3& place, double radius,
                   Extension extension, int level) {
  const haptics::ForceMaterial material;
  const haptics::ForceTool tool = haptics::fields::ball_tool(radius, place);
  const double voxel = std::ldexp(clay.options().voxel_mm, level);
  const double reach = haptics::kKernelSupport * radius + 2.0 * voxel;
  const double depth = 2.0 * radius + material.skin_mm;
  const auto window = read_window(clay, level, place, reach, depth, extension);
  EXPECT_TRUE(window.ok());
  const auto law = haptics::ForceLaw::energy;
  const auto felt = haptics::volume_force(window.value().view, tool, material, law);
  EXPECT_FALSE(felt.outside_window);
  const auto exact = haptics::fields::force_at(field, tool, 24, material, law);
  return length(felt.contact_n - exact.contact_n) / length(exact.contact_n);
}

TEST(WindowExact, IsTheDistanceToTheSurface) {
  const Distance field = haptics::fields::ball(16);
  const Clay clay = ball_clay();
  for (const int level : {-1, 0, 1}) {
    const auto window = read_window(clay, level, {8, 4, 4}, 6.0, 14.0, Extension::exact);
    ASSERT_TRUE(window.ok()) << window.error().message;
    // The surface of triangles itself is off by a few hundredths of the finest voxel, 0.5 mm.
    const Figures figures = errors(window.value().view, field, 14.0);
    EXPECT_LE(figures.max * window.value().view.voxel_mm, 0.05 * 0.5) << level;
  }
}

TEST(WindowExact, AgreesWithTheMarch) {
  const Clay clay = clay_of(haptics::fields::torus(18, 7), 30, 0.5, 3);
  const auto exact = read_window(clay, 0, {18, 0, 3}, 8.0, 14.0, Extension::exact);
  const auto march = read_window(clay, 0, {18, 0, 3}, 8.0, 14.0, Extension::march);
  ASSERT_TRUE(exact.ok() && march.ok());
  ASSERT_EQ(exact.value().storage.size(), march.value().storage.size());
  std::vector<double> apart;
  for (std::size_t i = 0; i < exact.value().storage.size(); ++i) {
    apart.push_back(
        std::abs(static_cast<double>(exact.value().storage[i] - march.value().storage[i])) / 0.5);
  }
  std::sort(apart.begin(), apart.end());
  EXPECT_LE(apart[apart.size() * 95 / 100], 0.05);
  EXPECT_LE(apart.back(), 1.0);  // at the medial ring
}

TEST(WindowForce, IsWithinOnePercentOfTheBall) {
  const Clay clay = ball_clay();
  const Distance field = haptics::fields::ball(16);
  const Vec3 n = normalized(Vec3{3, -1, 2});
  for (const double radius : {1.0, 2.0, 3.0, 4.0, 7.0, 8.0, 12.0}) {
    const int level = haptics::choose_level(radius, 0.5, clay.level_count() - 1).level;
    for (const double depth : {-4.0, 0.0, 1.0, 5.0}) {
      const double error =
          force_error(clay, field, (16.0 - depth) * n, radius, Extension::march, level);
      EXPECT_LE(error, 0.01) << "radius " << radius << " depth " << depth << " level " << level;
    }
  }
}

/// Method `fine`: the finest level and the exact distance.
TEST(WindowForce, OfTheExactWindowIsCloserStill) {
  const Clay clay = ball_clay();
  const Distance field = haptics::fields::ball(16);
  for (const double depth : {-4.0, 0.0, 5.0}) {
    for (const double radius : {3.0, 6.0}) {
      const Vec3 place = (16.0 - depth) * normalized(Vec3{3, -1, 2});
      EXPECT_LE(force_error(clay, field, place, radius, Extension::exact, 0), 0.001);
    }
  }
}

}  // namespace
}  // namespace argil
