// SPDX-License-Identifier: GPL-3.0-or-later
// Two ways to a stack of levels. From a complete finest level: each coarser one is the full
// weighting of the next finer, in chunks that are deepened beyond their band first, so that the
// whole coarser band is an average. From a formula: the coarsest level first, finer leaves where
// interpolating it misses the formula, then the leaves that balance requires.
#include "edit/build_levels.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include <openvdb/tools/SignedFloodFill.h>
#include <tbb/parallel_for.h>

#include "edit/deepened_part.h"
#include "edit/prune.h"
#include "edit/restriction.h"
#include "field/nesting.h"
#include "field/parallel.h"
#include "field/prolongation.h"
#include "rows/rows.h"

namespace argil {
namespace {

/// The coarse leaves that the band of a complete finer level can reach.
std::vector<Coord> origins_above(const LevelStack& stack, int level) {
  std::vector<Coord> origins;
  for (auto leaf = stack.grid(level).tree().cbeginLeaf(); leaf; ++leaf) {
    for_each_required_parent(leaf->origin(),
                             [&](const Coord& origin) { origins.push_back(origin); });
  }
  std::sort(origins.begin(), origins.end());
  origins.erase(std::unique(origins.begin(), origins.end()), origins.end());
  return origins;
}

/// Coarse leaves along a side of a chunk, 16: what is deepened at once is short-lived.
constexpr int kChunkShift = 7;

/// Some leaves of the next coarser level, and their values.
struct CoarseChunk {
  std::vector<Coord> origins;
  std::vector<LeafValues> values;
};

/// The values of a coarse leaf: full weighting of the finer level where that is known around a
/// node, else the side.
void average_leaf(const LevelStack& stack, int level, const DeepenedPart& fine, const Coord& origin,
                  LeafValues& values) {
  static const LeafValues unknown = [] {
    LeafValues none;
    none.fill(std::numeric_limits<float>::max());
    return none;
  }();
  const Coord first = (origin << 1).offsetBy(-kLeafSide);
  RestrictJob job{{}, fine.depth_mm(), static_cast<float>(stack.voxel_mm(level))};
  for (int n = 0; n < 27; ++n) {
    const float* found = fine.values(first + (Coord(n / 9, n / 3 % 3, n % 3) << 3));
    job.leaves[n] = found != nullptr ? found : unknown.data();
  }
  NodeRows decided;
  NodeRows averaged;
  row_loops().restrict_leaf(job, values.data(), decided.data(), averaged.data());
  const float band = stack.band_mm(level + 1);
  const auto tiles = stack.grid(level).getConstUnsafeAccessor();
  for (std::size_t i = 0; i < kLeafNodes; ++i) {
    if ((decided[i / kLeafSide] >> i % kLeafSide & 1) != 0) {
      values[i] = std::clamp(values[i], -band, band);
      continue;
    }
    const Coord node = node_of(origin, i) << 1;
    const float* found = fine.values(node);
    const float side = found != nullptr ? found[static_cast<std::size_t>(leaf_offset(node))]
                                        : tiles.getValue(node);
    values[i] = side < 0.0F ? -band : band;
  }
}

/// Averages the distance of the finer level, deepened so that the whole coarser band is an average
/// of it: a coarser band that is solved from averages loses the envelope of what they averaged.
void fill_from_finer(const LevelStack& stack, int level, CoarseChunk& chunk) {
  openvdb::CoordBBox coarse;
  for (const Coord& origin : chunk.origins) coarse.expand(origin);
  // One leaf below those that are covered is averaged too, and one more around tells them.
  const DeepenedPart fine(stack, level, (coarse.min() << 1).offsetBy(-2 * kLeafSide),
                          (coarse.max() << 1).offsetBy(2 * kLeafSide));
  chunk.values.resize(chunk.origins.size());
  for_each_leaf(chunk.origins.size(), [&](std::size_t n) {
    average_leaf(stack, level, fine, chunk.origins[n], chunk.values[n]);
  });
}

/// Leaves that lie together are made together, so that what is around them is deepened once.
std::vector<CoarseChunk> chunks_above(const LevelStack& stack, int level) {
  std::map<Coord, CoarseChunk> chunks;
  for (const Coord& origin : origins_above(stack, level)) {
    chunks[origin >> kChunkShift].origins.push_back(origin);
  }
  std::vector<CoarseChunk> list;
  list.reserve(chunks.size());
  for (auto& [index, chunk] : chunks) list.push_back(std::move(chunk));
  return list;
}

/// Fills the leaves at `origins` with the exact distance; keeps those with a band.
void fill_exact(LevelStack& stack, int level, const std::set<Coord>& origins,
                const std::function<double(const Vec3&)>& distance_mm) {
  const std::vector<Coord> list(origins.begin(), origins.end());
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

/// True when interpolating this level misses the exact distance at some node of a finer leaf.
bool octant_misses(const LevelStack& stack, int fine_level, const Coord& fine_origin,
                   const std::function<double(const Vec3&)>& distance_mm, double tolerance_mm) {
  LeafValues interpolated;
  prolong_leaf(stack, fine_level, fine_origin, interpolated);
  const double h = stack.voxel_mm(fine_level);
  for (int i = 0; i < kLeafNodes; ++i) {
    const double near = static_cast<double>(interpolated[static_cast<std::size_t>(i)]);
    if (std::abs(near) >= 3.0 * h) continue;
    const Coord node = fine_origin.offsetBy(i >> 6, (i >> 3) & 7, i & 7);
    const double exact = distance_mm({h * node.x(), h * node.y(), h * node.z()});
    const double allowed = std::abs(exact) < 1.5 * h ? tolerance_mm : 0.5 * h;
    if (std::abs(exact - near) > allowed) return true;
  }
  return false;
}

/// The leaves of the finer level where this one is not exact enough.
std::set<Coord> origins_below(const LevelStack& stack, int level,
                              const std::function<double(const Vec3&)>& distance_mm,
                              double tolerance_mm) {
  std::vector<Coord> candidates;
  for (const Coord& origin : stack.sorted_origins(level)) {
    for (int octant = 0; octant < 8; ++octant) {
      candidates.push_back(
          (origin << 1).offsetBy(octant & 4 ? 8 : 0, octant & 2 ? 8 : 0, octant & 1 ? 8 : 0));
    }
  }
  std::vector<std::uint8_t> needed(candidates.size(), 0);
  tbb::parallel_for(std::size_t{0}, candidates.size(), [&](std::size_t n) {
    needed[n] = octant_misses(stack, level - 1, candidates[n], distance_mm, tolerance_mm);
  });
  std::set<Coord> origins;
  for (std::size_t n = 0; n < candidates.size(); ++n) {
    if (needed[n] != 0) origins.insert(candidates[n]);
  }
  return origins;
}

}  // namespace

bool build_above(LevelStack& stack, int level, const std::function<bool(double)>& told) {
  assert(level >= 0 && level < stack.top());
  std::vector<CoarseChunk> chunks = chunks_above(stack, level);
  const float band = stack.band_mm(level + 1);
  for (std::size_t n = 0; n < chunks.size(); ++n) {
    if (told && !told(static_cast<double>(n) / static_cast<double>(chunks.size()))) return false;
    CoarseChunk& chunk = chunks[n];
    fill_from_finer(stack, level, chunk);
    for (std::size_t i = 0; i < chunk.origins.size(); ++i) {
      const float* values = chunk.values[i].data();
      if (has_band(values, band)) stack.set_leaf(level + 1, chunk.origins[i], values);
    }
    chunk = {};
  }
  openvdb::tools::signedFloodFill(stack.grid(level + 1).tree());
  return true;
}

/// Level after level from the finest, each leaf from the one below that is final.
void restrict_all(LevelStack& stack) {
  for (int level = 1; level < stack.count(); ++level) {
    const std::vector<Coord> origins = stack.sorted_origins(level);
    tbb::parallel_for(std::size_t{0}, origins.size(), [&](std::size_t n) {
      StackSource source(stack, level - 1);
      const FineLeaves around = fine_leaves(source, origins[n]);
      if (!around.any_present) return;
      Restricted restricted;
      restrict_leaf(around, stack.band_mm(level - 1), restricted);
      LeafValues values;
      std::copy_n(stack.leaf(level, origins[n])->buffer().data(), kLeafNodes, values.begin());
      for (std::size_t i = 0; i < kLeafNodes; ++i) {
        if ((restricted.decided[i / 8] >> i % 8 & 1) != 0) values[i] = restricted.value[i];
      }
      stack.set_leaf(level, origins[n], values.data());
    });
  }
}

int levels_for(double longest_side_mm, double finest_voxel_mm) {
  assert(longest_side_mm < std::numeric_limits<double>::infinity() && finest_voxel_mm > 0.0);
  int levels = 1;
  for (double voxel = finest_voxel_mm; longest_side_mm > 32.0 * voxel; voxel *= 2.0) ++levels;
  return levels;
}

std::unique_ptr<LevelStack> stack_from_finest(VdbGrid::Ptr finest, const ClayOptions& options,
                                              int least_levels,
                                              const std::function<bool(double)>& told) {
  assert(finest && finest->background() == static_cast<float>(kHalfWidthVoxels * options.voxel_mm));
  const Coord dim = finest->evalActiveVoxelBoundingBox().dim();
  const int longest = std::max({dim.x(), dim.y(), dim.z(), 1});
  const int levels =
      std::max(least_levels, levels_for(longest * options.voxel_mm, options.voxel_mm));
  auto stack = std::make_unique<LevelStack>(options.voxel_mm, levels);
  stack->grid(0).setTree(finest->treePtr());
  // Each level has about a fourth of the leaves of the one below.
  double done = 0.0;
  double part = 0.75;
  for (int level = 0; level < stack->top(); ++level, done += part, part *= 0.25) {
    const auto told_here = [&](double fraction) { return !told || told(done + part * fraction); };
    if (!build_above(*stack, level, told_here)) return nullptr;
  }
  const double tolerance = options.tolerance_voxels * options.voxel_mm;
  for (int level = 0; level < stack->top(); ++level) prune_level(*stack, level, tolerance);
  return stack;
}

std::unique_ptr<LevelStack> stack_from_distance(
    const std::function<double(const Vec3&)>& distance_mm, const Box3& bounds_mm,
    const ClayOptions& options) {
  assert(is_finite(bounds_mm.min) && is_finite(bounds_mm.max));
  const Vec3 size = bounds_mm.size();
  auto stack = std::make_unique<LevelStack>(
      options.voxel_mm, levels_for(std::max({size.x, size.y, size.z}), options.voxel_mm));
  const double tolerance = options.tolerance_voxels * options.voxel_mm;
  const int top = stack->top();
  // The coarsest level covers the bounds with its band.
  std::set<Coord> origins;
  const double h = stack->voxel_mm(top);
  const Vec3 lo = bounds_mm.min / h;
  const Vec3 hi = bounds_mm.max / h;
  openvdb::CoordBBox nodes(Coord::floor(openvdb::Vec3d(lo.x, lo.y, lo.z)),
                           Coord::ceil(openvdb::Vec3d(hi.x, hi.y, hi.z)));
  nodes.expand(kHalfWidthVoxels + 1);
  for_each_leaf_origin(nodes, [&](const Coord& origin) { origins.insert(origin); });
  fill_exact(*stack, top, origins, distance_mm);
  openvdb::tools::signedFloodFill(stack->grid(top).tree());
  for (int level = top; level > 0; --level) {
    fill_exact(*stack, level - 1, origins_below(*stack, level, distance_mm, tolerance),
               distance_mm);
  }
  // Refinement asked for leaves where they are needed; balance asks for those around them.
  for (int level = 0; level < top; ++level) {
    std::set<Coord> required;
    for (const Coord& origin : stack->sorted_origins(level)) {
      for_each_required_parent(origin, [&](const Coord& coarse) {
        if (!stack->has_leaf(level + 1, coarse)) required.insert(coarse);
      });
    }
    fill_exact(*stack, level + 1, required, distance_mm);
  }
  restrict_all(*stack);
  return stack;
}

}  // namespace argil
