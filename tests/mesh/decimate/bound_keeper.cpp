// SPDX-License-Identifier: GPL-3.0-or-later
// What is collapsed within a bound does as a proof says, whatever that is: one that is true but for
// chosen places takes the place of a field's.
#include "decimate/bound_keeper.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "argil/core/pace.h"
#include "argil/mesh/decimate.h"
#include "argil/mesh/rounding.h"
#include "argil/mesh/triangle_geometry.h"

#include "decimate/collapse_mesh.h"
#include "decimate/collapse_run.h"
#include "decimate/fit_vertices.h"
#include "support/shapes.h"

namespace argil::mesh {
namespace {

constexpr double kRoundRadiusMm = 10.0;
constexpr double kRoundVoxelMm = 0.2;
constexpr double kRoundBoundMm = 0.05;

class RoundProbe final : public DistanceProbe {
 public:
  explicit RoundProbe(std::atomic<std::size_t>& asked) : asked_(asked) {}
  double distance_mm(const Vec3& p) override {
    ++asked_;
    return length(p) - kRoundRadiusMm;
  }
  FieldValue value(const Vec3& p) override {
    return {distance_mm(p), normalized(p), kRoundVoxelMm};
  }

 private:
  std::atomic<std::size_t>& asked_;
};

/// Doubts what a proof has found: given the number and the answer, gives the answer to tell.
struct Doubts {
  std::function<bool(std::uint32_t cell, bool is_near, NearTriangles& mesh)> cell;
  std::function<bool(const Corners&, bool is_near)> triangle;
};

/// The surface of a ball by points on it, of which there is one at each vertex of the surface.
class RoundProof final : public BoundProof {
 public:
  RoundProof(const TriangleMesh& surface, double bound_mm, const Doubts& doubts)
      : surface_(surface), bound_mm_(bound_mm), doubts_(doubts) {}

  std::uint32_t cells() const override {
    return static_cast<std::uint32_t>(surface_.positions.size());
  }
  std::uint32_t vertex_of(std::uint32_t cell) const override { return cell; }
  bool is_near(std::uint32_t cell, NearTriangles& mesh) const override {
    const Vec3& at = surface_.positions[cell];
    const bool is_near = mesh.distance_mm(at, bound_mm_) <= bound_mm_ ||
                         mesh.distance_far_mm(at, bound_mm_) <= bound_mm_;
    return doubts_.cell ? doubts_.cell(cell, is_near, mesh) : is_near;
  }
  void ask_triangles(std::span<const Corners> triangles,
                     std::span<std::uint8_t> is_near) const override {
    for (std::size_t t = 0; t < triangles.size(); ++t) is_near[t] = is_good(triangles[t]) ? 1 : 0;
  }
  /// The farthest of a triangle from the ball is its middle or a corner.
  bool is_good(const Corners& c) const {
    bool is_near = kRoundRadiusMm - length(middle(c)) <= bound_mm_;
    for (const Vec3& p : c) is_near = is_near && length(p) - kRoundRadiusMm <= bound_mm_;
    return doubts_.triangle ? doubts_.triangle(c, is_near) : is_near;
  }

 private:
  const TriangleMesh& surface_;
  double bound_mm_;
  const Doubts& doubts_;
};

class RoundTarget final : public DecimationTarget {
 public:
  RoundTarget(const TriangleMesh& surface, const Doubts& doubts)
      : surface_(surface), doubts_(doubts) {}

  double voxel_mm() const override { return kRoundVoxelMm; }
  std::unique_ptr<DistanceProbe> probe() const override {
    return std::make_unique<RoundProbe>(asked_);
  }
  double own_error_mm(const Pace&) const override { return 0.001; }
  std::unique_ptr<BoundProof> proof(double bound_mm, const Pace&) const override {
    return std::make_unique<RoundProof>(surface_, bound_mm, doubts_);
  }
  std::size_t asked() const { return asked_; }  ///< so often its probes were

 private:
  const TriangleMesh& surface_;
  const Doubts& doubts_;
  mutable std::atomic<std::size_t> asked_ = 0;
};

/// A fine ball, and what becomes of it.
struct RoundSurface {
  explicit RoundSurface(int splits = 5)
      : surface(rounded_to_float(test::ball_mesh(kRoundRadiusMm, splits))) {}

  Result<CollapsedWithin> within(const Doubts& doubts, const Progress& progress = {}) const {
    DecimateOptions options;
    options.max_error_mm = kRoundBoundMm;
    return collapse_within(surface, RoundTarget(surface, doubts), options, Pace(progress, ""));
  }
  bool is_polar(std::uint32_t v) const { return surface.positions[v].z > 0.9 * kRoundRadiusMm; }

  TriangleMesh surface;
};

/// All that a proof without doubts asks for, looked up among all triangles.
void expect_within(const RoundSurface& round, const TriangleMesh& mesh) {
  const Doubts none;
  const RoundProof proof(round.surface, kRoundBoundMm, none);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    EXPECT_TRUE(proof.is_good(corners_of(mesh, t))) << t;
  }
}

TEST(CollapseWithin, GoesFarWhereNothingIsDoubted) {
  const RoundSurface round;
  const auto made = round.within({});
  ASSERT_TRUE(made);
  EXPECT_TRUE(made.value().is_proven);
  EXPECT_EQ(made.value().tries, 1);
  const TriangleMesh& mesh = made.value().collapsed.mesh;
  EXPECT_LT(mesh.triangles.size(), round.surface.triangles.size() / 4);
  EXPECT_TRUE(CollapseMesh::build(mesh));
  expect_within(round, mesh);
}

/// Near only to the vertex itself, where that has not moved.
Doubts only_own_vertices(const RoundSurface& round) {
  Doubts doubts;
  doubts.cell = [&round](std::uint32_t cell, bool is_near, NearTriangles& mesh) {
    if (!round.is_polar(cell)) return is_near;
    return is_near && mesh.distance_mm(round.surface.positions[cell], 0.0) == 0.0;
  };
  return doubts;
}

TEST(CollapseWithin, PutsVerticesBackWhereNothingElseIsProven) {
  const RoundSurface round;
  const auto made = round.within(only_own_vertices(round));
  ASSERT_TRUE(made);
  EXPECT_TRUE(made.value().is_proven);
  EXPECT_FALSE(made.value().has_folds);
  EXPECT_GT(made.value().tries, 1);
  const Collapsed& collapsed = made.value().collapsed;
  EXPECT_TRUE(CollapseMesh::build(collapsed.mesh));
  expect_within(round, collapsed.mesh);
  // Each vertex there is the one that it was; elsewhere most have gone.
  std::size_t polar = 0;
  for (std::size_t i = 0; i < collapsed.kept.size(); ++i) {
    if (!round.is_polar(collapsed.kept[i])) continue;
    ++polar;
    EXPECT_EQ(collapsed.mesh.positions[i], round.surface.positions[collapsed.kept[i]]);
  }
  std::size_t were_polar = 0;
  for (std::uint32_t v = 0; v < round.surface.positions.size(); ++v) {
    were_polar += round.is_polar(v) ? 1 : 0;
  }
  EXPECT_EQ(polar, were_polar);
  EXPECT_GT(polar, 100U);
  EXPECT_LT(collapsed.kept.size(), polar + round.surface.positions.size() / 3);
}

TEST(CollapseWithin, SaysSoWhereOneCellIsNeverProven) {
  const RoundSurface round;
  Doubts doubts;
  std::atomic<int> asked = 0;
  doubts.cell = [&](std::uint32_t cell, bool is_near, NearTriangles&) {
    if (cell != 7) return is_near;
    ++asked;
    return false;
  };
  const auto made = round.within(doubts);
  ASSERT_TRUE(made);
  EXPECT_FALSE(made.value().is_proven);
  // Eleven rounds at most, twice: with the fit, without it and as it was before, from two places.
  EXPECT_GT(asked, 8);
  EXPECT_LT(asked, 200);
  DecimateOptions options;
  options.max_error_mm = kRoundBoundMm;
  const auto refused = decimate(round.surface, RoundTarget(round.surface, doubts), options);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::bad_input);
}

TEST(CollapseWithin, SaysSoWhereNothingIsEverProven) {
  const RoundSurface round(4);
  Doubts doubts;
  doubts.cell = [](std::uint32_t, bool, NearTriangles&) { return false; };
  doubts.triangle = [](const Corners&, bool) { return false; };
  const auto made = round.within(doubts);
  ASSERT_TRUE(made);
  EXPECT_FALSE(made.value().is_proven);
}

/// How often a place is tried where one cell is doubted the first so many times.
int tries_with(int doubted) {
  const RoundSurface round;
  std::atomic<int> asked = 0;
  Doubts doubts;
  doubts.cell = [&](std::uint32_t cell, bool is_near, NearTriangles&) {
    return is_near && (cell != 7 || ++asked > doubted);
  };
  const auto made = round.within(doubts);
  EXPECT_TRUE(made && made.value().is_proven);
  EXPECT_GT(asked, doubted);
  return made ? made.value().tries : 0;
}

TEST(CollapseWithin, TakesBackNoMoreThanHelps) {
  // A cell is looked at from two places: the third time without the fit around it, and only then
  // are steps taken back.
  EXPECT_EQ(tries_with(0), 1);
  EXPECT_EQ(tries_with(1), 1);
  EXPECT_EQ(tries_with(2), 1);
  EXPECT_EQ(tries_with(4), 2);
  EXPECT_GT(tries_with(8), 2);
}

/// No triangle of the lower half may be longer than so.
constexpr double kShortMm = 1.5;
Doubts only_short_below() {
  Doubts doubts;
  doubts.triangle = [](const Corners& c, bool is_near) {
    return is_near && (middle(c).z > 0.0 || longest_side(c) <= kShortMm);
  };
  return doubts;
}

TEST(CollapseWithin, TakesBackTrianglesThatAreNotProven) {
  const RoundSurface round;
  const auto made = round.within(only_short_below());
  ASSERT_TRUE(made);
  EXPECT_TRUE(made.value().is_proven);
  const TriangleMesh& mesh = made.value().collapsed.mesh;
  EXPECT_TRUE(CollapseMesh::build(mesh));
  expect_within(round, mesh);
  double above = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Corners c = corners_of(mesh, t);
    if (middle(c).z > 0.0) {
      above = std::max(above, longest_side(c));
    } else {
      EXPECT_LE(longest_side(c), kShortMm);
    }
  }
  EXPECT_GT(above, 1.2 * kShortMm);
}

TEST(CollapseWithinGolden, TakesTheSameBackForAnyNumberOfThreads) {
  const RoundSurface round;
  const auto made_by = [&](std::size_t threads, const Doubts& doubts) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return round.within(doubts).value().collapsed.mesh;
  };
  for (const Doubts& doubts : {only_own_vertices(round), only_short_below()}) {
    const TriangleMesh one = made_by(1, doubts);
    for (const std::size_t threads : {2U, 7U}) {
      const TriangleMesh other = made_by(threads, doubts);
      EXPECT_EQ(one.positions, other.positions);
      EXPECT_EQ(one.triangles, other.triangles);
    }
  }
}

/// How often the field is asked between two chances to stop, at most.
class Gaps {
 public:
  explicit Gaps(const RoundTarget& target) : target_(target) {}
  Progress listener() {
    return [this](std::string_view, double fraction) {
      most_ = std::max(most_, target_.asked() - last_);
      last_ = target_.asked();
      goes_back_ = goes_back_ || fraction < fraction_;
      fraction_ = fraction;
      return true;
    };
  }
  std::size_t most() const { return std::max(most_, target_.asked() - last_); }
  bool goes_back() const { return goes_back_; }

 private:
  const RoundTarget& target_;
  std::size_t last_ = 0;
  std::size_t most_ = 0;
  double fraction_ = 0.0;
  bool goes_back_ = false;
};

TEST(CollapseWithin, HearsAnInterruptionOftenWhileMuchIsTakenBack) {
  const RoundSurface round(7);
  // Nothing below is ever proven, so that all of it is fitted, taken back and collapsed again.
  std::atomic<bool> is_taken_back = false;
  Doubts doubts;
  doubts.triangle = [&](const Corners& c, bool is_near) {
    is_taken_back = is_taken_back || middle(c).z < 0.0;
    return is_near && middle(c).z > 0.0;
  };
  const RoundTarget target(round.surface, doubts);
  Gaps gaps(target);
  std::size_t until = 0;
  const Progress listener = [&, listen = gaps.listener()](std::string_view stage, double fraction) {
    if (is_taken_back && until == 0) until = target.asked() + 4'000'000;
    return listen(stage, fraction) && (until == 0 || target.asked() < until);
  };
  DecimateOptions options;
  options.max_error_mm = kRoundBoundMm;
  EXPECT_THROW(
      static_cast<void>(collapse_within(round.surface, target, options, Pace(listener, ""))),
      Interrupted);
  std::printf("asked %zu times, at most %zu between chances to stop\n", target.asked(),
              gaps.most());
  EXPECT_GT(target.asked(), until);
  // 0.1 us each.
  EXPECT_LT(gaps.most(), 700'000U);
}

TEST(FitVertices, HearsAnInterruptionOften) {
  const RoundSurface round(7);
  const Doubts none;
  const RoundTarget target(round.surface, none);
  Gaps gaps(target);
  const Progress listener = gaps.listener();
  TriangleMesh mesh = round.surface;
  const std::vector<bool> fixed(mesh.positions.size(), false);
  fit_vertices(mesh, target, fixed, Pace(listener, ""));
  EXPECT_GT(target.asked(), 2'000'000U);
  EXPECT_LT(gaps.most(), 200'000U);
  EXPECT_FALSE(gaps.goes_back());
  const Progress stop = [](std::string_view, double fraction) { return fraction < 0.3; };
  EXPECT_THROW(fit_vertices(mesh, target, fixed, Pace(stop, "")), Interrupted);
}

}  // namespace
}  // namespace argil::mesh
