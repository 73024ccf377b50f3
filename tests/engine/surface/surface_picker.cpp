// SPDX-License-Identifier: GPL-3.0-or-later
// Answers on the drawn surface against the walk through the field, which shares no code with them,
// against pickers with other histories, and along rays that aim where triangles meet.
#include "argil/engine/surface_picker.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "clay/clay_access.h"
#include "support/bumpy_clay.h"
#include "support/drawn_copies.h"
#include "support/effort.h"
#include "support/stroke_maker.h"

namespace argil::test {
namespace {

using Answers = std::vector<std::optional<Pick>>;

Vec3 point_in_cube(std::mt19937& random, double half) {
  const double x = uniform(random, -half, half);
  const double y = uniform(random, -half, half);
  return {x, y, uniform(random, -half, half)};
}

Clay plain_ball(double radius_mm) {
  return Clay::ball(radius_mm, ClayOptions{.voxel_mm = 0.25}).value();
}

Vec3 as_vec(const std::array<float, 3>& p) {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

/// Clay, its drawn surface and a picker that follows it.
struct DrawnClay {
  explicit DrawnClay(Clay of) : clay(std::move(of)) { update(); }

  void update(const std::optional<DisplayView>& view = {}) {
    EXPECT_TRUE(surface.update(clay, view).ok());
  }
  std::optional<Pick> pick_at(const Ray& ray) {
    const auto picked = picker.pick(surface, ray);
    EXPECT_TRUE(picked.ok());
    return picked.ok() ? picked.value() : std::nullopt;
  }
  Answers answers_to(const std::vector<Ray>& rays) {
    Answers picks;
    picks.reserve(rays.size());
    for (const Ray& ray : rays) picks.push_back(pick_at(ray));
    return picks;
  }

  Clay clay;
  DisplaySurface surface;
  SurfacePicker picker;
};

/// From all around and from within, through the cube of half side `reach`; a third along an axis.
std::vector<Ray> random_rays(std::mt19937& random, double reach, int count) {
  std::vector<Ray> rays;
  for (int i = 0; i < count; ++i) {
    const Vec3 target = point_in_cube(random, reach);
    Ray ray{point_in_cube(random, i % 4 == 1 ? reach : 3.0 * reach), {}};
    ray.direction = target - ray.origin_mm;
    if (i % 3 == 2) {
      const std::size_t axis = random() % 3;
      ray.direction = {};
      ray.direction[axis] = random() % 2 == 0 ? 1.0 : -1.0;
      ray.origin_mm = target;
      ray.origin_mm[axis] = -3.0 * reach * ray.direction[axis];
    }
    rays.push_back(ray);
  }
  return rays;
}

// ---- against the walk ---------------------------------------------------------------------------

/// How answers differ.
struct PickDifferences {
  int rays = 0;
  int hits = 0;                 ///< of both
  int disagree = 0;             ///< only one hit
  std::vector<double> voxels;   ///< of the place's level, along the ray
  std::vector<double> degrees;  ///< between the normals

  void add(DrawnClay& drawn, const Ray& ray) {
    const auto walked = pick(drawn.clay, ray).value();
    const auto picked = drawn.pick_at(ray);
    ++rays;
    if (walked.has_value() != picked.has_value()) {
      ++disagree;
      return;
    }
    if (!walked) return;
    ++hits;
    const double voxel = drawn.clay.options().voxel_mm * std::ldexp(1.0, walked->level);
    voxels.push_back(std::abs(walked->distance_mm - picked->distance_mm) / voxel);
    const double cosine = std::clamp(dot(walked->normal, picked->normal), -1.0, 1.0);
    degrees.push_back(std::acos(cosine) * 180.0 / 3.14159265358979);
  }
  static double at(std::vector<double> values, double share) {
    if (values.empty()) return 0.0;
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  }
  std::string words() const {
    std::array<char, 200> text{};
    std::snprintf(text.data(), text.size(),
                  "%d rays, %d hits, only one hit %d; voxels p50 %.5f p99 %.4f p999 %.3f, "
                  "degrees p50 %.3f p99 %.2f",
                  rays, hits, disagree, at(voxels, 0.5), at(voxels, 0.99), at(voxels, 0.999),
                  at(degrees, 0.5), at(degrees, 0.99));
    return text.data();
  }
  void expect_agreement(double most_voxels) const {
    SCOPED_TRACE(words());
    EXPECT_GT(hits, rays / 5);
    // At silhouettes triangles cut off what the field rounds.
    EXPECT_LE(disagree, 1 + rays / 2000);
    EXPECT_LE(at(voxels, 0.99), most_voxels);
    EXPECT_LE(at(degrees, 0.99), 3.0);
  }
};

/// A clay that is smooth on the scale of its voxels, as strokes leave it; where it is not,
/// triangles cut corners off that the field rounds.
struct PickedModel {
  const char* name;
  double reach_mm;
  /// Of the 99th percentile: 0.05, and more where much bends within few voxels. Between its nodes
  /// the field is straight, the triangles' corners follow its bend: bumps of a radius of five
  /// voxels are 3/40 of a voxel higher by that.
  double most_voxels;
  Clay (*make)();
};

Clay stroked(Clay clay, double out_mm, double radius_mm) {
  int n = 0;
  for (const Action action : {Action::add, Action::carve, Action::smooth, Action::inflate}) {
    const Vec3 a = out_mm * normalized(Vec3{1.0, 0.4 * n - 0.5, 0.3 * n});
    const Vec3 b = out_mm * normalized(Vec3{0.6, 0.5, 0.8 - 0.4 * n});
    EXPECT_TRUE(clay.apply(stroke_of(action, radius_mm, 0.7, {a, b})).ok());
    ++n;
  }
  return clay;
}

Clay from_field(double (*field)(const Vec3&), double reach_mm) {
  const Box3 box{{-reach_mm, -reach_mm, -reach_mm}, {reach_mm, reach_mm, reach_mm}};
  return Clay::from_distance([=](const Vec3& p) { return field(p); }, box,
                             ClayOptions{.voxel_mm = 0.12})
      .value();
}

double torus_distance(const Vec3& p) {
  const double across = std::hypot(p.x, p.y) - 9.0;
  return std::hypot(across, p.z) - 4.0;
}
double two_balls_distance(const Vec3& p) {
  return std::min(length(p - Vec3{-7.5, 0.0, 0.0}), length(p - Vec3{7.5, 0.0, 0.0})) - 6.5;
}

const std::array<PickedModel, 5> kPickedModels{{
    {"ball", 14.0, 0.05, [] { return Clay::ball(12.0, ClayOptions{.voxel_mm = 0.12}).value(); }},
    {"bumpy_ball", 12.0, 0.065, [] { return bumpy_ball(10.0, 0.12).value(); }},
    {"sculpted_ball", 14.0, 0.05,
     [] { return stroked(Clay::ball(12.0, ClayOptions{.voxel_mm = 0.1}).value(), 12.0, 3.0); }},
    {"torus", 13.0, 0.055, [] { return from_field(torus_distance, 14.0); }},
    {"two_balls", 13.0, 0.055, [] { return from_field(two_balls_distance, 15.0); }},
}};

class SurfacePickerModel : public testing::TestWithParam<PickedModel> {};

TEST_P(SurfacePickerModel, AgreesWithTheWalk) {
  DrawnClay drawn(GetParam().make());
  std::mt19937 random(3);
  PickDifferences differences;
  for (const Ray& ray : random_rays(random, GetParam().reach_mm, effort(4'000, 100'000))) {
    differences.add(drawn, ray);
  }
  differences.expect_agreement(GetParam().most_voxels);
  RecordProperty("differences", differences.words());
}

/// After every dab: half of the rays where it worked, the others anywhere.
TEST_P(SurfacePickerModel, AgreesWithTheWalkWhileEditing) {
  DrawnClay drawn(GetParam().make());
  std::mt19937 random(5);
  PickDifferences differences;
  const int rays = effort(60, 1'250);
  for (int dab = 0; dab < effort(12, 40); ++dab) {
    std::optional<Pick> under;
    while (!under) under = drawn.pick_at(random_rays(random, GetParam().reach_mm, 1)[0]);
    const Action action = std::array{Action::add, Action::smooth, Action::carve}[dab % 3];
    ASSERT_TRUE(drawn.clay.apply(stroke_of(action, 3.0, 0.5, {under->point_mm})).ok());
    drawn.update();
    for (int i = 0; i < rays; ++i) {
      const Vec3 target = under->point_mm + point_in_cube(random, 4.0);
      const Vec3 origin = target + 30.0 * under->normal + point_in_cube(random, 10.0);
      differences.add(drawn, {origin, target - origin});
    }
    for (const Ray& ray : random_rays(random, GetParam().reach_mm, rays)) {
      differences.add(drawn, ray);
    }
  }
  differences.expect_agreement(GetParam().most_voxels);
  RecordProperty("differences", differences.words());
}

// ---- closed surfaces ----------------------------------------------------------------------------

/// A point deep in the clay from which a straight way leads out through any part of the surface.
Vec3 point_within(const Clay& clay, std::mt19937& random, double reach) {
  for (;;) {
    const Vec3 p = point_in_cube(random, reach);
    if (clay.distance_at(p) < -2.0 * clay.options().voxel_mm) return p;
  }
}

/// The triangles of a surface, and which way those around each of its vertices face.
class ClosedSurface {
 public:
  using Place = std::array<float, 3>;  // its bits are those of every block around

  explicit ClosedSurface(const DisplaySurface& surface) {
    for (const BlockId& id : surface.blocks()) {
      const DisplayBlock block = surface.block(id);
      for (const Triangle& t : block.triangles) {
        std::array<Place, 3> p;
        for (std::size_t c = 0; c < 3; ++c) p[c] = block.vertices[t[c]].position_mm;
        const Vec3 a = as_vec(p[0]);
        const Vec3 facet = normalized(cross(as_vec(p[1]) - a, as_vec(p[2]) - a));
        for (const Place& at : p) around_[at].push_back(facet);
        triangles_.push_back(p);
      }
    }
  }

  /// Two ends of an edge, or twice the same.
  std::array<Place, 2> random_aim(std::mt19937& random, bool is_edge) const {
    const std::array<Place, 3>& p = triangles_[random() % triangles_.size()];
    const std::size_t corner = random() % 3;
    return {p[corner], p[(corner + (is_edge ? 1 : 0)) % 3]};
  }

  /// Whether a ray that comes from there sees the fronts of all triangles around.
  bool faces(const std::array<Place, 2>& aim, const Vec3& out) const {
    return std::all_of(aim.begin(), aim.end(), [&](const Place& place) {
      const std::vector<Vec3>& facets = around_.at(place);
      return std::all_of(facets.begin(), facets.end(),
                         [&](const Vec3& facet) { return dot(facet, out) > 0.1; });
    });
  }

 private:
  std::vector<std::array<Place, 3>> triangles_;
  std::map<Place, std::vector<Vec3>> around_;
};

/// Rays from far outside, at vertices or middles of edges, to points within the clay. Each must
/// meet something before it is there, and where it does not graze the surface no later than where
/// it was aimed at.
struct Shots {
  int lost = 0;
  int facing = 0;
};

Shots shoot(DrawnClay& drawn, double reach, int count, bool is_edge) {
  std::mt19937 random(7);
  const ClosedSurface closed(drawn.surface);
  const double away = 5.0 * reach;
  Shots shots;
  for (int i = 0; i < count; ++i) {
    const auto aim = closed.random_aim(random, is_edge);
    const Vec3 at = 0.5 * (as_vec(aim[0]) + as_vec(aim[1]));
    const Vec3 inside = point_within(drawn.clay, random, reach);
    const Vec3 out = normalized(at - inside);
    const auto hit = drawn.pick_at({inside + away * out, -out});
    const bool is_facing = closed.faces(aim, out);
    shots.facing += is_facing ? 1 : 0;
    const double latest = is_facing ? away - length(at - inside) : away;
    const double rounding = 5e-3 * drawn.clay.options().voxel_mm;
    if (!hit || hit->distance_mm > latest + rounding) ++shots.lost;
  }
  return shots;
}

TEST_P(SurfacePickerModel, LosesNoRayAtVertices) {
  DrawnClay drawn(GetParam().make());
  const int count = effort(10'000, 500'000);
  const Shots shots = shoot(drawn, GetParam().reach_mm, count, false);
  EXPECT_EQ(shots.lost, 0);
  EXPECT_GT(shots.facing, count / 2);
}

TEST_P(SurfacePickerModel, LosesNoRayAtEdges) {
  DrawnClay drawn(GetParam().make());
  const int count = effort(10'000, 500'000);
  const Shots shots = shoot(drawn, GetParam().reach_mm, count, true);
  EXPECT_EQ(shots.lost, 0);
  EXPECT_GT(shots.facing, count / 2);
}

INSTANTIATE_TEST_SUITE_P(Of, SurfacePickerModel, testing::ValuesIn(kPickedModels),
                         [](const auto& of) { return std::string(of.param.name); });

/// Along axes, on planes of nodes, where boxes and cubes have their faces.
TEST(SurfacePicker, LosesNoRayOnPlanesOfNodes) {
  const double voxel = 0.25;
  DrawnClay drawn(Clay::block({20.0, 20.0, 20.0}, ClayOptions{.voxel_mm = voxel}).value());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (int i = -36; i <= 36; ++i) {
      for (int j = -36; j <= 36; ++j) {
        Ray ray;
        ray.direction[axis] = i % 2 == 0 ? 1.0 : -1.0;
        ray.origin_mm[axis] = -40.0 * ray.direction[axis];
        ray.origin_mm[(axis + 1) % 3] = voxel * i;
        ray.origin_mm[(axis + 2) % 3] = voxel * j;
        const auto hit = drawn.pick_at(ray);
        ASSERT_TRUE(hit.has_value()) << axis << ' ' << i << ' ' << j;
        EXPECT_NEAR(hit->distance_mm, 30.0, 0.1 * voxel) << axis << ' ' << i << ' ' << j;
      }
    }
  }
}

// ---- single rays --------------------------------------------------------------------------------

TEST(SurfacePicker, MissesWhatIsBesideOrBehind) {
  DrawnClay drawn(plain_ball(10.0));
  EXPECT_FALSE(drawn.pick_at({{0.0, 10.5, 40.0}, {0.0, 0.0, -1.0}}));
  EXPECT_FALSE(drawn.pick_at({{0.0, 0.0, 40.0}, {0.0, 0.0, 1.0}}));
  EXPECT_FALSE(drawn.pick_at({{0.0, 0.0, 40.0}, {1.0, 0.0, 0.0}}));
  EXPECT_FALSE(drawn.pick_at({{1e6, 0.0, 0.0}, {0.0, 0.0, -1.0}}));
}

/// A camera in the clay sees no front until its ray has come out of it.
TEST(SurfacePicker, FromWithinFirstLeavesTheClay) {
  DrawnClay ball(plain_ball(10.0));
  EXPECT_FALSE(ball.pick_at({{1.0, 2.0, 3.0}, {0.3, -0.2, 0.9}}));
  DrawnClay pair(from_field(two_balls_distance, 15.0));
  const auto found = pair.pick_at({{-7.5, 0.3, 0.2}, {1.0, 0.0, 0.0}});
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(found->point_mm.x, 1.0, 0.1);
  EXPECT_LT(found->normal.x, -0.9);
}

TEST(SurfacePicker, OfNoSurfaceIsNothing) {
  const DisplaySurface none;
  SurfacePicker picker;
  const auto picked = picker.pick(none, {{0.0, 0.0, 40.0}, {0.0, 0.0, -1.0}});
  ASSERT_TRUE(picked.ok());
  EXPECT_FALSE(picked.value());
  DrawnClay empty(
      clay_of_levels(std::make_unique<LevelStack>(0.25, 3), ClayOptions{.voxel_mm = 0.25}));
  EXPECT_FALSE(empty.pick_at({{0.0, 0.0, 40.0}, {0.0, 0.0, -1.0}}));
}

TEST(SurfacePicker, RefusesARayThatIsNone) {
  DrawnClay drawn(plain_ball(5.0));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::array<Ray, 4> bad{{{{0.0, 0.0, 9.0}, {}},
                                {{0.0, 0.0, 9.0}, {0.0, nan, 1.0}},
                                {{0.0, nan, 9.0}, {0.0, 0.0, -1.0}},
                                {{0.0, 0.0, 1e12}, {0.0, 0.0, -1.0}}}};
  for (const Ray& ray : bad) {
    const auto refused = drawn.picker.pick(drawn.surface, ray);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().kind, ErrorKind::bad_input);
  }
}

TEST(SurfacePicker, IsExactFromFarAway) {
  DrawnClay drawn(Clay::ball(10.0, ClayOptions{.voxel_mm = 0.25}).value());
  const Vec3 way = normalized(Vec3{0.3, -0.5, 0.8});
  const Vec3 near = -20.0 * way + Vec3{2.0, 1.0, 0.0};
  const auto expected = drawn.pick_at({near, way});
  ASSERT_TRUE(expected.has_value());
  for (const double away : {1e3, 1e6, 1e8}) {
    const auto found = drawn.pick_at({near - away * way, 3.0 * way});
    ASSERT_TRUE(found.has_value());
    EXPECT_LT(length(found->point_mm - expected->point_mm), 4e-16 * away + 1e-5) << away;
  }
}

// ---- what it keeps ------------------------------------------------------------------------------

void expect_same_answers(const Answers& a, const Answers& b) {
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

/// Against one that has just been made: the same answers, and no cube or block left behind.
void expect_like_fresh(DrawnClay& drawn, const std::vector<Ray>& rays) {
  const Answers picks = drawn.answers_to(rays);
  SurfacePicker fresh;
  Answers expected;
  for (const Ray& ray : rays) expected.push_back(fresh.pick(drawn.surface, ray).value());
  expect_same_answers(picks, expected);
  const SurfacePickerStats stats = drawn.picker.stats();
  EXPECT_EQ(stats.cubes, fresh.stats().cubes);
  EXPECT_EQ(fresh.stats().empty_cubes, 0);
  EXPECT_LE(stats.empty_cubes, 16 + (stats.cubes + stats.empty_cubes) / 4);
  EXPECT_EQ(drawn.picker.stats().blocks, fresh.stats().blocks);
  EXPECT_EQ(drawn.picker.stats().blocks, drawn.surface.stats().blocks);
}

DisplayView far_view(double eye_mm, double pixel_rad) {
  DisplayView view;
  view.eye_mm = {eye_mm, 0.0, 0.0};
  view.pixel_rad = pixel_rad;
  view.coarser = 2;
  return view;
}

class SurfacePickerProperty : public testing::TestWithParam<int> {};

TEST_P(SurfacePickerProperty, DoesNotDependOnHistory) {
  std::mt19937 random(static_cast<std::uint32_t>(GetParam()));
  DrawnClay drawn(random_start(random));
  const int edits = effort(5, 20);
  for (int edit = 0; edit < edits; ++edit) {
    const std::vector<Ray> rays = random_rays(random, 9.0, 60);
    const Stroke stroke = random_dab(random, 9.0);
    SCOPED_TRACE(testing::Message() << "seed " << GetParam() << ": " << describe(stroke));
    ASSERT_TRUE(drawn.clay.apply(stroke).ok());
    drawn.update();
    expect_like_fresh(drawn, rays);
    if (random() % 2 == 0) {
      ASSERT_TRUE(drawn.clay.undo());
      drawn.update();
      expect_like_fresh(drawn, rays);
    }
    // Levels that are hidden, and shown again.
    drawn.update(far_view(uniform(random, 10.0, 100.0), 0.01));
    expect_like_fresh(drawn, rays);
    drawn.update();
    expect_like_fresh(drawn, rays);
    if (HasFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, SurfacePickerProperty, testing::Range(0, 12));

TEST(SurfacePicker, KeepsNothingOfClayThatWasCarvedAway) {
  DrawnClay drawn(plain_ball(5.0));
  const Ray down{{0.0, 0.0, 40.0}, {0.0, 0.0, -1.0}};
  ASSERT_TRUE(drawn.pick_at(down));
  ASSERT_TRUE(drawn.clay.apply(stroke_of(Action::carve, 8.0, 1.0, {{}})).ok());
  drawn.update();
  EXPECT_FALSE(drawn.pick_at(down));
  EXPECT_EQ(drawn.picker.stats().cubes, 0);
  EXPECT_EQ(drawn.picker.stats().blocks, 0);
  ASSERT_TRUE(drawn.clay.undo());
  drawn.update();
  EXPECT_TRUE(drawn.pick_at(down));
}

/// Picked again only after two updates, of another surface, or of clay with other voxels.
TEST(SurfacePicker, TakesInAllThatItMissed) {
  std::mt19937 random(2);
  const std::vector<Ray> rays = random_rays(random, 12.0, 200);
  DrawnClay drawn(Clay::ball(10.0, ClayOptions{.voxel_mm = 0.25}).value());
  drawn.answers_to(rays);
  for (const double x : {10.0, -10.0}) {
    ASSERT_TRUE(drawn.clay.apply(stroke_of(Action::carve, 3.0, 1.0, {{x, 0.0, 0.0}})).ok());
    drawn.update();
  }
  expect_like_fresh(drawn, rays);
  DrawnClay other(Clay::ball(9.0, ClayOptions{.voxel_mm = 0.2}).value());
  std::swap(drawn.surface, other.surface);
  expect_like_fresh(drawn, rays);
  drawn.clay = Clay::ball(11.0, ClayOptions{.voxel_mm = 0.5}).value();
  drawn.update();
  expect_like_fresh(drawn, rays);
  drawn.clay = Clay::ball(8.0, ClayOptions{.voxel_mm = 0.5}).value();
  drawn.update();
  expect_like_fresh(drawn, rays);
}

TEST(SurfacePicker, BuildsItsTreeOnlyWhenACubeComesOrGoes) {
  DrawnClay drawn(bumpy_ball(10.0, 0.25).value());
  const Ray down{{0.0, 0.0, 40.0}, {0.01, 0.02, -1.0}};
  ASSERT_TRUE(drawn.pick_at(down));
  EXPECT_EQ(drawn.picker.stats().commits, 1);
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(drawn.clay.apply(stroke_of(Action::carve, 1.0, 0.5, {{0.4 * i, 0.0, 10.0}})).ok());
    drawn.update();
    ASSERT_TRUE(drawn.pick_at(down));
  }
  EXPECT_EQ(drawn.picker.stats().commits, 1);
  const std::int64_t cubes = drawn.picker.stats().cubes;
  // A lump beyond the cubes there are: 16 mm are 64 nodes.
  ASSERT_TRUE(
      drawn.clay.apply(stroke_of(Action::add, 3.0, 1.0, {{0.0, 0.0, 9.0}, {0.0, 0.0, 20.0}})).ok());
  drawn.update();
  ASSERT_TRUE(drawn.pick_at(down));
  EXPECT_EQ(drawn.picker.stats().commits, 2);
  EXPECT_GT(drawn.picker.stats().cubes, cubes);
  ASSERT_TRUE(drawn.clay.undo());
  drawn.update();
  ASSERT_TRUE(drawn.pick_at(down));
  EXPECT_EQ(drawn.picker.stats().cubes, cubes);
}

TEST(SurfacePicker, CanBeMoved) {
  DrawnClay drawn(plain_ball(5.0));
  const Ray down{{0.0, 0.0, 40.0}, {0.0, 0.0, -1.0}};
  const auto before = drawn.pick_at(down);
  SurfacePicker moved = std::move(drawn.picker);
  EXPECT_EQ(moved.pick(drawn.surface, down).value()->point_mm, before->point_mm);
}

}  // namespace
}  // namespace argil::test
