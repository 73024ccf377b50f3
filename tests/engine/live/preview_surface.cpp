// SPDX-License-Identifier: GPL-3.0-or-later
// What is drawn of a preview over the clay: closed at any moment, and with all detail beside the
// tool.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "argil/engine/field_sampler.h"
#include "argil/engine/preview.h"
#include "argil/engine/surface.h"

#include "clay/clay_access.h"
#include "engine/live/previewed.h"
#include "field/level_stack.h"
#include "live/seam.h"
#include "live/sketch_blocks.h"
#include "support/drawn_copies.h"
#include "support/effort.h"

namespace argil::test {
namespace {

std::string preview_name_of(const testing::TestParamInfo<Action>& info) {
  return info_of(info.param).name;
}

DrawnCopy block_copy(const DisplayBlock& block) {
  return {{block.vertices.begin(), block.vertices.end()},
          {block.triangles.begin(), block.triangles.end()}};
}

DrawnCopies shown_copies(const DisplaySurface& surface) {
  DrawnCopies copies;
  for (const BlockId& id : surface.blocks()) copies[id] = block_copy(surface.block(id));
  return copies;
}

/// What a renderer does with the lists of an update. Every block that is to go is there.
void follow_preview(DrawnCopies& copies, const Preview& preview) {
  for (const BlockId& id : preview.gone()) EXPECT_EQ(copies.erase(id), 1U);
  for (const BlockId& id : preview.changed()) {
    const DisplayBlock block = preview.block(id);
    EXPECT_FALSE(block.triangles.empty());
    for (const DisplayVertex& v : block.vertices) {
      const auto& p = v.position_mm;
      for (std::size_t a = 0; a < 3; ++a) {
        EXPECT_LE(block.bounds_mm.min[a], double{p[a]});
        EXPECT_GE(block.bounds_mm.max[a], double{p[a]});
      }
    }
    copies[id] = block_copy(block);
  }
}

/// Extends, updates and follows.
void follow_preview(DrawnCopies& copies, Preview& preview, std::span<const StrokeSample> samples) {
  ASSERT_TRUE(preview.extend(samples).ok());
  ASSERT_TRUE(preview.update_surface().ok());
  follow_preview(copies, preview);
}

/// How many edges do not have as many triangles on one side as on the other, vertices merged by
/// the bits of their positions. Where a seam folds onto itself an edge may have four.
std::int64_t open_edges(const DrawnCopies& copies) {
  const TriangleMesh mesh = welded(copies);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i];
      const std::uint32_t b = t[(i + 1) % 3];
      if (a != b) sides[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  }
  return std::count_if(sides.begin(), sides.end(),
                       [](const auto& side) { return side.second != 0; });
}

class PreviewSurfaceOf : public testing::TestWithParam<Action> {};

TEST_P(PreviewSurfaceOf, IsClosedAndBackAsItWasAtAnyMomentOfAStroke) {
  Stroke stroke =
      large_stroke(GetParam(), effort(is_anchored(GetParam()) ? 3 : 5, kPreviewSamples));
  stroke.mirror.z = true;
  const Clay clay = fine_ball();
  const DisplaySurface shown = drawn_of(clay);
  const DrawnCopies before = shown_copies(shown);
  Preview preview = preview_of(clay, stroke, shown);
  DrawnCopies drawn = before;
  for (const StrokeSample& sample : stroke.samples) {
    follow_preview(drawn, preview, {&sample, 1});
    EXPECT_EQ(open_edges(drawn), 0);
  }
  EXPECT_FALSE(drawn == before);
  ASSERT_TRUE(preview.end().ok());
  ASSERT_TRUE(preview.update_surface().ok());
  follow_preview(drawn, preview);
  EXPECT_EQ(open_edges(drawn), 0);
  // It lies where the preview is, but for the detail that only the clay has.
  double most = 0.0;
  for (const auto& [id, copy] : drawn) {
    for (const DisplayVertex& v : copy.vertices) {
      const auto& p = v.position_mm;
      most = std::max(
          most, std::abs(preview.clay().distance_at({double{p[0]}, double{p[1]}, double{p[2]}})));
    }
  }
  RecordProperty("voxels", std::to_string(most / voxel_of(preview)));
  EXPECT_LT(most, voxel_of(preview));
}

INSTANTIATE_TEST_SUITE_P(Actions, PreviewSurfaceOf, testing::ValuesIn(actions_on_levels()),
                         preview_name_of);

/// A view that draws most of the clay coarser than the preview is.
TEST(PreviewSurface, IsClosedWhereTheClayIsDrawnCoarser) {
  const Clay clay = fine_ball();
  DisplayView far;
  far.eye_mm = {60.0, 0.0, 0.0};
  far.pixel_mm = 3.0 * kPreviewVoxelMm;
  for (const Action action : {Action::carve, Action::inflate, Action::grab}) {
    DisplaySurface shown;
    ASSERT_TRUE(shown.update(clay, far).ok());
    ASSERT_GT(shown.stats().hidden_leaves, 0);
    const Stroke stroke = large_stroke(action, 3);
    Preview preview = preview_of(clay, stroke, shown);
    // Level 1 is hidden: what makes surface is shown at level 2.
    EXPECT_EQ(preview.level(), action == Action::carve ? 2 : 1);
    DrawnCopies drawn = shown_copies(shown);
    for (const StrokeSample& sample : stroke.samples) {
      follow_preview(drawn, preview, {&sample, 1});
      EXPECT_EQ(open_edges(drawn), 0);
    }
    EXPECT_FALSE(drawn == shown_copies(shown));
  }
}

TEST(PreviewSurface, MakesNoPreviewWhereTheClayIsDrawnTooCoarseForTheTool) {
  const Clay clay = fine_ball();
  DisplayView far;
  far.eye_mm = {600.0, 0.0, 0.0};
  far.pixel_mm = 40.0 * kPreviewVoxelMm;
  far.coarser = 32;
  DisplaySurface shown;
  ASSERT_TRUE(shown.update(clay, far).ok());
  Stroke stroke = large_stroke(Action::carve, 1);
  const auto made = Preview::begin(clay, shown, stroke.tool, stroke, kPreviewToolVoxels);
  ASSERT_TRUE(made.ok());
  EXPECT_FALSE(made.value().has_value());
}

/// The seam lies on both surfaces, where they run side by side.
TEST(PreviewSurface, MeetsTheClayWithinAVoxel) {
  const Clay clay = fine_ball();
  const DisplaySurface shown = drawn_of(clay);
  for (const Action action : {Action::carve, Action::add}) {
    const Stroke stroke = large_stroke(action);
    Preview preview = preview_of(clay, stroke, shown);
    ASSERT_TRUE(preview.extend(stroke.samples).ok());
    ASSERT_TRUE(preview.update_surface().ok());
    double most = 0.0;
    int count = 0;
    for (const BlockId& id : preview.changed()) {
      if (id.origin[0] % kLeafSide == 0) continue;
      for (const DisplayVertex& v : preview.block(id).vertices) {
        const Vec3 p{double{v.position_mm[0]}, double{v.position_mm[1]}, double{v.position_mm[2]}};
        most = std::max(
            {most, std::abs(clay.distance_at(p)), std::abs(preview.clay().distance_at(p))});
        ++count;
      }
    }
    EXPECT_GT(count, 300);
    RecordProperty("voxels_" + std::to_string(static_cast<int>(action)),
                   std::to_string(most / voxel_of(preview)));
    EXPECT_LT(most, voxel_of(preview));
  }
}

/// What moves is a matter of the vertex and the preview alone.
TEST(PreviewSurface, HasTheSameBitsWhateverUpdatesLedThere) {
  const Clay clay = fine_ball();
  const DisplaySurface shown = drawn_of(clay);
  for (const Action action :
       {Action::inflate, Action::smooth, Action::carve, Action::grab, Action::twist}) {
    const Stroke stroke = large_stroke(action, 4);
    Preview often = preview_of(clay, stroke, shown);
    DrawnCopies drawn = shown_copies(shown);
    for (const StrokeSample& sample : stroke.samples) follow_preview(drawn, often, {&sample, 1});
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    Preview once = preview_of(clay, stroke, shown);
    DrawnCopies at_once = shown_copies(shown);
    follow_preview(at_once, once, stroke.samples);
    EXPECT_TRUE(sorted_triangles(drawn) == sorted_triangles(at_once));
  }
}

/// A clay remembers 65 536 changes of leaves; each of these samples makes about 700.
void expect_made_anew_after(int samples) {
  const Clay clay = fine_ball();
  const DisplaySurface shown = drawn_of(clay);
  Stroke stroke = large_stroke(Action::inflate, 1);
  stroke.tool.radii_mm = {6.3, 6.3, 6.3};
  stroke.tool.strength = 0.05;
  Preview seldom = preview_of(clay, stroke, shown);
  Preview often = preview_of(clay, stroke, shown);
  DrawnCopies drawn = shown_copies(shown);
  DrawnCopies again = drawn;
  StrokeSample sample = stroke.samples[0];
  for (int i = 0; i < samples; ++i) {
    sample.time_s += 0.01;
    sample.position_mm.y = i % 2 == 0 ? 2.0 : -2.0;
    ASSERT_TRUE(seldom.extend({&sample, 1}).ok());
    follow_preview(again, often, {&sample, 1});
  }
  ASSERT_TRUE(seldom.update_surface().ok());
  follow_preview(drawn, seldom);
  EXPECT_TRUE(drawn == again);
}

TEST(PreviewSurface, IsMadeAnewWhenMoreChangedThanTheClayRemembers) { expect_made_anew_after(112); }

TEST(PreviewSurfaceSlow, IsMadeAnewWhenMoreChangedThanTheClayRemembers) {
  expect_made_anew_after(150);
}

/// The same of blocks in the place of the clay's: from then on all are.
TEST(PreviewSurface, TakesTheWholePlaceOfTheClayWhenItIsNotKnownWhatChanged) {
  const Clay clay = fine_ball();
  const DisplaySurface shown = drawn_of(clay);
  const auto coarse = [&] {
    return clay_of_levels(levels_of(clay).copy_from(1),
                          ClayOptions{.voxel_mm = 2.0 * kPreviewVoxelMm});
  };
  const Clay before = coarse();
  Clay now = coarse();
  SketchBlocks blocks(shown, before, now, 1);
  DrawnCopies drawn = shown_copies(shown);
  const auto update = [&](const std::optional<std::vector<LeafChange>>& changes) {
    BlockLists lists;
    blocks.update(changes, lists);
    for (const BlockId& id : lists.gone) drawn.erase(id);
    for (const BlockId& id : lists.changed) drawn[id] = block_copy(blocks.block(id));
    EXPECT_EQ(open_edges(drawn), 0);
  };
  const auto carve = [&](double from, double to) {
    const std::uint64_t known = revision(now);
    EXPECT_TRUE(
        now.apply(stroke_of(Action::carve, 3.0, 1.0, {{from, 6.0, 0.0}, {to, 6.0, 0.0}})).ok());
    return changes_since(now, known);
  };
  update(carve(-1.0, 0.0));
  EXPECT_FALSE(sorted_triangles(drawn) == sorted_triangles(extract_surface(now)));
  carve(0.0, 1.0);
  update(std::nullopt);
  EXPECT_TRUE(sorted_triangles(drawn) == sorted_triangles(extract_surface(now)));
  update(carve(1.0, 2.0));
  EXPECT_TRUE(sorted_triangles(drawn) == sorted_triangles(extract_surface(now)));
}

/// Bumps of 0.6 voxel, 10 voxels long, on a ball, and a tool of 120 voxels that works over it.
class PreviewDetailOf : public testing::TestWithParam<Action> {
 protected:
  static constexpr double kBallMm = 40.0;
  static constexpr double kVoxelMm = 0.25;
  static constexpr double kToolMm = 120.0 * kVoxelMm;
  static constexpr double kHeightMm = 0.6 * kVoxelMm;

  static double pattern_mm(const Vec3& on_ball) {
    constexpr double kTurn = 2.0 * 3.141592653589793 / (10.0 * kVoxelMm);
    return kHeightMm * std::sin(kTurn * on_ball.x) * std::sin(kTurn * on_ball.y) *
           std::sin(kTurn * on_ball.z);
  }
  static Clay ball_with_detail() {
    const double half = kBallMm + kHeightMm + 1.0;
    const auto distance = [](const Vec3& p) {
      const double r = length(p);
      return r < 1e-6 ? -kBallMm : r - kBallMm - pattern_mm((kBallMm / r) * p);
    };
    return Clay::from_distance(distance, {{-half, -half, -half}, {half, half, half}},
                               ClayOptions{.voxel_mm = kVoxelMm})
        .value();
  }
  static Stroke stroke() {
    Stroke stroke;
    stroke.tool.action = GetParam();
    stroke.tool.radii_mm = {kToolMm, kToolMm, kToolMm};
    stroke.tool.strength = is_stamped(GetParam()) ? 1.0 : 0.3;
    for (const double turn : {-0.2, 0.0, 0.2}) {
      StrokeSample sample;
      sample.time_s = 1.0 + turn;
      sample.position_mm = {kBallMm * std::sin(turn), -kBallMm * std::cos(turn), 0.7};
      stroke.samples.push_back(sample);
    }
    return stroke;
  }
  /// From the way of the tool's middle, in its radii.
  static double radii_from(const Stroke& stroke, const Vec3& p) {
    double nearest = 1e9;
    for (std::size_t i = 0; i + 1 < stroke.samples.size(); ++i) {
      const Vec3 from = stroke.samples[i].position_mm;
      const Vec3 way = stroke.samples[i + 1].position_mm - from;
      const double t = std::clamp(dot(p - from, way) / dot(way, way), 0.0, 1.0);
      nearest = std::min(nearest, length(p - from - t * way));
    }
    return nearest / kToolMm;
  }
  /// How much of the pattern's height is drawn beside the tool.
  static double drawn_beside(const DrawnCopies& drawn, const Stroke& stroke) {
    double found = 0.0;
    double all = 0.0;
    for (const auto& [id, copy] : drawn) {
      for (const DisplayVertex& v : copy.vertices) {
        const auto& p = v.position_mm;
        const Vec3 at{double{p[0]}, double{p[1]}, double{p[2]}};
        const Vec3 on_ball = (kBallMm / length(at)) * at;
        const double radii = radii_from(stroke, on_ball);
        // What was added or carved away there has no pattern.
        const bool is_on_ball = std::abs(length(at) - kBallMm) < 3.0 * kHeightMm;
        if (radii < 1.0 || radii > 1.3 || !is_on_ball) continue;
        const double wanted = pattern_mm(on_ball);
        found += (length(at) - kBallMm) * wanted;
        all += wanted * wanted;
      }
    }
    return found / all;
  }
};

/// As much as the clay keeps, whose rim is rounded.
TEST_P(PreviewDetailOf, IsDrawnBesideTheTool) {
  Clay clay = ball_with_detail();
  const DisplaySurface shown = drawn_of(clay);
  const Stroke work = stroke();
  auto made = Preview::begin(clay, shown, work.tool, work);
  ASSERT_TRUE(made.ok() && made.value().has_value());
  Preview& preview = *made.value();
  DrawnCopies drawn = shown_copies(shown);
  const double before = drawn_beside(drawn, work);
  EXPECT_GT(before, 0.95);
  for (const StrokeSample& sample : work.samples) follow_preview(drawn, preview, {&sample, 1});
  EXPECT_FALSE(drawn == shown_copies(shown));
  EXPECT_EQ(open_edges(drawn), 0);
  const double now = drawn_beside(drawn, work);
  ASSERT_TRUE(clay.apply(work).ok());
  const double kept = drawn_beside(shown_copies(drawn_of(clay)), work);
  RecordProperty("before", std::to_string(before));
  RecordProperty("while_working", std::to_string(now));
  RecordProperty("kept_by_the_clay", std::to_string(kept));
  EXPECT_GT(now, 0.95 * kept);
  EXPECT_GT(now, 0.9);
}

/// How far vertices lie from a clay and how far their normals lean from the clay's.
struct PreviewMiss {
  double most_mm = 0.0;
  double mean_mm = 0.0;
  double mean_lean = 0.0;  ///< length of the difference of unit vectors
};

/// Of the vertices that differ from those before; without these, of all.
PreviewMiss preview_miss(const DrawnCopies& drawn, const DrawnCopies& before, const Clay& clay) {
  PreviewMiss miss;
  double count = 0.0;
  FieldSampler field(clay);
  for (const auto& [id, copy] : drawn) {
    const auto was = before.find(id);
    for (std::size_t n = 0; n < copy.vertices.size(); ++n) {
      if (was != before.end() && copy.vertices[n] == was->second.vertices[n]) continue;
      const auto& p = copy.vertices[n].position_mm;
      const auto& lean = copy.vertices[n].normal;
      const FieldValue at = field.value({double{p[0]}, double{p[1]}, double{p[2]}});
      const Vec3 normal{double{lean[0]}, double{lean[1]}, double{lean[2]}};
      miss.most_mm = std::max(miss.most_mm, std::abs(at.distance_mm));
      miss.mean_mm += std::abs(at.distance_mm);
      miss.mean_lean += length(normal - normalized(at.gradient));
      count += 1.0;
    }
  }
  EXPECT_GT(count, 1000.0);
  miss.mean_mm /= count;
  miss.mean_lean /= count;
  return miss;
}

class PreviewDragOf : public testing::TestWithParam<Action> {};

/// With mirror images, and with a mask as well, which a preview has coarser: every vertex lies on
/// the clay that the stroke leaves, to a fraction of its finest voxel and not of the preview's.
TEST_P(PreviewDragOf, TakesVerticesWhereTheClayIsTaken) {
  for (const bool is_masked : {false, true}) {
    Stroke stroke = large_stroke(GetParam());
    stroke.mirror.z = true;
    Clay clay = fine_ball();
    const Stroke mask = stroke_of(Action::mask, 3.0, 1.0, {{5.0, 5.0, 0.0}, {4.0, 6.0, 0.0}});
    if (is_masked) {
      ASSERT_TRUE(clay.apply(mask).ok());
    }
    const DisplaySurface shown = drawn_of(clay);
    const DrawnCopies before = shown_copies(shown);
    Preview preview = preview_of(clay, stroke, shown);
    DrawnCopies drawn = before;
    for (const StrokeSample& sample : stroke.samples) follow_preview(drawn, preview, {&sample, 1});
    ASSERT_TRUE(preview.end().ok());
    ASSERT_TRUE(preview.update_surface().ok());
    follow_preview(drawn, preview);
    ASSERT_TRUE(clay.apply(stroke).ok());
    const PreviewMiss miss = preview_miss(drawn, before, clay);
    const std::string name = is_masked ? "masked_" : "free_";
    RecordProperty(name + "most_voxels", std::to_string(miss.most_mm / kPreviewVoxelMm));
    RecordProperty(name + "mean_voxels", std::to_string(miss.mean_mm / kPreviewVoxelMm));
    // Those that are drawn of the clay itself lean as well from the slope between its nodes.
    const PreviewMiss own = preview_miss(shown_copies(drawn_of(clay)), {}, clay);
    RecordProperty(name + "mean_lean", std::to_string(miss.mean_lean));
    RecordProperty(name + "mean_lean_of_the_clay", std::to_string(own.mean_lean));
    EXPECT_LT(miss.most_mm, (is_masked ? 1.0 : 0.5) * kPreviewVoxelMm);
    EXPECT_LT(miss.mean_mm, (is_masked ? 0.05 : 0.03) * kPreviewVoxelMm);
    EXPECT_LT(miss.mean_lean, own.mean_lean + 0.03);
  }
}

INSTANTIATE_TEST_SUITE_P(Actions, PreviewDragOf, testing::Values(Action::grab, Action::twist),
                         preview_name_of);

/// Not of clay_strips: the corners of its square tip lie there.
INSTANTIATE_TEST_SUITE_P(Actions, PreviewDetailOf,
                         testing::Values(Action::smooth, Action::inflate, Action::flatten,
                                         Action::layer, Action::pinch, Action::clay, Action::noise,
                                         Action::crease, Action::ridge, Action::add, Action::carve,
                                         Action::grab),
                         preview_name_of);

/// A flat square of so many edges a side, or the same as a hole in a larger one.
DrawnCopy flat_square(int edges, double half_mm, double height_mm, bool is_hole) {
  DrawnCopy copy;
  const auto put = [&](double x, double y) {
    copy.vertices.push_back(
        {{static_cast<float>(x), static_cast<float>(y), static_cast<float>(height_mm)},
         {0.0F, 0.0F, 1.0F}});
  };
  const auto count = static_cast<std::uint32_t>(4 * edges);
  for (int side = 0; side < 4; ++side) {
    for (int i = 0; i < edges; ++i) {
      const double t = half_mm * (2.0 * i / edges - 1.0);
      const double across = half_mm;
      if (side == 0) put(t, -across);
      if (side == 1) put(across, t);
      if (side == 2) put(-t, across);
      if (side == 3) put(-across, -t);
    }
  }
  if (!is_hole) {
    put(0.0, 0.0);
    for (std::uint32_t i = 0; i < count; ++i) copy.triangles.push_back({i, (i + 1) % count, count});
    return copy;
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto& p = copy.vertices[i].position_mm;
    put(3.0 * double{p[0]}, 3.0 * double{p[1]});
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t next = (i + 1) % count;
    copy.triangles.push_back({next, i, count + i});
    copy.triangles.push_back({next, count + i, count + next});
  }
  return copy;
}

Border border_around(const DrawnCopy& copy) {
  Border border;
  border.add(border_of({copy.vertices, copy.triangles, {}}));
  return border;
}

/// A patch in a hole of other edges, and lids where they lie too far apart.
TEST(PreviewSeam, LeavesTheOuterBorderAlone) {
  for (const double away_mm : {0.1, 5.0}) {
    DrawnCopies copies;
    copies[{0, {0, 0, 0}}] = flat_square(3, 1.0, away_mm, false);
    DrawnCopy& hole = copies[{0, {8, 0, 0}}] = flat_square(7, 1.05, 0.0, true);
    Border of_hole = border_around(hole);
    // The outer edge of the hole's square is no seam.
    DrawnCopy outer;
    outer.vertices = hole.vertices;
    const auto count = static_cast<std::uint32_t>(hole.vertices.size() / 2);
    outer.vertices.push_back({{0.0F, 0.0F, 9.0F}, {0.0F, 0.0F, 1.0F}});
    for (std::uint32_t i = 0; i < count; ++i) {
      outer.triangles.push_back({count + i, count + (i + 1) % count, 2 * count});
    }
    of_hole.remove(border_of({outer.vertices, outer.triangles, {}}));
    const SeamMesh seam = seam_between(border_around(copies[{0, {0, 0, 0}}]), of_hole, 1.0);
    copies[{0, {16, 0, 0}}] = {seam.vertices, seam.triangles};
    EXPECT_EQ(open_edges(copies), 28);  // as many as the outer side has
    // A strip has a triangle for each edge, a lid too.
    EXPECT_EQ(seam.triangles.size(), 12U + 28U);
    float lowest = 1e9F;
    for (const DisplayVertex& v : seam.vertices) lowest = std::min(lowest, v.normal[2]);
    EXPECT_GT(lowest, 0.99F);
    // A lid has its own middle.
    const bool has_middle =
        std::any_of(seam.vertices.begin(), seam.vertices.end(), [](const DisplayVertex& v) {
          return std::abs(v.position_mm[0]) < 0.01F && std::abs(v.position_mm[1]) < 0.01F;
        });
    EXPECT_EQ(has_middle, away_mm > 1.0);
  }
}

TEST(PreviewSeam, IsEmptyWhereBordersAreOne) {
  const DrawnCopy patch = flat_square(3, 1.0, 0.0, false);
  Border one = border_around(patch);
  EXPECT_EQ(one.loops().size(), 1U);
  EXPECT_EQ(one.loops()[0].size(), 12U);
  one.remove(border_of({patch.vertices, patch.triangles, {}}));
  EXPECT_TRUE(one.loops().empty());
  EXPECT_TRUE(seam_between(one, Border(), 1.0).triangles.empty());
}

}  // namespace
}  // namespace argil::test
