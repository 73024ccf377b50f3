// SPDX-License-Identifier: GPL-3.0-or-later
// Every instruction set gives the same bits.
#include "rows/rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "argil/core/simd.h"
#include "argil/engine/action.h"

namespace argil {
namespace {

constexpr float kVoxel = 0.25F;
constexpr float kBand = 4.0F * kVoxel;
constexpr int kNodes = kLeafRows * kRowNodes;

/// What a block of a wavy surface has, with noise; some of it unknown where asked for.
HaloBlock wavy_block(std::mt19937& dice, bool has_holes) {
  std::uniform_real_distribution<float> noise(-0.3F, 0.3F);
  HaloBlock block;
  std::fill(std::begin(block.value), std::end(block.value), kBand);
  const float tilt = noise(dice);
  for (int i = -2; i < kRowNodes + 2; ++i) {
    for (int j = -2; j < kRowNodes + 2; ++j) {
      for (int k = -2; k < kRowNodes + 2; ++k) {
        const float height =
            3.0F + tilt * static_cast<float>(i) + std::sin(0.7F * static_cast<float>(j));
        const float distance = kVoxel * (static_cast<float>(k) - height + noise(dice));
        float& value = block.value[HaloBlock::index(i, j, k)];
        value = std::clamp(distance, -kBand, kBand);
        if (has_holes && i > kRowNodes) value = std::numeric_limits<float>::quiet_NaN();
      }
    }
  }
  return block;
}

NodeFlags some_flags(std::mt19937& dice) {
  NodeFlags flags;
  for (int& flag : flags.is_set) flag = dice() % 5 == 0 ? 1 : 0;
  return flags;
}

PullJob pull_job(std::mt19937& dice) {
  std::uniform_real_distribution<float> some(-0.5F, 0.5F);
  PullJob job{};
  for (float& first : job.first) first = some(dice);
  for (auto& along : job.along) {
    for (float& each : along) each = 0.3F * some(dice);
  }
  for (float& path : job.path) path = some(dice);
  job.inverse_square =
      1.0F / (job.path[0] * job.path[0] + job.path[1] * job.path[1] + job.path[2] * job.path[2]);
  job.height = 1.5F;
  job.falloff = static_cast<Falloff>(dice() % kFalloffNames.size());
  return job;
}

PlaneJob plane_job(std::mt19937& dice) {
  std::uniform_real_distribution<float> some(-0.5F, 0.5F);
  const float most = dice() % 2 == 0 ? 0.0F : 3.0F;
  return {some(dice), {some(dice), some(dice), some(dice)}, -2.0F, most, 0.8F, 1.0F, 3.0F};
}

BallJob ball_job(std::mt19937& dice) {
  std::uniform_real_distribution<float> some(-2.0F, 2.0F);
  BallJob job{{}, {}, some(dice), kVoxel, {0.0F, 0.6F, 0.8F}, 0.7F, 1.25F};
  for (int n = 0; n < kRowNodes; ++n) {
    job.x[n] = some(dice);
    job.y[n] = some(dice);
  }
  return job;
}

/// Of 27 leaves, half of the nodes within 1.5 voxels.
std::vector<float> values_of_leaves(std::mt19937& dice) {
  std::uniform_real_distribution<float> some(-3.0F * kVoxel, 3.0F * kVoxel);
  std::vector<float> values(27 * kNodes);
  const auto smooth = [&](std::size_t n) { return n % 4096 < 2048 ? 0.4F : 1.0F; };
  for (std::size_t n = 0; n < values.size(); ++n) values[n] = smooth(n) * some(dice);
  return values;
}

/// A dense field of 11^3 nodes in whose middle a leaf's lattice lies, half of its nodes inside; a
/// few about it unknown.
struct CutLattice {
  static constexpr int kSide = 11;
  static constexpr int kFirst = (kSide + 1) * kSide + 1;
  std::vector<float> dense;
  std::vector<unsigned> codes;
  CutJob job{};

  explicit CutLattice(std::mt19937& dice) : dense(kSide * kSide * kSide) {
    std::uniform_real_distribution<float> some(-kBand, kBand);
    for (float& value : dense) value = some(dice);
    for (int n = 0; n < kSide * kSide; n += 7) {
      dense[static_cast<std::size_t>(n)] = std::numeric_limits<float>::quiet_NaN();
    }
    job = {dense.data() + kFirst, kSide * kSide, kSide, {-16, 8, 64}, 0.25, 0.02, 0.12, 12345};
    for (unsigned axis = 0; axis < 3; ++axis) {
      for (unsigned n = 0; n < 9 * 9 * 9; ++n) {
        const std::array<unsigned, 3> low{n / 81, n / 9 % 9, n % 9};
        if (low[axis] == 8) continue;
        const float* const at = node(low);
        if ((*at < 0.0F) == (at[stride(axis)] < 0.0F)) continue;
        codes.push_back(axis << 24 | low[0] << 16 | low[1] << 8 | low[2] |
                        (n % 3 == 0 ? CutJob::kIsShared : 0U));
      }
    }
  }
  int stride(unsigned axis) const { return axis == 0 ? kSide * kSide : (axis == 1 ? kSide : 1); }
  const float* node(const std::array<unsigned, 3>& low) const {
    return job.dense + stride(0) * static_cast<int>(low[0]) + stride(1) * static_cast<int>(low[1]) +
           static_cast<int>(low[2]);
  }
};

struct Cuts {
  std::vector<double> position;
  std::vector<double> normal;
  std::vector<std::uint64_t> key;
  std::vector<unsigned short> flat;
};
Cuts cuts_of(const RowLoops& loops, const CutLattice& lattice) {
  std::vector<unsigned> codes = lattice.codes;
  const std::size_t room = codes.size() + CutJob::kLanes;
  codes.resize(room, codes.back());
  Cuts cuts{std::vector<double>(3 * room), std::vector<double>(3 * room),
            std::vector<std::uint64_t>(room), std::vector<unsigned short>(room)};
  const CutVertices out{cuts.position.data(), cuts.normal.data(), cuts.key.data()};
  const auto count = static_cast<int>(lattice.codes.size());
  const int flats = loops.place_cuts(lattice.job, codes.data(), count, out, cuts.flat.data());
  cuts.position.resize(3 * lattice.codes.size());
  cuts.normal.resize(3 * lattice.codes.size());
  cuts.key.resize(lattice.codes.size());
  cuts.flat.resize(static_cast<std::size_t>(flats));
  return cuts;
}

/// 16 points, and quadrilaterals among them.
std::vector<double> some_points(std::mt19937& dice) {
  std::uniform_real_distribution<double> some(-1.0, 1.0);
  std::vector<double> points(3 * 16);
  for (double& each : points) each = some(dice);
  return points;
}
std::vector<Quadrilateral> some_quads(std::mt19937& dice) {
  std::vector<Quadrilateral> quads(13);
  for (Quadrilateral& quad : quads) {
    for (unsigned& vertex : quad.vertex) vertex = dice() % 16;
  }
  return quads;
}

/// What it makes of the surface.
void add_contour(const RowLoops& loops, std::mt19937& dice, std::vector<float>& all) {
  const auto keep_bits = [&](const auto& values) {
    const std::size_t bytes = values.size() * sizeof(values[0]);
    const std::size_t first = all.size();
    all.resize(first + (bytes + sizeof(float) - 1) / sizeof(float));
    std::memcpy(all.data() + first, values.data(), bytes);
  };
  const Cuts cuts = cuts_of(loops, CutLattice(dice));
  keep_bits(cuts.position);
  keep_bits(cuts.key);
  keep_bits(cuts.flat);
  // A flat vertex has no normal: any NaN.
  std::vector<double> normals = cuts.normal;
  for (const unsigned short n : cuts.flat) std::fill_n(normals.begin() + 3 * n, 3, 0.0);
  keep_bits(normals);
  const std::vector<double> points_of_quads = some_points(dice);
  const std::vector<Quadrilateral> quads = some_quads(dice);
  std::vector<unsigned char> is_even(quads.size());
  loops.choose_diagonals(points_of_quads.data(), quads.data(), static_cast<int>(quads.size()),
                         is_even.data());
  keep_bits(is_even);
}

/// What it solves.
void add_sweeps(const RowLoops& loops, const HaloBlock& block, std::mt19937& dice,
                std::vector<float>& all) {
  float out[kNodes] = {};
  for (const bool has_plain : {true, false}) {
    unsigned char stays[kLeafRows];
    unsigned char plain[kLeafRows];
    for (int row = 0; row < kLeafRows; ++row) {
      stays[row] = static_cast<unsigned char>(dice() & dice());
      plain[row] = static_cast<unsigned char>(dice() & dice());
    }
    const std::uint64_t rows = (std::uint64_t{dice()} << 32 | dice()) | dice();
    const std::uint64_t moved =
        loops.sweep(block, stays, kVoxel, kBand, 0.01F, rows, has_plain ? plain : nullptr, out);
    all.insert(all.end(), out, out + kNodes);
    for (int row = 0; row < kLeafRows; ++row) {
      all.push_back(static_cast<float>(moved >> row & 1U));
      all.push_back(static_cast<float>(plain[row]));
    }
  }
}

/// How far it deepens a distance.
void add_depths(const RowLoops& loops, std::mt19937& dice, std::vector<float>& all) {
  constexpr float kLimit = 2.0F * kBand;
  HaloBlock block = wavy_block(dice, false);
  for (float& value : block.value)
    value = std::abs(value) < 0.9F * kBand ? std::abs(value) : kLimit;
  unsigned char kept[kLeafRows] = {};
  for (int n = 0; n < kNodes; ++n) {
    const float value = block.value[HaloBlock::index(n / 64, n / 8 % 8, n % 8)];
    if (value < kLimit) kept[n / 8] = static_cast<unsigned char>(kept[n / 8] | 1U << n % 8);
  }
  for (int pass = 0; pass < 5; ++pass) {
    const std::uint64_t rows = (std::uint64_t{dice()} << 32 | dice()) | dice();
    const std::uint64_t moved =
        loops.deepen(block, kept, kVoxel, kLimit, 0.01F * kVoxel, rows, pass);
    for (int row = 0; row < kLeafRows; ++row) all.push_back(static_cast<float>(moved >> row & 1U));
  }
  for (int n = 0; n < kNodes; ++n) {
    all.push_back(block.value[HaloBlock::index(n / 64, n / 8 % 8, n % 8)]);
  }
}

/// Any functions will do: no triangle has them.
LeafTriangle leaf_triangle(std::mt19937& dice) {
  std::uniform_real_distribution<float> some(-1.0F, 1.0F);
  LeafTriangle triangle{};
  const auto set = [&](LatticeFunction& f) {
    f.first = 4.0F * some(dice);
    for (float& along : f.along) along = some(dice);
  };
  set(triangle.height);
  for (LatticeFunction& f : triangle.beyond) set(f);
  for (LatticeFunction& f : triangle.along) set(f);
  for (float& to : triangle.to) to = 2.0F + some(dice);
  for (int axis = 0; axis < 2; ++axis) {
    triangle.first[axis] = static_cast<int>(dice() % 4);
    triangle.last[axis] = 4 + static_cast<int>(dice() % 4);
  }
  return triangle;
}

/// Distances from triangles, and which are asked.
void add_triangles(const RowLoops& loops, std::mt19937& dice, std::vector<float>& all) {
  std::vector<LeafTriangle> triangles(20);
  for (LeafTriangle& triangle : triangles) triangle = leaf_triangle(dice);
  alignas(64) float squares[kNodes];
  std::fill(std::begin(squares), std::end(squares), 16.0F);
  loops.lower_to_triangles(triangles.data(), 12, squares);
  const std::vector<int> chosen = {19, 3, 14, 15};
  const std::array<int, 3> first = {static_cast<int>(dice() % 7), static_cast<int>(dice() % 7),
                                    static_cast<int>(dice() % 7)};
  loops.lower_cube(triangles.data(), chosen.data(), 4, first.data(), squares);
  all.insert(all.end(), squares, squares + kNodes);
  unsigned char inside[kLeafRows];
  for (unsigned char& row : inside) row = static_cast<unsigned char>(dice());
  float out[kNodes];
  loops.sign_distances(squares, inside, kVoxel, 3.5F * kVoxel, 0.1F, out);
  all.insert(all.end(), out, out + kNodes);

  constexpr int kBalls = 64;
  std::uniform_real_distribution<float> some(-6.0F, 6.0F);
  std::array<std::vector<float>, 3> at;
  for (auto& each : at) {
    each.resize(kBalls);
    for (float& value : each) value = some(dice);
  }
  std::vector<float> radius(kBalls);
  for (float& each : radius) each = 0.1F * std::abs(some(dice));
  const BallsJob job{{at[0].data(), at[1].data(), at[2].data()}, radius.data(), kBalls,
                     {some(dice), some(dice), some(dice)},       1.5F,          4.0F};
  std::vector<int> found(kBalls);
  found.resize(static_cast<std::size_t>(loops.choose_balls(job, found.data())));
  all.push_back(static_cast<float>(found.size()));
  for (const int each : found) all.push_back(static_cast<float>(each));
}

/// Feet on a bumpy sheet below a block, and what one asks of them.
struct FeetOfALayer {
  static constexpr int kCount = 400;
  static constexpr int kOfCluster = 40;
  static constexpr int kClusters = 16;  ///< with those that fill the vectors up
  std::vector<float> values = std::vector<float>(7 * kCount);
  std::array<std::vector<float>, 3> kept;
  std::vector<int> which = std::vector<int>(kCount + kRowNodes);
  std::vector<int> chosen = std::vector<int>(kCount + kRowNodes);
  std::uint64_t labels = 0;
  std::vector<LayerCluster> clusters = std::vector<LayerCluster>(kClusters);
  std::array<std::vector<float>, 3> low;
  std::array<std::vector<float>, 3> high;
  std::vector<float> unsure = std::vector<float>(kClusters, std::numeric_limits<float>::infinity());
  std::vector<float> nearness = std::vector<float>(kClusters);

  explicit FeetOfALayer(std::mt19937& dice) {
    std::uniform_real_distribution<float> some(-1.0F, 1.0F);
    for (int n = 0; n < kCount; ++n) {
      const auto set = [&](int field, float to) {
        values[static_cast<std::size_t>(field * kCount + n)] = to;
      };
      const float tilt_x = 0.3F * some(dice);
      const float tilt_y = 0.3F * some(dice);
      const float steep = std::sqrt(1.0F + tilt_x * tilt_x + tilt_y * tilt_y);
      const int cluster = n / kOfCluster;
      set(0, n % 17 == 0 ? 1e15F : 2.0F * some(dice) + static_cast<float>(3 * (cluster % 4) - 5));
      set(1, 3.0F * some(dice) + static_cast<float>(5 * (cluster / 4) - 5));
      set(2, -2.0F + 0.5F * some(dice));
      set(3, tilt_x / steep);
      set(4, tilt_y / steep);
      set(5, 1.0F / steep);
      set(6, 0.2F * some(dice));
    }
    for (auto& each : low) each.assign(kClusters, 1e15F);
    for (auto& each : high) each.assign(kClusters, 1e15F);
    for (auto& each : kept) each.resize(kCount + kRowNodes);
    for (int cluster = 0; cluster < kCount / kOfCluster; ++cluster) set_cluster(cluster);
  }
  void set_cluster(int cluster) {
    const auto at = static_cast<std::size_t>(cluster);
    const float* first = values.data() + static_cast<std::ptrdiff_t>(cluster) * kOfCluster;
    clusters[at] = {first, kCount, kOfCluster, std::uint64_t{1} << cluster, {0.25F, -0.5F, 0.0F}};
    const bool has_all = std::none_of(first, first + kOfCluster, [](float x) { return x > 1e14F; });
    unsure[at] = has_all ? 0.0F : std::numeric_limits<float>::infinity();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float* from = first + static_cast<std::ptrdiff_t>(axis) * kCount;
      const float offset = clusters[at].offset[axis];
      low[axis][at] = *std::min_element(from, from + kOfCluster) + offset;
      high[axis][at] = *std::max_element(from, from + kOfCluster) + offset;
    }
  }
  LayerJob job(float height) {
    LayerJob job{};
    job.cluster = clusters.data();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      job.low[axis] = low[axis].data();
      job.high[axis] = high[axis].data();
      job.kept[axis] = kept[axis].data();
      job.first[axis] = axis == 2 ? height : -1.0F;
    }
    job.unsure = unsure.data();
    job.clusters = kClusters;
    job.step = 0.5F;
    job.layer = 1.75F;
    job.patch = 0.75F;
    job.which = which.data();
    job.chosen = chosen.data();
    job.labels = &labels;
    job.nearness = nearness.data();
    return job;
  }
};

/// One that crosses the middle of the leaf, narrower and deeper from end to end.
ProfileJob profile_job(std::mt19937& dice) {
  std::uniform_real_distribution<float> some(-0.1F, 0.1F);
  ProfileJob job{};
  for (float& first : job.first) first = -0.75F + some(dice);
  job.voxel = kVoxel;
  job.normal[0] = 0.28F;
  job.normal[2] = 0.96F;
  job.path[1] = 0.5F;
  job.inverse_square = 4.0F;
  job.above = some(dice);
  job.scale[0] = 0.5F;
  job.scale[1] = 0.1F;
  job.width[0] = 0.8F;
  job.width[1] = -0.2F;
  job.round = 0.3F;
  job.inverse_reach = 0.4F;
  job.side = dice() % 2 == 0 ? 1.0F : -1.0F;
  job.deepest = 0.6F;
  job.band = kBand;
  job.known = dice() % 2 == 0 ? kBand : 1e9F;
  return job;
}

/// All that one set of loops computes, as bits.
std::vector<float> results(const RowLoops& loops, unsigned seed) {
  std::mt19937 dice(seed);
  std::vector<float> all;
  const auto keep = [&](const float* values, int count) {
    all.insert(all.end(), values, values + count);
  };
  add_contour(loops, dice, all);
  float out[kNodes] = {};
  NodeFlags kept = some_flags(dice);
  const HaloBlock block = wavy_block(dice, false);
  loops.seed(block, some_flags(dice), kVoxel, kept, out);
  keep(out, kNodes);
  add_sweeps(loops, block, dice, all);
  add_depths(loops, dice, all);
  add_triangles(loops, dice, all);
  unsigned char bits[3][kLeafRows] = {};
  loops.find_out_of_bounds(block, {3.0F, 0.9F, 1.1F}, kVoxel, bits[0]);
  loops.ball_distances(ball_job(dice), out);
  keep(out, kNodes);
  const std::vector<float> leaves = values_of_leaves(dice);
  RestrictJob restrict_job{{}, 1.5F * kVoxel, kVoxel};
  for (std::size_t n = 0; n < 27; ++n) restrict_job.leaves[n] = leaves.data() + n * kNodes;
  loops.restrict_leaf(restrict_job, out, bits[1], bits[2]);
  for (const auto& each : bits) {
    for (const unsigned char row : each) all.push_back(static_cast<float>(row));
  }
  for (int n = 0; n < kNodes; ++n) {
    const bool is_decided = (bits[1][n / 8] >> n % 8 & 1) != 0;
    all.push_back(is_decided ? out[n] : 0.0F);
  }
  UpwindRows upwind;
  loops.find_upwind(block, {dice() % 2 == 0 ? 1.0F : -1.0F, kVoxel, kBand, 0.8F, 0.2F}, upwind);
  for (int row = 0; row < kLeafRows; ++row) {
    all.push_back(static_cast<float>(upwind.told[row]));
    all.push_back(static_cast<float>(upwind.slow[row]));
    for (const auto& by : upwind.by) all.push_back(static_cast<float>(by[row]));
  }
  auto feet = std::make_unique<FeetBlock>();
  loops.find_feet(wavy_block(dice, true), kVoxel, kBand, *feet);
  loops.pull(pull_job(dice), *feet);
  const std::vector<float> field = [&] {
    std::uniform_real_distribution<float> some(-1.0F, 1.0F);
    std::vector<float> values(20 * 21 * 22);
    for (float& value : values) value = some(dice);
    return values;
  }();
  const FieldJob job{field.data(), {20, 21, 22}, {5.5F, 4.25F, 6.0F}, 0.9F};
  for (int row = 0; row < kLeafRows; ++row) {
    if (!feet->at.is_asked[row]) continue;
    loops.read(job, feet->at, out);
    keep(feet->pull + kRowNodes * row, kRowNodes);
    keep(feet->at.x + kRowNodes * row, kRowNodes);
    keep(out + kRowNodes * row, kRowNodes);
  }
  const HaloBlock own = wavy_block(dice, false);
  float values[kNodes];
  for (int n = 0; n < kNodes; ++n) {
    values[n] = own.value[HaloBlock::index(n / 64, n / 8 % 8, n % 8)];
  }
  std::fill(std::begin(out), std::end(out), 0.75F);
  loops.lay_profile(profile_job(dice), wavy_block(dice, true), out, values);
  keep(values, kNodes);
  loops.draw_to_plane(plane_job(dice), *feet, out);
  all.push_back(loops.displace(out, feet->at.is_asked, kBand, 0.1F, values));
  keep(values, kNodes);
  PointBlock points{};
  for (int n = 0; n < kNodes; ++n) {
    points.x[n] = static_cast<float>(n / 64);
    points.y[n] = static_cast<float>(n / 8 % 8);
    points.z[n] = static_cast<float>(n % 8);
  }
  loops.add_pinch({pull_job(dice), {-3.0F, -4.0F, -2.5F}, {0.0F, 0.6F, 0.8F}, 0.1F}, points);
  loops.add_drag({pull_job(dice), {0.5F, -0.25F, 1.0F}}, points);
  std::fill(std::begin(points.is_asked), std::end(points.is_asked), true);
  loops.read_cubic(job, points, out);
  keep(out, kNodes);
  keep(points.y, kNodes);
  FeetOfALayer layer(dice);
  std::array<float, LayerJob::kNodes> bound;
  std::array<float, LayerJob::kNodes> distance;
  bound.fill(5.0F);
  distance.fill(5.0F);
  loops.lower_to_layer(layer.job(-1.5F), bound.data(), distance.data());
  keep(bound.data(), LayerJob::kNodes);
  keep(distance.data(), LayerJob::kNodes);
  return all;
}

TEST(Rows, GiveTheSameBitsWithEveryInstructionSet) {
#if defined(__x86_64__)
  if (!has_simd(Simd::avx2)) GTEST_SKIP() << "this machine has no AVX2";
  for (unsigned seed = 1; seed <= 50; ++seed) {
    const std::vector<float> expected = results(baseline::kRowLoops, seed);
    const std::vector<float> found = results(avx2::kRowLoops, seed);
    ASSERT_EQ(found.size(), expected.size());
    ASSERT_GT(found.size(), 2500U);
    ASSERT_EQ(std::memcmp(found.data(), expected.data(), found.size() * sizeof(float)), 0) << seed;
  }
#else
  GTEST_SKIP() << "only x86-64 has several sets";
#endif
}

/// The distance that the nearest foot's patch tells, and the way over the foot.
std::pair<double, double> told_by_layer(const FeetOfALayer& layer, const LayerJob& job, int node) {
  const std::array<double, 3> at = {
      static_cast<double>(job.first[0] + static_cast<float>(node >> 4) * job.step),
      static_cast<double>(job.first[1] + static_cast<float>(node >> 2 & 3) * job.step),
      static_cast<double>(job.first[2] + static_cast<float>(node & 3) * job.step)};
  const auto field = [&](std::size_t which, std::size_t n) {
    return static_cast<double>(layer.values[which * FeetOfALayer::kCount + n]);
  };
  double best = 1e30;
  double told = 0.0;
  for (std::size_t n = 0; n < FeetOfALayer::kCount; ++n) {
    double square = 0.0;
    double height = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double off =
          at[axis] - field(axis, n) - static_cast<double>(layer.clusters[0].offset[axis]);
      square += off * off;
      height += off * field(3 + axis, n);
    }
    if (!(square < best)) continue;
    best = square;
    const double aside = std::sqrt(std::max(square - height * height, 0.0));
    // The ball of the patch's bend that touches it: its centre lies 1 / bend below.
    const double radius = 1.0 / field(6, n);
    const double to_center = std::copysign(std::hypot(radius + height, aside), radius);
    const double patch = static_cast<double>(job.patch);
    const bool is_held = aside <= patch * to_center / radius && 1.0 + height / radius > 0.0;
    const double fallen = height + 0.5 * patch * patch / radius;
    const double rim = fallen < 0.0 ? fallen : std::hypot(fallen, aside - patch);
    told = static_cast<double>(job.layer) + (is_held ? to_center - radius : rim);
  }
  return {told, std::sqrt(best) + static_cast<double>(job.layer)};
}

TEST(Rows, LayersTellTheDistanceOfTheNearestPatch) {
  std::mt19937 dice(5);
  for (const RowLoops* loops : {&baseline::kRowLoops, &row_loops()}) {
    for (const float height : {-1.5F, 0.5F, 4.0F, 20.0F}) {
      FeetOfALayer feet(dice);
      const LayerJob job = feet.job(height);
      std::array<float, LayerJob::kNodes> bound;
      std::array<float, LayerJob::kNodes> distance;
      bound.fill(20.0F);
      distance.fill(30.0F);
      loops->lower_to_layer(job, bound.data(), distance.data());
      for (int node = 0; node < LayerJob::kNodes; ++node) {
        const auto [told, way] = told_by_layer(feet, job, node);
        const auto n = static_cast<std::size_t>(node);
        EXPECT_NEAR(bound[n], way < 20.0 ? way : 20.0, 1e-4) << height;
        EXPECT_NEAR(distance[n], way < 20.0 ? told : 30.0, 2e-3) << height;
      }
    }
  }
}

TEST(Rows, ALayerSeenFromBehindIsAsFarAsItsSurface) {
  // All of the surface lies between 3 and 4.5.
  std::mt19937 dice(11);
  for (const RowLoops* loops : {&baseline::kRowLoops, &row_loops()}) {
    FeetOfALayer feet(dice);
    LayerJob job = feet.job(-12.0F);
    job.by_surface = true;
    std::array<float, LayerJob::kNodes> way;
    std::array<float, LayerJob::kNodes> distance;
    way.fill(30.0F);
    distance.fill(30.0F);
    loops->lower_to_layer(job, way.data(), distance.data());
    for (std::size_t n = 0; n < way.size(); ++n) {
      const double z = -12.0 + 0.5 * static_cast<double>(n & 3);
      EXPECT_GE(way[n], -4.5 - z);
      EXPECT_LT(way[n], 30.0F);
      EXPECT_GE(distance[n], -4.75 - z);
      EXPECT_LT(distance[n], 30.0F);
    }
  }
}

/// By the formulas of out_of_gradient_bounds(), one node at a time.
TEST(Rows, BoundsAreThoseOfThePlainFormula) {
  const GradientBounds bounds{3.0F, 0.9F, 1.1F};
  std::mt19937 dice(7);
  int out = 0;
  for (int n = 0; n < 20; ++n) {
    const HaloBlock block = wavy_block(dice, n % 2 == 1);
    unsigned char rows[kLeafRows];
    row_loops().find_out_of_bounds(block, bounds, kVoxel, rows);
    for (int node = 0; node < kNodes; ++node) {
      const float* at = block.value + HaloBlock::index(node / 64, node / 8 % 8, node % 8);
      float rises = 0.0F;
      float falls = 0.0F;
      bool is_decided = std::abs(*at) < 3.0F * kVoxel;
      for (const int stride : {HaloBlock::kSide * HaloBlock::kRow, HaloBlock::kRow, 1}) {
        const float low = at[-stride];
        const float high = at[stride];
        is_decided = is_decided && !std::isnan(low) && !std::isnan(high) &&
                     (low < 0.0F) == (*at < 0.0F) && (high < 0.0F) == (*at < 0.0F);
        const float rise = 0.5F * (high - low);
        const float fall = std::abs(*at) - std::min(std::abs(low), std::abs(high));
        rises += rise * rise;
        falls += fall > 0.0F ? fall * fall : 0.0F;
      }
      const float upwind = std::sqrt(falls) / kVoxel;
      const float either = std::max(upwind, std::sqrt(rises) / kVoxel);
      const bool is_out = is_decided && (either < bounds.least || upwind > bounds.most);
      ASSERT_EQ((rows[node / 8] >> node % 8 & 1) != 0, is_out) << n << ' ' << node;
      out += is_out ? 1 : 0;
    }
  }
  EXPECT_GT(out, 100);
}

TEST(Rows, VerticesAreThoseOfThePlainFormula) {
  std::mt19937 dice(3);
  const CutLattice lattice(dice);
  const Cuts cuts = cuts_of(row_loops(), lattice);
  std::size_t flats = 0;
  for (std::size_t n = 0; n < lattice.codes.size(); ++n) {
    const unsigned code = lattice.codes[n];
    const std::array<unsigned, 3> low{code >> 16 & 0xff, code >> 8 & 0xff, code & 0xff};
    const unsigned axis = code >> 24 & 3;
    const float* const at = lattice.node(low);
    const float* const next = at + lattice.stride(axis);
    const auto from = static_cast<double>(*at);
    const double t = std::clamp(from / (from - static_cast<double>(*next)), 0.02, 0.98);
    double square = 0.0;
    std::array<double, 3> normal{};
    for (unsigned a = 0; a < 3; ++a) {
      const double along = a == axis ? t : 0.0;
      EXPECT_EQ(cuts.position[3 * n + a],
                (static_cast<double>(lattice.job.node[a]) + low[a] + along) * 0.25);
      const int s = lattice.stride(a);
      const auto before = static_cast<double>(at[s] - at[-s]);
      normal[a] = before + t * (static_cast<double>(next[s] - next[-s]) - before);
      square += normal[a] * normal[a];
    }
    const bool is_shared = (code & CutJob::kIsShared) != 0;
    const std::uint64_t key = 12345 + (std::uint64_t{low[0]} << 45) +
                              (std::uint64_t{low[1]} << 26) + (std::uint64_t{low[2]} << 7) +
                              (std::uint64_t{axis} << 5);
    EXPECT_EQ(cuts.key[n], is_shared ? key : ~std::uint64_t{0});
    if (!(square > 0.0)) {
      ASSERT_LT(flats, cuts.flat.size());
      EXPECT_EQ(cuts.flat[flats++], n);
      continue;
    }
    for (unsigned a = 0; a < 3; ++a) {
      EXPECT_NEAR(cuts.normal[3 * n + a], normal[a] / std::sqrt(square), 1e-14);
    }
  }
  EXPECT_EQ(flats, cuts.flat.size());
  EXPECT_GT(flats, 0U);
  EXPECT_GT(lattice.codes.size(), flats + 500);
}

TEST(Rows, DiagonalsAreThoseOfTheBetterWorstTriangle) {
  std::mt19937 dice(5);
  const std::vector<double> points = some_points(dice);
  const std::vector<Quadrilateral> quads = some_quads(dice);
  std::vector<unsigned char> is_even(quads.size());
  row_loops().choose_diagonals(points.data(), quads.data(), static_cast<int>(quads.size()),
                               is_even.data());
  const auto shape = [&](const Quadrilateral& quad, int a, int b, int c) {
    std::array<std::array<double, 3>, 3> side{};
    double sides = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto at = [&](int corner) { return points[3 * quad.vertex[corner] + axis]; };
      side[0][axis] = at(b) - at(a);
      side[1][axis] = at(c) - at(a);
      side[2][axis] = at(c) - at(b);
      for (const auto& each : side) sides += each[axis] * each[axis];
    }
    double area = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const double n = side[0][i] * side[1][j] - side[0][j] * side[1][i];
      area += n * n;
    }
    return area / (sides * sides);
  };
  int even = 0;
  for (std::size_t n = 0; n < quads.size(); ++n) {
    const double along_even = std::min(shape(quads[n], 0, 1, 2), shape(quads[n], 0, 2, 3));
    const double along_odd = std::min(shape(quads[n], 1, 2, 3), shape(quads[n], 1, 3, 0));
    if (std::abs(along_even - along_odd) > 1e-12) {
      EXPECT_EQ(is_even[n] != 0, along_even > along_odd) << n;
    }
    even += is_even[n];
  }
  EXPECT_GT(even, 0);
  EXPECT_LT(even, static_cast<int>(quads.size()));
}

/// What rests and what is kept stays to the bit.
TEST(Rows, SweepsLeaveTheOthersAlone) {
  std::mt19937 dice(17);
  int moves = 0;
  for (int round = 0; round < 20; ++round) {
    const HaloBlock block = wavy_block(dice, false);
    unsigned char kept[kLeafRows];
    for (unsigned char& row : kept) row = static_cast<unsigned char>(dice() & dice());
    const std::uint64_t rows = std::uint64_t{dice()} << 32 | dice();
    float out[kNodes];
    const std::uint64_t moved =
        row_loops().sweep(block, kept, kVoxel, kBand, 0.01F, rows, nullptr, out);
    EXPECT_EQ(moved & ~rows, 0U);
    for (int n = 0; n < kNodes; ++n) {
      const float was = block.value[HaloBlock::index(n / 64, n / 8 % 8, n % 8)];
      const bool is_swept = (rows >> n / 8 & 1U) != 0 && (kept[n / 8] >> n % 8 & 1) == 0;
      if (!is_swept) {
        ASSERT_EQ(out[n], was) << n;
      } else if (std::abs(out[n] - was) > 0.01F) {
        ASSERT_NE(moved >> n / 8 & 1U, 0U) << n;
        ++moves;
      }
    }
  }
  EXPECT_GT(moves, 1000);
}

/// A foot on each node, pulled by less and less, in every other row.
FeetBlock feet_of_nodes() {
  FeetBlock feet{};
  for (int n = 0; n < kNodes; ++n) {
    feet.at.x[n] = static_cast<float>(n / 64) + 0.3F;
    feet.at.y[n] = static_cast<float>(n / 8 % 8) - 0.2F;
    feet.at.z[n] = static_cast<float>(n % 8);
    feet.pull[n] = 1.0F - static_cast<float>(n) / kNodes;
    feet.at.is_asked[n / 8] = n / 8 % 2 == 0;
  }
  return feet;
}

/// Of two steps the second covers p / (2 - p) of what is left.
TEST(Rows, DrawToAPlaneByThePlainFormula) {
  const FeetBlock feet = feet_of_nodes();
  const PlaneJob job{-1.5F, {0.2F, 0.3F, -0.1F}, 0.0F, 2.0F, 0.9F, 1.0F, 2.0F};
  float moves[kNodes];
  for (int n = 0; n < kNodes; ++n) moves[n] = 1.3F * std::cos(0.05F * static_cast<float>(n));
  std::array<float, kNodes> facing;
  std::copy_n(moves, kNodes, facing.begin());
  row_loops().draw_to_plane(job, feet, moves);
  int moved = 0;
  for (std::size_t n = 0; n < kNodes; ++n) {
    if (!feet.at.is_asked[n / 8]) {
      ASSERT_EQ(moves[n], facing[n]);
      continue;
    }
    const double distance = -1.5 + 0.2 * static_cast<double>(feet.at.x[n]) +
                            0.3 * static_cast<double>(feet.at.y[n]) -
                            0.1 * static_cast<double>(feet.at.z[n]);
    const double part = 0.9 * static_cast<double>(feet.pull[n]);
    const double expected = part / (2.0 - part) * std::clamp(distance, 0.0, 2.0) *
                            std::clamp(static_cast<double>(facing[n]), 0.0, 1.0);
    ASSERT_NEAR(static_cast<double>(moves[n]), expected, 1e-5) << n;
    moved += expected > 0.01 ? 1 : 0;
  }
  EXPECT_GT(moved, 30);
}

TEST(Rows, DisplaceWithinTheBandAndNoFartherThanAsked) {
  std::array<bool, kLeafRows> is_asked;
  float values[kNodes];
  float moves[kNodes];
  for (int n = 0; n < kNodes; ++n) {
    is_asked[static_cast<std::size_t>(n / 8)] = n / 8 % 3 != 0;
    values[n] = std::clamp(1.3F * kBand * std::sin(0.4F * static_cast<float>(n)), -kBand, kBand);
    moves[n] = 0.5F * std::cos(0.3F * static_cast<float>(n));
  }
  std::array<float, kNodes> before;
  std::copy_n(values, kNodes, before.begin());
  const float farthest = row_loops().displace(moves, is_asked.data(), kBand, 0.3F, values);
  float expected = 0.0F;
  for (std::size_t n = 0; n < kNodes; ++n) {
    if (!is_asked[n / 8] || std::abs(before[n]) >= kBand) {
      ASSERT_EQ(values[n], before[n]) << n;
      continue;
    }
    expected = std::max(expected, std::abs(moves[n]));
    const float moved = before[n] + std::clamp(moves[n], -0.3F, 0.3F);
    ASSERT_EQ(values[n], std::clamp(moved, -kBand, kBand)) << n;
  }
  EXPECT_EQ(farthest, expected);
}

}  // namespace
}  // namespace argil
