// SPDX-License-Identifier: GPL-3.0-or-later
#include "chart/whole_levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include <openvdb/tools/SignedFloodFill.h>
#include <tbb/parallel_for.h>

#include "level_stack.h"

namespace argil::cli::chart {
namespace {

using LeafValues = std::array<float, kLeafNodes>;

constexpr double kHalfDiagonal = 0.8661;  // of a cube of side 1, rounded up
constexpr double kSlack = 1e-6;           // in mm: distances are exact but for rounding

/// Places of a level whose leaf `distance` may touch with its band, out of one cube of leaves.
class PlaceSearch {
 public:
  PlaceSearch(const Distance& distance, double voxel_mm)
      : distance_(distance), voxel_mm_(voxel_mm) {}

  /// `side` nodes: 8, 16, 32 …
  void look_in(const Coord& low, int side) {
    const double half = 0.5 * side;
    const Vec3 center{(low.x() + half) * voxel_mm_, (low.y() + half) * voxel_mm_,
                      (low.z() + half) * voxel_mm_};
    const double reach = (kHalfDiagonal * side + kHalfWidthVoxels) * voxel_mm_ + kSlack;
    if (std::abs(distance_(center)) > reach) return;
    if (side == kLeafSide) {
      places_.push_back(low);
      return;
    }
    const int step = side / 2;
    for (int i = 0; i < 8; ++i) {
      look_in(low.offsetBy((i >> 2) * step, (i >> 1 & 1) * step, (i & 1) * step), step);
    }
  }
  std::vector<Coord> take() { return std::move(places_); }

 private:
  const Distance& distance_;
  double voxel_mm_;
  std::vector<Coord> places_;
};

using NodeValue = std::function<float(const Coord& node)>;

/// Fills a level's leaves at those of the places where the band comes through; returns these.
std::vector<Coord> fill_level(LevelStack& stack, int level, const std::vector<Coord>& places,
                              const NodeValue& value) {
  constexpr std::size_t kBatch = 4096;
  const float band = stack.band_mm(level);
  std::vector<LeafValues> batch(std::min(kBatch, places.size()));
  std::vector<char> wanted(batch.size());
  std::vector<Coord> kept;
  for (std::size_t begin = 0; begin < places.size(); begin += kBatch) {
    const std::size_t count = std::min(kBatch, places.size() - begin);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t n) {
      bool any = false;
      for (int i = 0; i < kLeafNodes; ++i) {
        const float v = value(places[begin + n] + Coord(i >> 6, i >> 3 & 7, i & 7));
        batch[n][static_cast<std::size_t>(i)] = std::clamp(v, -band, band);
        any |= std::abs(v) < band;
      }
      wanted[n] = any ? 1 : 0;
    });
    for (std::size_t n = 0; n < count; ++n) {
      if (wanted[n] == 0) continue;
      stack.set_leaf(level, places[begin + n], batch[n].data());
      kept.push_back(places[begin + n]);
    }
  }
  openvdb::tools::signedFloodFill(stack.grid(level).tree());
  return kept;
}

/// The places one level finer in these.
std::vector<Coord> children(const std::vector<Coord>& places) {
  std::vector<Coord> finer;
  finer.reserve(8 * places.size());
  for (const Coord& place : places) {
    for (int i = 0; i < 8; ++i) {
      finer.push_back((place << 1).offsetBy((i >> 2) * 8, (i >> 1 & 1) * 8, (i & 1) * 8));
    }
  }
  return finer;
}

}  // namespace

Clay uniform_clay(const Distance& distance, const Box3& bounds_mm, double voxel_mm) {
  auto stack = std::make_unique<LevelStack>(voxel_mm, 1);
  double farthest = 0.0;
  for (std::size_t a = 0; a < 3; ++a) {
    farthest = std::max({farthest, std::abs(bounds_mm.min[a]), std::abs(bounds_mm.max[a])});
  }
  int side = kLeafSide;
  while (side * voxel_mm < farthest + kHalfWidthVoxels * voxel_mm) side *= 2;
  PlaceSearch search(distance, voxel_mm);
  search.look_in(Coord(-side), 2 * side);
  fill_level(*stack, 0, search.take(), [&](const Coord& n) {
    return static_cast<float>(distance({n.x() * voxel_mm, n.y() * voxel_mm, n.z() * voxel_mm}));
  });
  ClayOptions options;
  options.voxel_mm = voxel_mm;
  return Clay::from_levels(std::move(stack), options);
}

Clay with_whole_levels(const Clay& clay) {
  const LevelStack& from = clay.levels();
  auto stack = std::make_unique<LevelStack>(clay.options().voxel_mm, from.count());
  std::vector<Coord> places = from.sorted_places(from.top());
  for (int level = from.top(); level >= 0; --level) {
    // Coarse nodes have their own, averaged value; a node of level 0 has only one.
    places = fill_level(*stack, level, places,
                        [&](const Coord& node) { return from.sample(level, node); });
    if (level > 0) places = children(places);
  }
  return Clay::from_levels(std::move(stack), clay.options());
}

std::int64_t leaf_bytes(const Clay& clay, int level) {
  std::int64_t bytes = 0;
  for (auto leaf = clay.levels().grid(level).tree().cbeginLeaf(); leaf; ++leaf) {
    bytes += static_cast<std::int64_t>(leaf->memUsage());
  }
  return bytes;
}

}  // namespace argil::cli::chart
