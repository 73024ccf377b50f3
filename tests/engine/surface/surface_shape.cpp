// SPDX-License-Identifier: GPL-3.0-or-later
// The surface of stacks made from functions: is it a closed two-manifold that does not cross
// itself, whatever the values and the refinement?
#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "support/analytic_stack.h"
#include "support/measure/mesh_topology.h"
#include "support/measure/self_intersection.h"
#include "surface/block_surface.h"

namespace argil::test {
namespace {

using Path = BlockExtractor::Path;

TriangleMesh surface_of(const LevelStack& stack, Path path = Path::fastest) {
  BlockSurface surface(path);
  surface.rebuild_all(stack);
  return surface.weld();
}

void expect_sound(const TriangleMesh& mesh) {
  EXPECT_FALSE(mesh.triangles.empty());
  EXPECT_EQ(find_mesh_faults(mesh), MeshFaults{});
  EXPECT_EQ(find_soup_faults(mesh), SoupFaults{});
  EXPECT_EQ(find_soup_faults(rounded_to_float(mesh, {100.0, -90.0, 110.0})), SoupFaults{});
  for (const Vec3& n : mesh.normals) ASSERT_NEAR(length(n), 1.0, 1e-12);
}

AnalyticStack scene(int levels, const NodeField& field, const LeafChoice& choose) {
  AnalyticStack made;
  made.voxel_mm = 0.05;
  made.levels = levels;
  made.top_leaves = levels == 1 ? 3 : (levels == 2 ? 2 : 1);
  made.field = field;
  made.choose = choose;
  return made;
}

// Half the side of the scene's cube in mm, margin taken off.
double room(const AnalyticStack& s) {
  return (8 * s.top_leaves - AnalyticStack::kMargin) * s.voxel_mm * (1 << (s.levels - 1));
}

TEST(SurfaceShape, OfABallIsOneBall) {
  for (int levels = 1; levels <= 4; ++levels) {
    SCOPED_TRACE(levels);
    auto s = scene(levels, nullptr, chosen_by_chance(7, 0.3));
    s.field = ball_field({0.013, -0.021, 0.007}, 0.8 * room(s));
    const TriangleMesh mesh = surface_of(s.build());
    expect_sound(mesh);
    EXPECT_EQ(euler_characteristic(mesh), 2);
    const double r = 0.8 * room(s);
    EXPECT_NEAR(signed_volume(mesh), 4.0 / 3.0 * M_PI * r * r * r, 0.1 * r * r * r);
  }
}

TEST(SurfaceShape, OfATorusHasOneHole) {
  for (int levels = 1; levels <= 4; ++levels) {
    SCOPED_TRACE(levels);
    auto s = scene(levels, nullptr, chosen_by_chance(11, 0.25));
    s.field = torus_field(0.6 * room(s), 0.3 * room(s));
    const TriangleMesh mesh = surface_of(s.build());
    expect_sound(mesh);
    EXPECT_EQ(euler_characteristic(mesh), 0);
  }
}

// Values of exactly zero, whole faces and edges of them.
TEST(SurfaceShape, OfABoxOnTheLatticeIsOneBall) {
  for (int levels = 1; levels <= 4; ++levels) {
    SCOPED_TRACE(levels);
    auto s = scene(levels, nullptr, chosen_by_chance(13, 0.3));
    const double half = std::floor(0.7 * room(s) / (8 * s.voxel_mm)) * 8 * s.voxel_mm;
    s.field = [=](int, const Coord&, const Vec3& p) {
      return static_cast<float>(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) - half);
    };
    const TriangleMesh mesh = surface_of(s.build());
    expect_sound(mesh);
    EXPECT_EQ(euler_characteristic(mesh), 2);
  }
}

// Faces and edges divided more than once: edits never leave that, yet the rules do not mind.
TEST(SurfaceShape, IsSoundWithoutBalance) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE(seed);
    auto s = scene(3, nullptr, chosen_by_chance(seed, 0.1));
    s.balanced = false;
    s.field = [=, h = s.voxel_mm](int level, const Coord& n, const Vec3& p) {
      return static_cast<float>(length(p) - 0.7 * room(s) + h * random_at(seed, level, n));
    };
    expect_sound(surface_of(s.build()));
  }
}

// One kind of hostile values: by seed, level and node, in voxels of level 0.
struct Hostile {
  const char* name;
  double (*value)(std::uint64_t seed, int level, const Coord& node, const Vec3& at_voxels);
};

double smooth_noise(std::uint64_t seed, const Vec3& p, double step) {
  const Coord low(static_cast<int>(std::floor(p.x / step)),
                  static_cast<int>(std::floor(p.y / step)),
                  static_cast<int>(std::floor(p.z / step)));
  double sum = 0.0;
  for (int i = 0; i < 8; ++i) {
    const Coord n = low + Coord(i >> 2, i >> 1 & 1, i & 1);
    double weight = 1.0;
    for (int a = 0; a < 3; ++a) {
      const double f = p[static_cast<std::size_t>(a)] / step - low[a];
      weight *= n[a] == low[a] ? 1.0 - f : f;
    }
    sum += weight * (random_at(seed, 99, n) - 0.5);
  }
  return sum;
}

const Hostile kHostile[] = {
    {"value noise", [](std::uint64_t seed, int, const Coord&,
                       const Vec3& p) { return 4.0 * smooth_noise(seed, p, 5.3); }},
    {"white noise", [](std::uint64_t seed, int level, const Coord& n,
                       const Vec3&) { return random_at(seed, level, n) - 0.5; }},
    {"magnitudes over e^+-7",
     [](std::uint64_t seed, int level, const Coord& n, const Vec3&) {
       const double size = std::exp(14.0 * random_at(seed + 1, level, n) - 7.0);
       return random_at(seed, level, n) < 0.5 ? -size : size;
     }},
    {"few values, many zeros",
     [](std::uint64_t seed, int level, const Coord& n, const Vec3&) {
       return std::floor(3.0 * random_at(seed, level, n)) - 1.0;
     }},
    {"coarse values wrong by a voxel",
     [](std::uint64_t seed, int level, const Coord& n, const Vec3& p) {
       const double off = level == 0 ? 0.0 : (1 << level) * (2.0 * random_at(seed, level, n) - 1.0);
       return length(p) - 9.3 + off;
     }},
    {"sparse specks", [](std::uint64_t seed, int level, const Coord& n,
                         const Vec3&) { return random_at(seed, level, n) < 0.04 ? -0.3 : 0.7; }},
    {"sparse holes", [](std::uint64_t seed, int level, const Coord& n,
                        const Vec3&) { return random_at(seed, level, n) < 0.04 ? 0.3 : -0.7; }},
};

struct HostileCase {
  int kind;
  int levels;
  std::uint64_t seed;
};

// Triangles by the bits of their corners, in an order of their own: numbering does not matter.
std::vector<std::array<double, 18>> sorted_triangles(const TriangleMesh& mesh) {
  std::vector<std::array<double, 18>> all;
  for (const Triangle& t : mesh.triangles) {
    std::array<double, 18> one{};
    for (std::size_t i = 0; i < 18; ++i) {
      const std::uint32_t v = t[i / 6];
      one[i] = i % 6 < 3 ? mesh.positions[v][i % 3] : mesh.normals[v][i % 3];
    }
    all.push_back(one);
  }
  std::sort(all.begin(), all.end());
  return all;
}

class SurfaceHostileProperty : public testing::TestWithParam<HostileCase> {};
class SurfacePyramidsProperty : public testing::TestWithParam<HostileCase> {};

AnalyticStack hostile_scene(const HostileCase& c) {
  auto s = scene(c.levels, nullptr,
                 chosen_by_chance(c.seed, 0.15 + 0.1 * static_cast<double>(c.seed % 3)));
  s.top_leaves = 1;
  s.field = [=, h = s.voxel_mm](int level, const Coord& node, const Vec3& at) {
    return static_cast<float>(h * kHostile[c.kind].value(c.seed, level, node, at / h));
  };
  return s;
}

TEST_P(SurfaceHostileProperty, IsClosedManifoldAndFreeOfCrossings) {
  SCOPED_TRACE(testing::Message() << kHostile[GetParam().kind].name << ", levels "
                                  << GetParam().levels << ", seed " << GetParam().seed);
  expect_sound(surface_of(hostile_scene(GetParam()).build()));
}

// The table and the general path are two roads to the same triangles.
TEST_P(SurfaceHostileProperty, IsTheSameWithoutTheTable) {
  const LevelStack stack = hostile_scene(GetParam()).build();
  const TriangleMesh fast = surface_of(stack);
  const TriangleMesh general = surface_of(stack, Path::general);
  ASSERT_FALSE(fast.triangles.empty());
  EXPECT_EQ(sorted_triangles(fast), sorted_triangles(general));
}

// Pyramids replace a cell's triangles when those would cross: they must be valid in every cell.
TEST_P(SurfacePyramidsProperty, AreSoundInEveryCell) {
  expect_sound(surface_of(hostile_scene(GetParam()).build(), Path::pyramids));
}

std::vector<HostileCase> hostile_cases(int most_levels) {
  std::vector<HostileCase> cases;
  for (int kind = 0; kind < static_cast<int>(std::size(kHostile)); ++kind) {
    for (int levels = 1; levels <= most_levels; ++levels) {
      const int seeds = levels == 2 ? 3 : 1;
      for (int i = 0; i < seeds; ++i) {
        cases.push_back({kind, levels, static_cast<std::uint64_t>(100 * levels + i)});
      }
    }
  }
  return cases;
}

INSTANTIATE_TEST_SUITE_P(Fields, SurfaceHostileProperty, testing::ValuesIn(hostile_cases(3)));
// Two levels cover every way a cell can be divided in a balanced stack.
INSTANTIATE_TEST_SUITE_P(Fields, SurfacePyramidsProperty, testing::ValuesIn(hostile_cases(2)));

}  // namespace
}  // namespace argil::test
