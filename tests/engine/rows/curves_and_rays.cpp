// SPDX-License-Identifier: GPL-3.0-or-later
// Every instruction set gives the same bits: the loops that interpolate and those that pick.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "argil/core/simd.h"

#include "rows/rows.h"

namespace argil {
namespace {

/// What it interpolates: blocks of two rows of that many nodes, in rows of many lengths.
void add_curves(const RowLoops& loops, int nodes, std::mt19937& dice, std::vector<float>& all) {
  std::uniform_real_distribution<float> some(-1.0F, 1.0F);
  std::uniform_real_distribution<float> along(0.0F, 1.0F);
  for (const int inner : {1, 5, 8, 19}) {
    std::vector<float> from(static_cast<std::size_t>(2 * nodes * inner));
    for (float& value : from) value = some(dice);
    std::vector<CurvePlace> places(11);
    for (CurvePlace& place : places) {
      place = {static_cast<int>(dice() % static_cast<unsigned>(nodes - 3)), along(dice)};
    }
    places[3].t = 0.0F;
    std::vector<float> out(2 * places.size() * static_cast<std::size_t>(inner));
    loops.curve_along(
        {from.data(), 2, nodes, inner, places.data(), static_cast<int>(places.size()), 0.3F},
        out.data());
    all.insert(all.end(), out.begin(), out.end());
  }
}

/// A ray and triangles of points around it, some of which it meets.
class RayAmongTriangles {
 public:
  static constexpr int kVertices = 29;  // no multiple of a vector's length
  static constexpr int kTriangles = 50;

  explicit RayAmongTriangles(std::mt19937& dice) {
    std::uniform_real_distribution<float> some(-1.0F, 1.0F);
    for (float& v : vertices_) v = some(dice);
    for (unsigned& t : triangles_) t = static_cast<unsigned>(dice() % kVertices);
    ray_.origin[0] = ray_.origin[1] = ray_.origin[2] = -2.0F;
    const int first = static_cast<int>(dice() % 3);
    for (int a = 0; a < 3; ++a) ray_.axis[a] = (first + a) % 3;
    for (float& shear : ray_.shear) shear = 1.0F + 0.3F * some(dice);
    ray_.per_step = 1.7;
  }

  /// Its place, two weights and the triangle.
  std::array<float, 4> first_hit(const RowLoops& loops) {
    std::array<float, kVertices> x;
    std::array<float, kVertices> y;
    std::array<unsigned char, kVertices> sides;
    const TrianglesJob job{vertices_.data(), kVertices, triangles_.data(), kTriangles,
                           x.data(),         y.data(),  sides.data()};
    TriangleHit hit{1e30, {}, -1};
    loops.meet_triangles(ray_, job, hit);
    return {static_cast<float>(hit.along), static_cast<float>(hit.weight[0]),
            static_cast<float>(hit.weight[1]), static_cast<float>(hit.triangle)};
  }

 private:
  RayJob ray_{};
  std::array<float, TrianglesJob::kVertexFloats * kVertices> vertices_;
  std::array<unsigned, 3 * kTriangles> triangles_;
};

/// How many of 20 boxes a ray enters, which and where.
std::array<float, 41> entered_boxes(const RowLoops& loops, std::mt19937& dice) {
  constexpr int kBoxes = 20;
  std::uniform_real_distribution<float> some(-1.0F, 1.0F);
  std::array<EightBoxes, 3> boxes{};
  for (EightBoxes& eight : boxes) {
    for (int a = 0; a < 3; ++a) {
      for (int k = 0; k < EightBoxes::kCount; ++k) {
        eight.low[a][k] = some(dice);
        eight.high[a][k] = eight.low[a][k] + 0.5F + 0.5F * some(dice);
      }
    }
  }
  RayJob ray{};
  for (int a = 0; a < 3; ++a) {
    ray.origin[a] = -1.0F;
    ray.inverse[a] = 1.0F / (0.1F + std::abs(some(dice)));
  }
  std::array<BoxEntry, kBoxes + 1> entries{};
  const int count = loops.enter_boxes(ray, boxes.data(), kBoxes, 1.5F, entries.data());
  std::array<float, 41> all{static_cast<float>(count)};
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    all[1 + 2 * i] = entries[i].along;
    all[2 + 2 * i] = static_cast<float>(entries[i].box);
  }
  return all;
}

/// All that one set of these loops computes.
std::vector<float> curves_and_hits(const RowLoops& loops, unsigned seed) {
  std::mt19937 dice(seed);
  std::vector<float> all;
  for (const int nodes : {4, 7, 8, 12}) add_curves(loops, nodes, dice, all);
  for (int n = 0; n < 20; ++n) {
    const std::array<float, 4> hit = RayAmongTriangles(dice).first_hit(loops);
    all.insert(all.end(), hit.begin(), hit.end());
  }
  for (int n = 0; n < 20; ++n) {
    const std::array<float, 41> entries = entered_boxes(loops, dice);
    all.insert(all.end(), entries.begin(), entries.end());
  }
  return all;
}

TEST(Rows, InterpolateAndPickToTheSameBitsWithEveryInstructionSet) {
#if defined(__x86_64__)
  if (!has_simd(Simd::avx2)) GTEST_SKIP() << "this machine has no AVX2";
  for (unsigned seed = 1; seed <= 50; ++seed) {
    const std::vector<float> expected = curves_and_hits(baseline::kRowLoops, seed);
    const std::vector<float> found = curves_and_hits(avx2::kRowLoops, seed);
    ASSERT_EQ(found.size(), expected.size());
    ASSERT_EQ(std::memcmp(found.data(), expected.data(), found.size() * sizeof(float)), 0) << seed;
  }
#else
  GTEST_SKIP() << "only x86-64 has several sets";
#endif
}

}  // namespace
}  // namespace argil
