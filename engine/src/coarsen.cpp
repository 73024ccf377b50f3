// SPDX-License-Identifier: GPL-3.0-or-later
#include "coarsen.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <openvdb/tools/SignedFloodFill.h>
#include <tbb/parallel_for.h>

#include "extend.h"
#include "restriction.h"
#include "retention.h"

namespace argil {
namespace {

class StackSource final : public FineSource {
 public:
  StackSource(const LevelStack& stack, int level) : stack_(stack), level_(level) {}
  const float* now(const Coord& place) const override {
    const VdbLeaf* leaf = stack_.leaf(level_, place);
    return leaf == nullptr ? nullptr : leaf->buffer().data();
  }
  const float* changed_from(const Coord&) const override { return nullptr; }

 private:
  const LevelStack& stack_;
  int level_;
};

/// The coarse places that the band of a complete finer level can reach.
std::vector<Coord> places_above(const LevelStack& stack, int level) {
  std::set<Coord> places;
  for (auto leaf = stack.grid(level).tree().cbeginLeaf(); leaf; ++leaf) {
    for_each_required_place(leaf->origin(), [&](const Coord& place) { places.insert(place); });
  }
  return {places.begin(), places.end()};
}

/// Fills a coarse leaf from the complete finer level: its restriction where that has a band, else
/// the side it lies on, to be solved.
void fill_from_finer(const StackSource& source, const VdbGrid& finer, float fine_band,
                     float coarse_band, LeafEdit& leaf) {
  FineNeighbourhood around;
  gather_fine(source, leaf.place, around);
  const auto tiles = finer.getConstUnsafeAccessor();
  for (int i = 0; i < kLeafSide; ++i) {
    for (int j = 0; j < kLeafSide; ++j) {
      for (int k = 0; k < kLeafSide; ++k) {
        const auto n = static_cast<std::size_t>((i * kLeafSide + j) * kLeafSide + k);
        if (restrict_node(around, fine_band, i, j, k, leaf.now[n])) {
          leaf.restricted.set(n);
        } else {
          const Coord fine = leaf.place.offsetBy(i, j, k) << 1;
          leaf.now[n] = tiles.getValue(fine) < 0.0F ? -coarse_band : coarse_band;
        }
      }
    }
  }
  leaf.renew = true;
}

void build_above(LevelStack& stack, int level) {
  LevelEdit coarse(stack, level + 1, places_above(stack, level));
  const StackSource source(stack, level);
  auto& leaves = coarse.leaves();
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    fill_from_finer(source, stack.grid(level), stack.band_mm(level), coarse.band_mm(), leaves[n]);
  });
  extend(coarse, Seeds::keep);
  for (const LeafEdit& leaf : leaves) {
    if (has_band(leaf.now.data(), coarse.band_mm())) {
      stack.set_leaf(level + 1, leaf.place, leaf.now.data());
    }
  }
  openvdb::tools::signedFloodFill(stack.grid(level + 1).tree());
}

/// Drops the leaves of one level that are neither needed nor required, given the finer ones are
/// final.
void drop_level(LevelStack& stack, int level, double tolerance_mm) {
  const std::vector<Coord> places = stack.sorted_places(level);
  std::vector<std::uint8_t> stays(places.size(), 1);
  const RetentionRule rule = retention_rule(stack, level, tolerance_mm);
  tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t n) {
    if (level > 0 && required_by_finer(places[n], [&](const Coord& fine) {
          return stack.has_leaf(level - 1, fine);
        })) {
      return;
    }
    LeafValues values;
    std::copy_n(stack.leaf(level, places[n])->buffer().data(), kLeafNodes, values.begin());
    stays[n] = coarser_misses(
        values, places[n], [&](const Coord& node) { return stack.sample(level + 1, node); }, rule);
  });
  for (std::size_t n = 0; n < places.size(); ++n) {
    if (stays[n] != 0) continue;
    const float value = stack.leaf(level, places[n])->buffer().data()[0];
    const float band = stack.band_mm(level);
    stack.erase_leaf(level, places[n], value < 0.0F ? -band : band);
  }
}

/// Fills the leaves at `places` with the exact distance; keeps those with a band.
void fill_exact(LevelStack& stack, int level, const std::set<Coord>& places,
                const std::function<double(const Vec3&)>& distance_mm) {
  const std::vector<Coord> list(places.begin(), places.end());
  std::vector<LeafValues> values(list.size());
  const double h = stack.voxel_mm(level);
  const auto band = static_cast<double>(stack.band_mm(level));
  tbb::parallel_for(std::size_t{0}, list.size(), [&](std::size_t n) {
    for (int i = 0; i < kLeafNodes; ++i) {
      const Coord node = list[n].offsetBy(i >> 6, (i >> 3) & 7, i & 7);
      const double d = distance_mm({h * node.x(), h * node.y(), h * node.z()});
      values[n][static_cast<std::size_t>(i)] = static_cast<float>(std::clamp(d, -band, band));
    }
  });
  for (std::size_t n = 0; n < list.size(); ++n) {
    if (has_band(values[n].data(), stack.band_mm(level))) {
      stack.set_leaf(level, list[n], values[n].data());
    }
  }
}

/// True when interpolating this level misses the exact distance at the finer nodes of a fine place.
bool octant_misses(const LevelStack& stack, int fine_level, const Coord& fine_place,
                   const std::function<double(const Vec3&)>& distance_mm, double tolerance_mm) {
  LeafValues interpolated;
  prolong_leaf(stack, fine_level, fine_place, interpolated);
  const double h = stack.voxel_mm(fine_level);
  for (int i = 0; i < kLeafNodes; ++i) {
    const double near = static_cast<double>(interpolated[static_cast<std::size_t>(i)]);
    if (std::abs(near) >= 3.0 * h) continue;
    const Coord node = fine_place.offsetBy(i >> 6, (i >> 3) & 7, i & 7);
    const double exact = distance_mm({h * node.x(), h * node.y(), h * node.z()});
    const double allowed = std::abs(exact) < 1.5 * h ? tolerance_mm : 0.5 * h;
    if (std::abs(exact - near) > allowed) return true;
  }
  return false;
}

/// The places of the finer level where this one is not exact enough.
std::set<Coord> places_below(const LevelStack& stack, int level,
                             const std::function<double(const Vec3&)>& distance_mm,
                             double tolerance_mm) {
  std::vector<Coord> candidates;
  for (const Coord& place : stack.sorted_places(level)) {
    for (int octant = 0; octant < 8; ++octant) {
      candidates.push_back(
          (place << 1).offsetBy(octant & 4 ? 8 : 0, octant & 2 ? 8 : 0, octant & 1 ? 8 : 0));
    }
  }
  std::vector<std::uint8_t> needed(candidates.size(), 0);
  tbb::parallel_for(std::size_t{0}, candidates.size(), [&](std::size_t n) {
    needed[n] = octant_misses(stack, level - 1, candidates[n], distance_mm, tolerance_mm);
  });
  std::set<Coord> places;
  for (std::size_t n = 0; n < candidates.size(); ++n) {
    if (needed[n] != 0) places.insert(candidates[n]);
  }
  return places;
}

/// Replaces the exact coarse values under finer leaves by the restriction, which forces and distant
/// views read: at sharp edges the two differ.
void restrict_all(LevelStack& stack) {
  for (int level = 1; level < stack.count(); ++level) {
    const std::vector<Coord> places = stack.sorted_places(level);
    const StackSource source(stack, level - 1);
    tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t n) {
      FineNeighbourhood around;
      gather_fine(source, places[n], around);
      if (!around.any_present) return;
      LeafValues values;
      std::copy_n(stack.leaf(level, places[n])->buffer().data(), kLeafNodes, values.begin());
      for (int i = 0; i < kLeafNodes; ++i) {
        restrict_node(around, stack.band_mm(level - 1), i >> 6, (i >> 3) & 7, i & 7,
                      values[static_cast<std::size_t>(i)]);
      }
      stack.set_leaf(level, places[n], values.data());
    });
  }
}

}  // namespace

int levels_for(double longest_side_mm, double finest_voxel_mm) {
  int levels = 1;
  for (double voxel = finest_voxel_mm; longest_side_mm > 32.0 * voxel; voxel *= 2.0) ++levels;
  return levels;
}

std::unique_ptr<LevelStack> stack_from_finest(VdbGrid::Ptr finest, const ClayOptions& options) {
  const Coord dim = finest->evalActiveVoxelBoundingBox().dim();
  const int longest = std::max({dim.x(), dim.y(), dim.z(), 1});
  auto stack = std::make_unique<LevelStack>(
      options.voxel_mm, levels_for(longest * options.voxel_mm, options.voxel_mm));
  stack->grid(0).setTree(finest->treePtr());
  for (int level = 0; level < stack->top(); ++level) build_above(*stack, level);
  const double tolerance = options.tolerance_voxels * options.voxel_mm;
  for (int level = 0; level < stack->top(); ++level) drop_level(*stack, level, tolerance);
  return stack;
}

std::unique_ptr<LevelStack> stack_from_distance(
    const std::function<double(const Vec3&)>& distance_mm, const Box3& bounds_mm,
    const ClayOptions& options) {
  const Vec3 size = bounds_mm.size();
  auto stack = std::make_unique<LevelStack>(
      options.voxel_mm, levels_for(std::max({size.x, size.y, size.z}), options.voxel_mm));
  const double tolerance = options.tolerance_voxels * options.voxel_mm;
  const int top = stack->top();
  std::set<Coord> places;
  const double h = stack->voxel_mm(top);
  const Vec3 lo = bounds_mm.min / h;
  const Vec3 hi = bounds_mm.max / h;
  openvdb::CoordBBox nodes(Coord::floor(openvdb::Vec3d(lo.x, lo.y, lo.z)),
                           Coord::ceil(openvdb::Vec3d(hi.x, hi.y, hi.z)));
  nodes.expand(kHalfWidthVoxels + 1);
  for_each_place(nodes, [&](const Coord& place) { places.insert(place); });
  fill_exact(*stack, top, places, distance_mm);
  openvdb::tools::signedFloodFill(stack->grid(top).tree());
  for (int level = top; level > 0; --level) {
    fill_exact(*stack, level - 1, places_below(*stack, level, distance_mm, tolerance), distance_mm);
  }
  for (int level = 0; level < top; ++level) {
    std::set<Coord> required;
    for (const Coord& place : stack->sorted_places(level)) {
      for_each_required_place(place, [&](const Coord& coarse) {
        if (!stack->has_leaf(level + 1, coarse)) required.insert(coarse);
      });
    }
    fill_exact(*stack, level + 1, required, distance_mm);
  }
  restrict_all(*stack);
  return stack;
}

}  // namespace argil
