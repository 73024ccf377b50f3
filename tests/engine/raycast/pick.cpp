// SPDX-License-Identifier: GPL-3.0-or-later
// Picking against balls and blocks, a fine march along the ray, the surface's triangles, and itself
// after other histories.
#include "argil/engine/pick.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "argil/engine/mesh_distance.h"
#include "argil/engine/surface.h"

#include "clay/clay_access.h"
#include "support/analytic_stack.h"
#include "support/effort.h"
#include "support/stroke_maker.h"

namespace argil::test {
namespace {

constexpr double kVoxelMm = 0.25;

Clay ball_of(double radius_mm) {
  return Clay::ball(radius_mm, ClayOptions{.voxel_mm = kVoxelMm}).value();
}

std::optional<Pick> pick_at(const Clay& clay, const Vec3& origin, const Vec3& direction) {
  const auto picked = pick(clay, {origin, direction});
  EXPECT_TRUE(picked.ok());
  return picked.ok() ? picked.value() : std::nullopt;
}

/// Uniform in [low, high), the same on every machine.
double uniform_between(std::mt19937& random, double low, double high) {
  return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
}

Vec3 in_cube(std::mt19937& random, double half) {
  const double x = uniform_between(random, -half, half);
  const double y = uniform_between(random, -half, half);
  return {x, y, uniform_between(random, -half, half)};
}

/// Rays from all around and from within, most through the cube of half side `reach`; some along an
/// axis, of these some exactly on planes of nodes.
std::vector<Ray> rays_through(std::mt19937& random, double reach, double voxel_mm, int count) {
  std::vector<Ray> rays;
  for (int i = 0; i < count; ++i) {
    Ray ray{in_cube(random, 3.0 * reach), {}};
    const Vec3 target = in_cube(random, reach);
    ray.direction = target - ray.origin_mm;
    if (i % 4 == 1) ray.origin_mm = in_cube(random, reach);
    if (i % 4 == 2) {
      const std::size_t axis = random() % 3;
      ray.origin_mm = target;
      if (i % 8 == 2) {
        for (std::size_t a = 0; a < 3; ++a) {
          ray.origin_mm[a] = voxel_mm * std::round(ray.origin_mm[a] / voxel_mm);
        }
      }
      ray.direction = {};
      ray.direction[axis] = random() % 2 == 0 ? 1.0 : -1.0;
      ray.origin_mm[axis] = -3.0 * reach * ray.direction[axis];
    }
    rays.push_back(ray);
  }
  return rays;
}

using Picks = std::vector<std::optional<Pick>>;

Picks picks_of(const Clay& clay, std::span<const Ray> rays) {
  Picks picks;
  picks.reserve(rays.size());
  for (const Ray& ray : rays) picks.push_back(pick_at(clay, ray.origin_mm, ray.direction));
  return picks;
}

void expect_same_bits(const Picks& a, const Picks& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].has_value(), b[i].has_value()) << "ray " << i;
    if (!a[i]) continue;
    EXPECT_EQ(a[i]->point_mm, b[i]->point_mm) << "ray " << i;
    EXPECT_EQ(a[i]->normal, b[i]->normal) << "ray " << i;
    EXPECT_EQ(a[i]->distance_mm, b[i]->distance_mm) << "ray " << i;
    EXPECT_EQ(a[i]->level, b[i]->level) << "ray " << i;
  }
}

/// The first sign change from outside to inside that steps of a 20th of a voxel find, as a
/// distance; knows the field by Clay::distance_at only.
std::optional<double> march(const Clay& clay, const Ray& ray, double until_mm) {
  const Vec3 direction = normalized(ray.direction);
  const double step = 0.05 * clay.options().voxel_mm;
  const auto inside = [&](double t) {
    return clay.distance_at(ray.origin_mm + t * direction) < 0.0;
  };
  bool was_inside = inside(0.0);
  for (int i = 1; i * step < until_mm; ++i) {
    const bool is_inside = inside(i * step);
    if (is_inside && !was_inside) {
      double outside = (i - 1) * step;
      double within = i * step;
      for (int halving = 0; halving < 40; ++halving) {
        const double middle = 0.5 * (outside + within);
        (inside(middle) ? within : outside) = middle;
      }
      return outside;
    }
    was_inside = is_inside;
  }
  return std::nullopt;
}

/// What a run of comparisons found.
struct Tally {
  int hits = 0;
  int jumps = 0;  ///< hits where the field jumps over zero
};

/// Compares a pick with the march. Earlier than it a pick may only be where the field really
/// changes sign, for less than a step; later never.
void expect_first_entry(const Clay& clay, const Ray& ray, double until_mm, Tally& tally) {
  const double voxel = clay.options().voxel_mm;
  const auto found = pick_at(clay, ray.origin_mm, ray.direction);
  const auto marched = march(clay, ray, until_mm);
  if (!found) {
    EXPECT_FALSE(marched.has_value());
    return;
  }
  ++tally.hits;
  EXPECT_LE(found->distance_mm, marched.value_or(until_mm) + 1e-6 * voxel);
  const Vec3 direction = normalized(ray.direction);
  EXPECT_LE(length(found->point_mm - ray.origin_mm - found->distance_mm * direction), 1e-9 * voxel);
  EXPECT_NEAR(length(found->normal), 1.0, 1e-12);
  const Vec3 little = 1e-6 * voxel * direction;
  const double before = clay.distance_at(found->point_mm - little);
  const double after = clay.distance_at(found->point_mm + little);
  EXPECT_GE(before, 0.0);
  EXPECT_LT(after, 0.0);
  if (before - after > 1e-4 * voxel) {
    ++tally.jumps;
  } else {
    EXPECT_LE(std::abs(clay.distance_at(found->point_mm)), 1e-4 * voxel);
  }
  EXPECT_GE(found->level, 0);
  EXPECT_LT(found->level, clay.level_count());
}

TEST(Pick, HitsABallWhereItIs) {
  const Clay clay = ball_of(12.0);
  std::mt19937 random(1);
  for (int i = 0; i < 500; ++i) {
    const Vec3 out = normalized(in_cube(random, 1.0));
    const Vec3 beside = 4.0 * normalized(cross(out, in_cube(random, 1.0)));
    const auto found = pick_at(clay, 40.0 * out + beside, -3.0 * out);
    ASSERT_TRUE(found.has_value());
    EXPECT_NEAR(length(found->point_mm), 12.0, 0.1 * kVoxelMm);
    EXPECT_NEAR(found->distance_mm, 40.0 - std::sqrt(12.0 * 12.0 - 16.0), 0.15 * kVoxelMm);
    EXPECT_LT(length(found->normal - normalized(found->point_mm)), 0.03);
  }
}

TEST(Pick, HitsTheFacesOfABlock) {
  const Clay clay = Clay::block({20.0, 16.0, 12.0}, ClayOptions{.voxel_mm = kVoxelMm}).value();
  const auto found = pick_at(clay, {3.3, 2.1, 50.0}, {0.0, 0.0, -1.0});
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(found->point_mm.z, 6.0, 0.01 * kVoxelMm);
  EXPECT_NEAR(found->distance_mm, 44.0, 0.01 * kVoxelMm);
  EXPECT_LT(length(found->normal - Vec3{0.0, 0.0, 1.0}), 1e-6);
  const auto side = pick_at(clay, {-50.0, 0.0, 0.0}, {1.0, 0.0, 0.0});
  ASSERT_TRUE(side.has_value());
  EXPECT_NEAR(side->point_mm.x, -10.0, 0.01 * kVoxelMm);
}

TEST(Pick, MissesWhatIsBesideOrBehind) {
  const Clay clay = ball_of(10.0);
  EXPECT_FALSE(pick_at(clay, {0.0, 10.5, 40.0}, {0.0, 0.0, -1.0}));
  EXPECT_FALSE(pick_at(clay, {0.0, 0.0, 40.0}, {0.0, 0.0, 1.0}));
  EXPECT_FALSE(pick_at(clay, {0.0, 0.0, 40.0}, {1.0, 0.0, 0.0}));
  EXPECT_FALSE(pick_at(clay, {1e6, 0.0, 0.0}, {0.0, 0.0, -1.0}));
}

/// A camera in the clay sees no front until its ray has come out of it.
TEST(Pick, FromWithinFirstLeavesTheClay) {
  const Clay ball = ball_of(10.0);
  EXPECT_FALSE(pick_at(ball, {1.0, 2.0, 3.0}, {0.3, -0.2, 0.9}));
  const auto two = [](const Vec3& p) {
    return std::min(length(p - Vec3{-12.0, 0.0, 0.0}), length(p - Vec3{12.0, 0.0, 0.0})) - 8.0;
  };
  const Clay pair = Clay::from_distance(two, {{-22.0, -10.0, -10.0}, {22.0, 10.0, 10.0}},
                                        ClayOptions{.voxel_mm = kVoxelMm})
                        .value();
  const auto found = pick_at(pair, {-12.0, 0.3, 0.2}, {1.0, 0.0, 0.0});
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(found->point_mm.x, 4.0, 0.1 * kVoxelMm);
  EXPECT_LT(found->normal.x, -0.9);
}

TEST(Pick, OfNoClayIsNothing) {
  const Clay clay =
      clay_of_levels(std::make_unique<LevelStack>(kVoxelMm, 3), ClayOptions{.voxel_mm = 0.25});
  EXPECT_FALSE(pick_at(clay, {0.0, 0.0, 40.0}, {0.0, 0.0, -1.0}));
  EXPECT_FALSE(pick_at(clay, {}, {1.0, 1.0, 1.0}));
}

TEST(Pick, OfClayThatWasCarvedAwayIsNothing) {
  Clay clay = ball_of(5.0);
  ASSERT_TRUE(pick_at(clay, {0.0, 0.0, 40.0}, {0.0, 0.0, -1.0}));
  Stroke stroke;
  stroke.tool.action = Action::carve;
  stroke.tool.radii_mm = {8.0, 8.0, 8.0};
  stroke.samples.resize(1);
  ASSERT_TRUE(clay.apply(stroke).ok());
  EXPECT_FALSE(pick_at(clay, {0.0, 0.0, 40.0}, {0.0, 0.0, -1.0}));
  ASSERT_TRUE(clay.undo());
  EXPECT_TRUE(pick_at(clay, {0.0, 0.0, 40.0}, {0.0, 0.0, -1.0}));
}

TEST(Pick, RefusesARayThatIsNone) {
  const Clay clay = ball_of(5.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  const Vec3 down{0.0, 0.0, -1.0};
  const std::array<std::pair<Ray, const char*>, 6> bad{{
      {{{0.0, 0.0, 9.0}, {}}, "direction"},
      {{{0.0, 0.0, 9.0}, {0.0, nan, 1.0}}, "direction"},
      {{{0.0, 0.0, 9.0}, {0.0, infinite, 0.0}}, "direction"},
      {{{0.0, nan, 9.0}, down}, "origin_mm"},
      {{{-infinite, 0.0, 9.0}, down}, "origin_mm"},
      {{{0.0, 0.0, 1e12}, down}, "origin_mm"},
  }};
  for (const auto& [ray, name] : bad) {
    const auto refused = pick(clay, ray);
    ASSERT_FALSE(refused.ok()) << name;
    EXPECT_EQ(refused.error().kind, ErrorKind::bad_input);
    EXPECT_NE(refused.error().message.find(name), std::string::npos) << refused.error().message;
  }
}

/// The length of the direction means nothing, however far from 1.
TEST(Pick, TakesADirectionOfAnyLength) {
  const Clay clay = ball_of(10.0);
  const Vec3 origin{3.0, 4.0, 30.0};
  const auto expected = pick_at(clay, origin, {-0.25, -0.5, -2.0});
  ASSERT_TRUE(expected.has_value());
  for (const double scale : {0x1p-1000, 0x1p-300, 0x1p20, 0x1p1000}) {
    const auto found = pick_at(clay, origin, Vec3{-0.25, -0.5, -2.0} * scale);
    ASSERT_TRUE(found.has_value());
    EXPECT_EQ(found->point_mm, expected->point_mm);
  }
}

TEST(Pick, IsExactFromFarAway) {
  const Clay clay = ball_of(10.0);
  const Vec3 way = normalized(Vec3{0.3, -0.5, 0.8});
  const Vec3 near = -20.0 * way + Vec3{2.0, 1.0, 0.0};
  const auto expected = pick_at(clay, near, way);
  ASSERT_TRUE(expected.has_value());
  for (const double away : {1e3, 1e6, 1e8}) {
    const auto found = pick_at(clay, near - away * way, way);
    ASSERT_TRUE(found.has_value());
    EXPECT_LT(length(found->point_mm - expected->point_mm), 4e-16 * away + 1e-9) << away;
    EXPECT_LT(std::abs(clay.distance_at(found->point_mm)), 0.01 * kVoxelMm);
  }
}

/// Half a voxel thin: a march in steps of a voxel would mostly pass through.
TEST(Pick, HitsASheetThinnerThanAVoxel) {
  AnalyticStack scene;
  scene.voxel_mm = kVoxelMm;
  scene.choose = [](int, const Coord&) { return true; };
  scene.field = [](int, const Coord& node, const Vec3&) {
    return node.z() == 3 ? -0.01F : 0.03F;  // from z = 2.75 to 3.25 voxels
  };
  const Clay clay = clay_of_levels(std::make_unique<LevelStack>(scene.build()),
                                   ClayOptions{.voxel_mm = kVoxelMm});
  const auto found = pick_at(clay, {0.1, 0.2, 9.0}, {0.01, 0.02, -1.0});
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(found->point_mm.z, 3.25 * kVoxelMm, 1e-6);
  EXPECT_GT(found->normal.z, 0.999);
}

/// Values that alternate from node to node have no slope over two voxels.
TEST(Pick, TurnsTheNormalToTheEyeWhereTheFieldHasNoSlope) {
  AnalyticStack scene;
  scene.voxel_mm = kVoxelMm;
  scene.choose = [](int, const Coord&) { return true; };
  scene.field = [](int, const Coord& node, const Vec3&) {
    return (node.z() & 1) != 0 ? -0.25F : 0.25F;
  };
  const Clay clay = clay_of_levels(std::make_unique<LevelStack>(scene.build()),
                                   ClayOptions{.voxel_mm = kVoxelMm});
  const auto found = pick_at(clay, {0.1, 0.1, 0.0}, {0.0, 0.0, -1.0});
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->normal, (Vec3{0.0, 0.0, 1.0}));
}

TEST(Pick, FollowsAnOpenStrokeAndAMovedClay) {
  Clay clay = ball_of(10.0);
  const Ray ray{{0.0, 0.0, 40.0}, {0.0, 0.0, -1.0}};
  const Picks start = picks_of(clay, {&ray, 1});
  ASSERT_TRUE(start[0].has_value());
  Tool tool;
  tool.action = Action::carve;
  tool.radii_mm = {3.0, 3.0, 3.0};
  ASSERT_TRUE(clay.begin_stroke(tool).ok());
  const StrokeSample sample{0.0, {0.0, 0.0, 10.0}, {}, 1.0};
  ASSERT_TRUE(clay.extend_stroke({&sample, 1}).ok());
  const auto carved = pick_at(clay, ray.origin_mm, ray.direction);
  ASSERT_TRUE(carved.has_value());
  EXPECT_NEAR(carved->point_mm.z, 7.0, 0.15 * kVoxelMm);
  Clay moved = std::move(clay);
  EXPECT_EQ(pick_at(moved, ray.origin_mm, ray.direction)->point_mm, carved->point_mm);
  ASSERT_TRUE(moved.cancel_stroke());
  expect_same_bits(picks_of(moved, {&ray, 1}), start);
}

/// How far the points that rays find lie from the triangles at most, in voxels. The rays pass the
/// middle by at most `reach`.
double apart_from_triangles(const Clay& clay, double reach) {
  std::mt19937 random(5);
  const TriangleMesh mesh = extract_surface(clay);
  const MeshDistance triangles(mesh.positions, mesh.triangles);
  double worst = 0.0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3 out = normalized(in_cube(random, 1.0));
    const Vec3 beside =
        uniform_between(random, 0.0, reach) * normalized(cross(out, in_cube(random, 1.0)));
    const auto found = pick_at(clay, 40.0 * out + beside, -out);
    EXPECT_TRUE(found.has_value());
    if (found) worst = std::max(worst, triangles.closest(found->point_mm, 1.0).distance);
  }
  return worst / kVoxelMm;
}

/// The two descriptions of the surface. The field is straight along the edges of its cells, where
/// the triangles' corners follow its bend, and a triangle cuts the corner of a block off that the
/// field rounds (docs/surface.md).
TEST(Pick, AgreesWithTheTrianglesOfTheSurface) {
  const double on_ball = apart_from_triangles(ball_of(16.0), 12.0);
  EXPECT_LT(on_ball, 0.07);
  const Clay block = Clay::block({20.0, 16.0, 12.3}, ClayOptions{.voxel_mm = kVoxelMm}).value();
  const double on_block = apart_from_triangles(block, 5.0);
  EXPECT_LT(on_block, 0.8);
  RecordProperty("ball_voxels", std::to_string(on_ball));
  RecordProperty("block_voxels", std::to_string(on_block));
}

class PickProperty : public testing::TestWithParam<int> {};

TEST_P(PickProperty, IsTheFirstEntryOfAFineMarch) {
  std::mt19937 random(static_cast<std::uint32_t>(GetParam()));
  Clay clay = random_start(random);
  Tally tally;
  for (int edit = 0; edit < 4; ++edit) {
    const Stroke stroke = random_dab(random, 9.0);
    SCOPED_TRACE(testing::Message() << "seed " << GetParam() << ": " << describe(stroke));
    ASSERT_TRUE(clay.apply(stroke).ok());
    for (const Ray& ray : rays_through(random, 9.0, clay.options().voxel_mm, 40)) {
      expect_first_entry(clay, ray, 80.0, tally);
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(tally.hits, 20);
  EXPECT_LE(tally.jumps, tally.hits / 20);
}

/// Levels that meet everywhere, and noise: what edits never make.
TEST_P(PickProperty, IsTheFirstEntryOfAFineMarchAcrossLevels) {
  const auto seed = static_cast<std::uint64_t>(GetParam());
  std::mt19937 random(static_cast<std::uint32_t>(GetParam()));
  AnalyticStack scene;
  scene.voxel_mm = 0.5;
  scene.levels = 1 + GetParam() % 4;
  scene.top_leaves = 1;
  scene.choose = chosen_by_chance(seed, 0.4);
  const double size = 0.5 * (1 << (scene.levels - 1));
  scene.field = [=](int level, const Coord& n, const Vec3& p) {
    return static_cast<float>(length(p) - 5.0 * size + 0.6 * random_at(seed, level, n));
  };
  const Clay clay =
      clay_of_levels(std::make_unique<LevelStack>(scene.build()), ClayOptions{.voxel_mm = 0.5});
  Tally tally;
  for (const Ray& ray : rays_through(random, 4.0 * size, 0.5, 120)) {
    expect_first_entry(clay, ray, 60.0 * size, tally);
  }
  EXPECT_GT(tally.hits, 20);
}

TEST_P(PickProperty, DoesNotDependOnHistory) {
  std::mt19937 random(static_cast<std::uint32_t>(GetParam()));
  std::mt19937 same = random;
  Clay lived = random_start(random);
  Clay fresh = random_start(same);
  const int edits = effort(3, 6);
  for (int edit = 0; edit < edits; ++edit) {
    const Stroke kept = random_dab(random, 9.0);
    const Stroke taken_back = random_dab(random, 9.0);
    const std::vector<Ray> rays = rays_through(random, 9.0, lived.options().voxel_mm, 40);
    ASSERT_TRUE(lived.apply(taken_back).ok());
    const Picks passing = picks_of(lived, rays);
    ASSERT_TRUE(lived.undo());
    ASSERT_TRUE(lived.redo());
    expect_same_bits(picks_of(lived, rays), passing);
    ASSERT_TRUE(lived.undo());
    ASSERT_TRUE(lived.apply(kept).ok());
    ASSERT_TRUE(fresh.apply(kept).ok());
    for (const std::size_t threads : {1U, 4U}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      expect_same_bits(picks_of(lived, rays), picks_of(fresh, rays));
    }
    if (HasFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, PickProperty, testing::Range(0, 12));

}  // namespace
}  // namespace argil::test
