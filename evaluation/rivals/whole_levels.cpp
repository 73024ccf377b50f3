// SPDX-License-Identifier: GPL-3.0-or-later
// Clay as it would be without adaptive levels: every level whole, for comparisons of
// memory and of meshers.
#include "rivals/whole_levels.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include <openvdb/tools/SignedFloodFill.h>
#include <tbb/parallel_for.h>

#include "clay/clay_access.h"
#include "field/level_stack.h"

namespace argil::evaluation {
namespace {

using LeafValues = std::array<float, kLeafNodes>;

constexpr double kHalfDiagonal = 0.8661;  // of a cube of side 1, rounded up
constexpr double kSlack = 1e-6;           // in mm: distances are exact but for rounding

/// Origins of the leaves that the band of `distance` may touch, out of one cube of leaves.
class LeafSearch {
 public:
  LeafSearch(const Distance& distance, double voxel_mm)
      : distance_(distance), voxel_mm_(voxel_mm) {}

  /// `side` nodes: 8, 16, 32 …
  void look_in(const Coord& low, int side) {
    assert(side >= kLeafSide && side % kLeafSide == 0);
    const double half = 0.5 * side;
    const Vec3 center{(low.x() + half) * voxel_mm_, (low.y() + half) * voxel_mm_,
                      (low.z() + half) * voxel_mm_};
    const double reach = (kHalfDiagonal * side + kHalfWidthVoxels) * voxel_mm_ + kSlack;
    // Distances change by at most 1 mm in a mm: no point of the cube is nearer than that.
    if (std::abs(distance_(center)) > reach) return;
    if (side == kLeafSide) {
      origins_.push_back(low);
      return;
    }
    const int step = side / 2;
    for (int i = 0; i < 8; ++i) {
      look_in(low.offsetBy((i >> 2) * step, (i >> 1 & 1) * step, (i & 1) * step), step);
    }
  }
  std::vector<Coord> take() { return std::move(origins_); }

 private:
  const Distance& distance_;
  double voxel_mm_;
  std::vector<Coord> origins_;
};

using NodeValue = std::function<float(const Coord& node)>;

/// Fills a level's leaves at those of the origins where the band comes through; returns these.
std::vector<Coord> fill_level(LevelStack& stack, int level, const std::vector<Coord>& origins,
                              const NodeValue& value) {
  constexpr std::size_t kBatch = 4096;
  const float band = stack.band_mm(level);
  std::vector<LeafValues> batch(std::min(kBatch, origins.size()));
  std::vector<char> wanted(batch.size());
  std::vector<Coord> kept;
  for (std::size_t begin = 0; begin < origins.size(); begin += kBatch) {
    const std::size_t count = std::min(kBatch, origins.size() - begin);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t n) {
      bool any = false;
      for (int i = 0; i < kLeafNodes; ++i) {
        const float v = value(origins[begin + n] + Coord(i >> 6, i >> 3 & 7, i & 7));
        batch[n][static_cast<std::size_t>(i)] = std::clamp(v, -band, band);
        any |= std::abs(v) < band;
      }
      wanted[n] = any ? 1 : 0;
    });
    for (std::size_t n = 0; n < count; ++n) {
      if (wanted[n] == 0) continue;
      stack.set_leaf(level, origins[begin + n], batch[n].data());
      kept.push_back(origins[begin + n]);
    }
  }
  // Gives the tiles without leaves the sign of what surrounds them.
  openvdb::tools::signedFloodFill(stack.grid(level).tree());
  return kept;
}

/// The origins of the leaves one level finer in these.
std::vector<Coord> children(const std::vector<Coord>& origins) {
  std::vector<Coord> finer;
  finer.reserve(8 * origins.size());
  for (const Coord& origin : origins) {
    for (int i = 0; i < 8; ++i) {
      finer.push_back((origin << 1).offsetBy((i >> 2) * 8, (i >> 1 & 1) * 8, (i & 1) * 8));
    }
  }
  return finer;
}

}  // namespace

Clay uniform_clay(const Distance& distance, const Box3& bounds_mm, double voxel_mm) {
  assert(voxel_mm > 0.0 && !bounds_mm.empty());
  auto stack = std::make_unique<LevelStack>(voxel_mm, 1);
  double farthest = 0.0;
  for (std::size_t a = 0; a < 3; ++a) {
    farthest = std::max({farthest, std::abs(bounds_mm.min[a]), std::abs(bounds_mm.max[a])});
  }
  int side = kLeafSide;
  // Halved down to leaves of 8 nodes, it must be 8 times a power of two.
  while (side * voxel_mm < farthest + kHalfWidthVoxels * voxel_mm) side *= 2;
  LeafSearch search(distance, voxel_mm);
  search.look_in(Coord(-side), 2 * side);
  fill_level(*stack, 0, search.take(), [&](const Coord& n) {
    return static_cast<float>(distance({n.x() * voxel_mm, n.y() * voxel_mm, n.z() * voxel_mm}));
  });
  ClayOptions options;
  options.voxel_mm = voxel_mm;
  return clay_of_levels(std::move(stack), options);
}

Clay with_whole_levels(const Clay& clay) {
  const LevelStack& from = levels_of(clay);
  auto stack = std::make_unique<LevelStack>(clay.options().voxel_mm, from.count());
  std::vector<Coord> origins = from.sorted_origins(from.top());
  for (int level = from.top(); level >= 0; --level) {
    // Coarse nodes have their own, averaged value; a node of level 0 has only one.
    origins = fill_level(*stack, level, origins,
                         [&](const Coord& node) { return from.sample(level, node); });
    if (level > 0) origins = children(origins);
  }
  return clay_of_levels(std::move(stack), clay.options());
}

std::int64_t leaf_bytes(const Clay& clay, int level) {
  assert(level >= 0 && level <= levels_of(clay).top());
  std::int64_t bytes = 0;
  for (auto leaf = levels_of(clay).grid(level).tree().cbeginLeaf(); leaf; ++leaf) {
    bytes += static_cast<std::int64_t>(leaf->memUsage());
  }
  return bytes;
}

}  // namespace argil::evaluation
