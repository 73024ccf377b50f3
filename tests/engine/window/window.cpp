// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/engine/window.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/haptics/force/tool_force.h"

#include "clay/clay_access.h"
#include "field/dense_block.h"
#include "field/level_stack.h"
#include "haptics/force/fields.h"
#include "support/effort.h"

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
  return clay_of_levels(std::move(stack), options);
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

void expect_layers(const Clay& clay, const Distance& field, const WindowRequest& request,
                   double p95, double max) {
  SCOPED_TRACE(request.voxel_mm);
  const auto window = read_window(clay, request, Extension::layers);
  ASSERT_TRUE(window.ok()) << window.error().message;
  const Figures figures = errors(window.value().view, field, request.depth_mm);
  EXPECT_GT(figures.nodes, 1000U);
  EXPECT_LE(figures.p95, p95);
  EXPECT_LE(figures.max, max);
}

Clay ball_clay() { return clay_of(haptics::fields::ball(16), 22, 0.5, 3); }

TEST(WindowLayers, MatchesTheBallAtAnySpacing) {
  const Clay clay = ball_clay();  // levels of 0.5, 1 and 2 mm
  const Distance field = haptics::fields::ball(16);
  for (const double voxel : {0.5, 0.61, 0.75, 0.99}) {
    expect_layers(clay, field, {{9, 9, 9}, voxel, 7.0, 14.0}, 0.02, 0.3);
  }
  for (const double voxel : {1.0, 1.1, 1.2, 1.6, 1.99}) {
    expect_layers(clay, field, {{9, 9, 9}, voxel, 12.0, 14.0}, 0.04, 0.4);
  }
  for (const double voxel : {2.0, 2.2, 2.7, 3.9}) {
    expect_layers(clay, field, {{9, 9, 9}, voxel, 24.0, 14.0}, 0.03, 0.3);
  }
}

/// There the distance comes from a level four times coarser: 0.5 voxel here is 0.12 of that one's.
TEST(WindowLayers, KnowsSurfacesOutsideTheWindow) {
  const Clay clay = ball_clay();
  const Distance field = haptics::fields::ball(16);
  expect_layers(clay, field, {{6, 1, 2}, 0.5, 4.0, 16.0}, 0.5, 1.0);     // around the centre
  expect_layers(clay, field, {{20, 10, 3}, 0.5, 3.0, 16.0}, 0.12, 0.2);  // outside
}

TEST(WindowLayers, MatchesATorus) {
  const Distance field = haptics::fields::torus(18, 7);
  const Clay clay = clay_of(field, 30, 0.5, 3);
  expect_layers(clay, field, {{18, 0, 3}, 0.5, 9.0, 6.0}, 0.04, 0.3);
  expect_layers(clay, field, {{18, 0, 3}, 0.8, 9.0, 6.0}, 0.04, 0.3);
  expect_layers(clay, field, {{18, 0, 3}, 1.25, 16.0, 6.0}, 0.03, 0.2);
}

TEST(WindowLayers, InterpolatesWhereOnlyCoarserLeavesAre) {
  const Distance field = haptics::fields::ball(16);
  const Clay clay = clay_of(field, 22, 0.25, 4, 2);
  // Trilinear interpolation between nodes 1 mm apart would lose 1 / 8 * 2 / 16 mm, 0.06 voxel.
  expect_layers(clay, field, {{16, 0, 0}, 0.25, 3.0, 8.0}, 0.01, 0.03);
}

TEST(WindowLayers, InterpolatesBelowTheFinestVoxel) {
  const Clay clay = ball_clay();
  const WindowRequest request{{16, 1, -2}, 0.11, 1.0, 4.0};
  const auto window = read_window(clay, request, Extension::layers);
  ASSERT_TRUE(window.ok()) << window.error().message;
  const FieldWindowView& view = window.value().view;
  EXPECT_EQ(view.level, 0);
  EXPECT_EQ(view.voxel_mm, 0.11);
  // Four taps lose a hundredth of what two would, 0.5^2 / 8 * (2 / 16) mm. Errors are in nodes.
  EXPECT_LE(errors(view, haptics::fields::ball(16), 0.5).max * 0.11, 0.002);
  // From two voxels on some taps are beyond the band, which cuts them short.
  EXPECT_LE(errors(view, haptics::fields::ball(16), 4.0).max * 0.11, 0.02);
}

TEST(WindowLayers, CopiesWhereItsNodesAreThoseOfTheLevel) {
  const Clay clay = ball_clay();
  const auto window = read_window(clay, {{12, 3, -5}, 0.5, 5.0, 8.0}, Extension::layers);
  ASSERT_TRUE(window.ok());
  const FieldWindowView& view = window.value().view;
  const NodeBox box = covering_nodes({12, 3, -5}, 5.0, 0.5);
  int same = 0;
  std::size_t n = 0;
  for_each_node(box, [&](const Coord& node) {
    const float stored = levels_of(clay).sample(0, node);
    const float read = view.distance_mm[n++];
    if (std::abs(stored) < 0.5F) {
      EXPECT_EQ(read, stored);
      ++same;
    } else if (std::abs(stored) < 1.5F) {
      EXPECT_NEAR(read, stored, 0.01F);  // what layers say is mixed in
    }
  });
  EXPECT_GT(same, 500);
}

TEST(WindowLayers, WorksOnASingleLevelByLeavingNodesOut) {
  const Distance field = haptics::fields::ball(16);
  const Clay clay = clay_of(field, 22, 0.5, 1);
  expect_layers(clay, field, {{6, 1, 2}, 0.5, 4.0, 16.0}, 0.6, 1.0);
  expect_layers(clay, field, {{14, 1, 2}, 0.5, 6.0, 19.0}, 0.2, 0.4);
}

TEST(WindowLayers, StopsBeyondItsDepth) {
  const Clay clay = ball_clay();
  for (const double voxel : {0.5, 0.7, 1.05}) {
    const auto window = read_window(clay, {{16, 0, 0}, voxel, 10.0, 3.0}, Extension::layers);
    ASSERT_TRUE(window.ok());
    const FieldWindowView& view = window.value().view;
    EXPECT_EQ(view.level, 0);
    const auto [low, high] = std::minmax_element(view.distance_mm.begin(), view.distance_mm.end());
    EXPECT_EQ(*low, -4.0F);
    EXPECT_EQ(*high, 4.0F);
    EXPECT_LE(errors(view, haptics::fields::ball(16), 2.5).max, 0.1);
  }
}

TEST(WindowLayers, CoversItsReachWithNodesAtMultiplesOfTheSpacing) {
  const Clay clay = ball_clay();
  const auto window = read_window(clay, {{15.3, 0.0, -0.7}, 1.25, 5.0, 8.0}, Extension::layers);
  ASSERT_TRUE(window.ok());
  const FieldWindowView& view = window.value().view;
  EXPECT_EQ(view.level, 1);
  EXPECT_EQ(view.voxel_mm, 1.25);
  EXPECT_EQ(view.origin_mm, (Vec3{10, -5, -6.25}));
  EXPECT_EQ(view.nodes, (std::array<int, 3>{10, 9, 10}));
  EXPECT_EQ(view.distance_mm.size(), 10U * 9U * 10U);
  EXPECT_EQ(view.distance_mm.data(), window.value().storage.data());
}

TEST(WindowLayers, IsAllOutsideWithoutClay) {
  const Clay clay = clay_of_levels(std::make_unique<LevelStack>(0.5, 2), ClayOptions{});
  for (const Extension extension : {Extension::layers, Extension::exact}) {
    const auto window = read_window(clay, {{}, 0.6, 4.0, 8.0}, extension);
    ASSERT_TRUE(window.ok());
    EXPECT_THAT(window.value().storage, ::testing::Each(::testing::Gt(0.0F)));
  }
}

TEST(WindowLayers, RefusesWhatItCannotDo) {
  const Clay clay = ball_clay();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const auto message = [&](const WindowRequest& request) {
    const auto window = read_window(clay, request, Extension::layers);
    return window.ok() ? std::string() : window.error().message;
  };
  for (const double voxel : {0.0, -1.0, 1e-4, nan, infinity}) {
    EXPECT_THAT(message({{}, voxel, 1, 1}), ::testing::HasSubstr("use 0.000488281 mm or more"));
  }
  EXPECT_THAT(message({{}, 0.5, 200, 1}), ::testing::HasSubstr("more than 512"));
  EXPECT_THAT(message({{}, 0.5, 1, 5000}), ::testing::HasSubstr("more than 512"));
  EXPECT_THAT(message({{}, 5000, 1, 1}), ::testing::HasSubstr("more than 512"));
  EXPECT_THAT(message({{}, 0.5, 1, infinity}), ::testing::HasSubstr("more than 512"));
  EXPECT_THAT(message({{nan, 0, 0}, 0.5, 1, 1}), ::testing::HasSubstr("finite"));
  EXPECT_THAT(message({{}, 0.5, nan, 1}), ::testing::HasSubstr("finite"));
  EXPECT_THAT(message({{1e9, 0, 0}, 0.5, 1, 1}), ::testing::HasSubstr("beyond where clay can be"));
}

/// What is felt at a point through a window of the clay with `across` nodes along the tool.
Vec3 felt(const Clay& clay, const haptics::ForceTool& tool, double across, Extension extension) {
  const haptics::ForceMaterial material;
  const double radius = tool.radii_mm.x;
  const double voxel = 2.0 * radius / across;
  const WindowRequest request{tool.position_mm, voxel,
                              haptics::kKernelSupport * radius + 2.0 * voxel,
                              2.0 * radius + material.skin_mm};
  const auto window = read_window(clay, request, extension);
  EXPECT_TRUE(window.ok());
  const auto force =
      haptics::volume_force(window.value().view, tool, material, haptics::ForceLaw::energy);
  EXPECT_FALSE(force.outside_window);
  return force.contact_n;
}

/// Its error against a window filled from the formula, as a share of the force.
double force_error(const Clay& clay, const Distance& field, const haptics::ForceTool& tool,
                   double across, Extension extension) {
  const Vec3 exact =
      haptics::fields::force_at(field, tool, 24, {}, haptics::ForceLaw::energy).contact_n;
  return length(felt(clay, tool, across, extension) - exact) / length(exact);
}

TEST(WindowExact, IsTheDistanceToTheSurface) {
  const Distance field = haptics::fields::ball(16);
  const Clay clay = ball_clay();
  const double reach = test::effort(3.0, 6.0);
  for (const double voxel : {0.25, 0.5, 0.77, 1.0}) {
    const auto window = read_window(clay, {{8, 4, 4}, voxel, reach, 14.0}, Extension::exact);
    ASSERT_TRUE(window.ok()) << window.error().message;
    // The surface of triangles itself is off by a few hundredths of the finest voxel, 0.5 mm.
    const Figures figures = errors(window.value().view, field, 14.0);
    EXPECT_LE(figures.max * window.value().view.voxel_mm, 0.05 * 0.5) << voxel;
  }
}

TEST(WindowExact, AgreesWithTheLayers) {
  const Clay clay = clay_of(haptics::fields::torus(18, 7), 30, 0.5, 3);
  const WindowRequest request{{18, 0, 3}, 0.5, 8.0, 14.0};
  const auto exact = read_window(clay, request, Extension::exact);
  const auto layers = read_window(clay, request, Extension::layers);
  ASSERT_TRUE(exact.ok() && layers.ok());
  ASSERT_EQ(exact.value().storage.size(), layers.value().storage.size());
  std::vector<double> apart;
  for (std::size_t i = 0; i < exact.value().storage.size(); ++i) {
    apart.push_back(
        std::abs(static_cast<double>(exact.value().storage[i] - layers.value().storage[i])) / 0.5);
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
    for (const double depth : {-4.0, 0.0, 1.0, 5.0}) {
      const auto tool = haptics::fields::ball_tool(radius, (16.0 - depth) * n);
      EXPECT_LE(force_error(clay, field, tool, 8.0, Extension::layers), 0.01)
          << "radius " << radius << " depth " << depth;
    }
  }
}

/// Method `fine`: the finest level and the exact distance.
TEST(WindowForce, OfTheExactWindowIsCloserStill) {
  const Clay clay = ball_clay();
  const Distance field = haptics::fields::ball(16);
  for (const double depth : {-4.0, 0.0, 5.0}) {
    for (const double radius : test::effort<std::vector<double>>({3.0}, {3.0, 6.0})) {
      const auto tool =
          haptics::fields::ball_tool(radius, (16.0 - depth) * normalized(Vec3{3, -1, 2}));
      EXPECT_LE(force_error(clay, field, tool, 4.0 * radius, Extension::exact), 0.001);
    }
  }
}

/// Growing the tool in small steps through two level changes must not be felt as a pop: what the
/// window does to the force may change by a tenth of a percent per percent of radius.
TEST(WindowForce, HasNoStepAsTheToolGrows) {
  const Clay clay = ball_clay();
  const Distance field = haptics::fields::ball(16);
  // Spacings of 0.8 to 4 mm; usually of 0.8 to 1.1 mm, through one level change.
  const int steps = test::effort(32, 160);
  double last = 1.0;
  for (int step = 0; step < steps; ++step) {
    const auto tool = haptics::fields::ball_tool(3.2 * std::pow(1.01, step), {16, 0, 0});
    const auto law = haptics::ForceLaw::energy;
    const double exact = length(haptics::fields::force_at(field, tool, 8.0, {}, law).contact_n);
    const double ratio = length(felt(clay, tool, 8.0, Extension::layers)) / exact;
    if (step > 0) {
      EXPECT_NEAR(ratio, last, 1e-3) << tool.radii_mm.x;
    }
    last = ratio;
  }
}

TEST(WindowPublisher, PublishesWhatReadWindowReads) {
  const Clay clay = ball_clay();
  WindowChannel channel;
  WindowPublisher publisher(channel);
  EXPECT_FALSE(channel.fetch());
  for (std::uint64_t n = 1; n <= 5; ++n) {
    const WindowRequest request{
        {16.0 - static_cast<double>(n), 1, 2}, 0.3 * static_cast<double>(n), 5.0, 9.0};
    ASSERT_TRUE(publisher.publish(clay, request).ok());
    ASSERT_TRUE(channel.fetch());
    const WindowSlot& slot = channel.read_slot();
    const FieldWindow window = read_window(clay, request, Extension::layers).value();
    EXPECT_EQ(slot.sequence, n);
    EXPECT_EQ(slot.origin_mm, window.view.origin_mm);
    EXPECT_EQ(slot.voxel_mm, window.view.voxel_mm);
    EXPECT_EQ(slot.nodes, window.view.nodes);
    EXPECT_EQ(slot.level, window.view.level);
    EXPECT_EQ(slot.distance_error_mm, window.view.distance_error_mm);
    EXPECT_EQ(slot.checksum, window_checksum(window.view));
    EXPECT_TRUE(std::ranges::equal(slot.view().distance_mm, window.storage));
  }
}

TEST(WindowPublisher, KeepsTheMemoryOfItsSlots) {
  const Clay clay = ball_clay();
  WindowChannel channel;
  WindowPublisher publisher(channel);
  std::set<const float*> blocks;
  for (const double voxel : {0.5, 0.2, 1.5, 0.4, 0.17, 0.9, 2.0}) {
    blocks.insert(channel.write_slot().distance_mm.data());
    ASSERT_TRUE(publisher.publish(clay, {{16, 0, 0}, voxel, 30.9 * voxel, 9.0}).ok());
    channel.fetch();
    blocks.insert(channel.read_slot().distance_mm.data());
    EXPECT_EQ(channel.read_slot().distance_mm.size(), kWindowCapacity);
  }
  EXPECT_EQ(blocks.size(), 3U);
}

/// A tool that rests asks for the same window again and again.
TEST(WindowPublisher, PublishesTheClayAsItIsAlsoWhereNothingMoved) {
  Clay clay = ball_clay();
  const Clay other = Clay::ball(15.5, {}).value();
  WindowChannel channel;
  WindowPublisher publisher(channel);
  const WindowRequest request{{16, 0, 0}, 0.3, 5.0, 9.0};
  WindowRequest shallow = request;
  shallow.depth_mm = 4.0;
  std::set<std::uint64_t> seen;
  const auto expect_published = [&](const Clay& of, const WindowRequest& asked) {
    ASSERT_TRUE(publisher.publish(of, asked).ok());
    ASSERT_TRUE(channel.fetch());
    const FieldWindow window = read_window(of, asked, Extension::layers).value();
    EXPECT_TRUE(std::ranges::equal(channel.read_slot().view().distance_mm, window.storage));
    EXPECT_EQ(channel.read_slot().checksum, window_checksum(window.view));
    seen.insert(channel.read_slot().checksum);
  };
  expect_published(clay, request);
  expect_published(clay, request);
  EXPECT_EQ(seen.size(), 1U);
  Stroke stroke;
  stroke.samples = {{0.0, {16.0, 0.0, 0.0}, {}, 1.0}};
  ASSERT_TRUE(clay.apply(stroke).ok());
  expect_published(clay, request);
  EXPECT_EQ(seen.size(), 2U);
  ASSERT_TRUE(clay.undo());
  expect_published(clay, request);
  EXPECT_EQ(seen.size(), 2U);
  expect_published(other, request);
  EXPECT_EQ(seen.size(), 3U);
  expect_published(other, shallow);
}

TEST(WindowPublisher, RefusesWhatDoesNotFitAndPublishesNothing) {
  const Clay clay = ball_clay();
  WindowChannel channel;
  WindowPublisher publisher(channel);
  const auto refused = publisher.publish(clay, {{16, 0, 0}, 0.5, 15.6, 9.0});
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().kind, ErrorKind::bad_input);
  EXPECT_THAT(refused.error().message, ::testing::HasSubstr("it may reach 15.5 mm"));
  EXPECT_FALSE(publisher.publish(clay, {{16, 0, 0}, 0.5, -1.0, 9.0}).ok());
  EXPECT_FALSE(channel.fetch());
  ASSERT_TRUE(publisher.publish(clay, {{16.1, 0.2, 0.3}, 0.5, 15.5, 9.0}).ok());
  ASSERT_TRUE(channel.fetch());
  EXPECT_EQ(channel.read_slot().sequence, 1U);
}

}  // namespace
}  // namespace argil
