// SPDX-License-Identifier: GPL-3.0-or-later
// Two counting sorts: of triangles into bricks, then of a brick's triangles into its leaves. Where
// a leaf has many, they are smaller than its voxels, and most lie behind others for each cube of
// 2^3 nodes: there balls around them choose which are measured.
#include "import/scatter.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <span>
#include <utility>

#include <tbb/parallel_for.h>

#include "field/leaf_map.h"
#include "rows/rows.h"

namespace argil {
namespace {

constexpr int kBrickShift = 6;  // 8 leaves of 8 nodes
constexpr int kBrickNodes = 1 << kBrickShift;
constexpr int kBrickLeaves = kBrickNodes / kLeafSide;
constexpr std::size_t kScatteredPerTask = 4096;
/// A leaf with more triangles chooses among them.
constexpr std::size_t kFewTriangles = 96;
constexpr auto kBand = static_cast<double>(kHalfWidthVoxels);
constexpr auto kFar = static_cast<float>(kBand * kBand);
constexpr double kHalfLeaf = 0.5 * (kLeafSide - 1);

/// Indices of cells, along each axis, that a triangle's bounds can reach.
struct CellBox {
  Coord low;
  Coord high;
};

CellBox cells_near(const Box3& bounds_mm, const ImportInput& input, int cell_nodes) {
  constexpr double kReach = kBand + 1e-4;
  CellBox box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto cell = [&](double at_mm, double reach) {
      const double node = (at_mm + input.center[axis]) / input.voxel_mm + reach;
      return static_cast<int>(std::floor(node / cell_nodes));
    };
    box.low[static_cast<int>(axis)] = cell(bounds_mm.min[axis], -kReach);
    box.high[static_cast<int>(axis)] = cell(bounds_mm.max[axis], kReach);
  }
  return box;
}

template <class Visit>
void for_each_cell(const CellBox& box, const Visit& visit) {
  for (int x = box.low.x(); x <= box.high.x(); ++x) {
    for (int y = box.low.y(); y <= box.high.y(); ++y) {
      for (int z = box.low.z(); z <= box.high.z(); ++z) visit(Coord(x, y, z));
    }
  }
}

FlatTriangle flat_triangle(const ImportInput& input, std::uint32_t number) {
  const Triangle& t = input.triangles[number];
  return {input.positions[t[0]], input.positions[t[1]], input.positions[t[2]], input.voxel_mm};
}

/// A node relative to the input's centre. Rounds as the positions of the input did.
Vec3 place_mm(const ImportInput& input, const Coord& node) noexcept {
  return node_mm(node, input.voxel_mm) - input.center;
}

/// The middle of the nodes of a cell.
Vec3 middle_of(const ImportInput& input, const Coord& cell, int nodes) noexcept {
  const double half_mm = 0.5 * (nodes - 1) * input.voxel_mm;
  const Coord first(cell.x() * nodes, cell.y() * nodes, cell.z() * nodes);
  return place_mm(input, first) + Vec3{half_mm, half_mm, half_mm};
}

struct BrickTriangle {
  Coord brick;
  std::uint32_t triangle;
};

/// The bricks that some triangles may reach.
std::vector<BrickTriangle> bricks_near(const ImportInput& input, std::size_t begin,
                                       std::size_t end) {
  std::vector<BrickTriangle> found;
  for (std::size_t n = begin; n < end; ++n) {
    const auto number = static_cast<std::uint32_t>(n);
    Box3 bounds;
    for (const std::uint32_t v : input.triangles[n]) bounds.include(input.positions[v]);
    const CellBox box = cells_near(bounds, input, kBrickNodes);
    const Coord size = box.high - box.low;
    if (size.x() <= 1 && size.y() <= 1 && size.z() <= 1) {
      for_each_cell(box, [&](const Coord& brick) { found.push_back({brick, number}); });
      continue;
    }
    const FlatTriangle flat = flat_triangle(input, number);
    for_each_cell(box, [&](const Coord& brick) {
      const Vec3 middle = middle_of(input, brick, kBrickNodes);
      if (flat.may_reach(middle, 0.5 * (kBrickNodes - 1), kBand)) found.push_back({brick, number});
    });
  }
  return found;
}

/// Balls around a leaf's triangles, seen from its first node, in voxels.
class TriangleBalls {
 public:
  void clear(std::size_t room) {
    const std::size_t padded = (room + kRowNodes - 1) / kRowNodes * kRowNodes;
    for (auto& each : at_) each.assign(padded, 1e6F);
    radius_.assign(padded, 0.0F);
    index_.resize(padded);
    count_ = 0;
  }
  void add(const std::array<float, 3>& at, float radius, int index) {
    for (std::size_t axis = 0; axis < 3; ++axis) at_[axis][count_] = at[axis];
    radius_[count_] = radius;
    index_[count_++] = index;
  }
  /// Those of which a point may be nearest to a node of a cube.
  void choose(const std::array<float, 3>& middle, float half, std::vector<int>& chosen,
              TriangleBalls& out) const {
    BallsJob job{{at_[0].data(), at_[1].data(), at_[2].data()},
                 radius_.data(),
                 static_cast<int>(radius_.size()),
                 {middle[0], middle[1], middle[2]},
                 half,
                 static_cast<float>(kBand)};
    chosen.resize(radius_.size());
    const int count = row_loops().choose_balls(job, chosen.data());
    out.clear(static_cast<std::size_t>(count));
    for (int n = 0; n < count; ++n) {
      const auto i = static_cast<std::size_t>(chosen[static_cast<std::size_t>(n)]);
      if (i >= count_) continue;  // what fills the last vector
      out.add({at_[0][i], at_[1][i], at_[2][i]}, radius_[i], index_[i]);
    }
  }
  std::span<const int> indices() const noexcept { return {index_.data(), count_}; }
  int count() const noexcept { return static_cast<int>(count_); }

 private:
  std::array<std::vector<float>, 3> at_;
  std::vector<float> radius_;
  std::vector<int> index_;
  std::size_t count_ = 0;
};

/// What measuring a leaf needs, kept from one to the next.
struct LeafMemory {
  std::vector<LeafTriangle> triangles;
  std::vector<int> chosen;
  std::vector<int> made;  ///< where `triangles` has each of the leaf's, or -1
  TriangleBalls leaf;
  TriangleBalls block;
  TriangleBalls cube;
  alignas(64) std::array<float, kLeafNodes> squares;
};

/// Calls lower(cube's lowest node, its balls) for the cubes of 2^3 nodes of a leaf, chosen from
/// those of cubes of 4^3.
template <class Lower>
void for_each_cube(LeafMemory& memory, const Lower& lower) {
  const auto middle_of_cube = [](const std::array<int, 3>& low, int side) {
    const float to_middle = 0.5F * static_cast<float>(side - 1);
    return std::array<float, 3>{static_cast<float>(low[0]) + to_middle,
                                static_cast<float>(low[1]) + to_middle,
                                static_cast<float>(low[2]) + to_middle};
  };
  for (int block = 0; block < 8; ++block) {
    const std::array<int, 3> first = {4 * (block >> 2), 4 * (block >> 1 & 1), 4 * (block & 1)};
    memory.leaf.choose(middle_of_cube(first, 4), 1.5F, memory.chosen, memory.block);
    if (memory.block.count() == 0) continue;
    for (int cube = 0; cube < 8; ++cube) {
      const std::array<int, 3> low = {first[0] + 2 * (cube >> 2), first[1] + 2 * (cube >> 1 & 1),
                                      first[2] + 2 * (cube & 1)};
      memory.block.choose(middle_of_cube(low, 2), 0.5F, memory.chosen, memory.cube);
      lower(low, memory.cube.indices());
    }
  }
}

/// A brick's triangles, and which of them may reach each of its leaves.
class BrickLists {
 public:
  BrickLists(const ImportInput& input, const Coord& origin,
             std::span<const std::uint32_t> triangles) {
    struct Pair {
      std::uint32_t leaf;
      std::uint32_t triangle;
    };
    std::vector<Pair> pairs;
    flat_.reserve(triangles.size());
    const Coord low = origin >> 3;
    for (std::uint32_t n = 0; n < triangles.size(); ++n) {
      flat_.push_back(flat_triangle(input, triangles[n]));
      CellBox box = cells_near(flat_[n].bounds_mm(), input, kLeafSide);
      box.low.maxComponent(low);
      box.high.minComponent(low.offsetBy(kBrickLeaves - 1));
      for_each_cell(box, [&](const Coord& cell) {
        if (!flat_[n].may_reach(middle_of(input, cell, kLeafSide), kHalfLeaf, kBand)) return;
        const auto leaf = static_cast<std::uint32_t>(leaf_offset(cell));
        ++first_[leaf + 1];
        pairs.push_back({leaf, n});
      });
    }
    for (std::size_t leaf = 0; leaf < kLeafNodes; ++leaf) first_[leaf + 1] += first_[leaf];
    triangles_.resize(pairs.size());
    auto next = first_;
    for (const Pair& pair : pairs) triangles_[next[pair.leaf]++] = pair.triangle;
  }

  std::span<const std::uint32_t> of_leaf(std::size_t leaf) const noexcept {
    return {triangles_.data() + first_[leaf], first_[leaf + 1] - first_[leaf]};
  }

  /// The squares of a leaf's nodes.
  void lower_leaf(std::span<const std::uint32_t> near, const Vec3& origin_mm,
                  LeafMemory& memory) const {
    memory.squares.fill(kFar);
    memory.triangles.clear();
    if (near.size() <= kFewTriangles) {
      for (const std::uint32_t n : near) {
        memory.triangles.push_back(flat_[n].seen_from(origin_mm, kBand));
      }
      row_loops().lower_to_triangles(memory.triangles.data(), static_cast<int>(near.size()),
                                     memory.squares.data());
      return;
    }
    memory.leaf.clear(near.size());
    for (std::size_t n = 0; n < near.size(); ++n) {
      const auto [at, radius] = flat_[near[n]].ball_from(origin_mm);
      memory.leaf.add(at, radius, static_cast<int>(n));
    }
    // Only what some cube chose is looked at closely.
    constexpr int kNotMade = -1;
    memory.made.assign(near.size(), kNotMade);
    for_each_cube(memory, [&](const std::array<int, 3>& low, std::span<const int> balls) {
      memory.chosen.clear();
      for (const int ball : balls) {
        int& made = memory.made[static_cast<std::size_t>(ball)];
        if (made == kNotMade) {
          made = static_cast<int>(memory.triangles.size());
          const FlatTriangle& flat = flat_[near[static_cast<std::size_t>(ball)]];
          memory.triangles.push_back(flat.seen_from(origin_mm, kBand));
        }
        memory.chosen.push_back(made);
      }
      row_loops().lower_cube(memory.triangles.data(), memory.chosen.data(),
                             static_cast<int>(memory.chosen.size()), low.data(),
                             memory.squares.data());
    });
  }

 private:
  std::vector<FlatTriangle> flat_;
  std::array<std::uint32_t, kLeafNodes + 1> first_{};
  std::vector<std::uint32_t> triangles_;
};

}  // namespace

Scatter::Scatter(const ImportInput& input) : input_(input) {
  const std::size_t count = input.triangles.size();
  const std::size_t tasks = (count + kScatteredPerTask - 1) / kScatteredPerTask;
  std::vector<std::vector<BrickTriangle>> lists(tasks);
  tbb::parallel_for(std::size_t{0}, tasks, [&](std::size_t task) {
    const std::size_t begin = task * kScatteredPerTask;
    lists[task] = bricks_near(input, begin, std::min(count, begin + kScatteredPerTask));
  });
  LeafMap<std::uint32_t> numbers;  // one more than that of each brick
  for (auto& list : lists) {
    for (BrickTriangle& each : list) {
      std::uint32_t& number = numbers.at(each.brick << 3);  // a brick stands for a leaf of them
      if (number == 0) {
        bricks_.push_back({each.brick << kBrickShift});
        number = static_cast<std::uint32_t>(bricks_.size());
      }
      ++bricks_[number - 1].count;
    }
  }
  std::sort(bricks_.begin(), bricks_.end(),
            [](const Brick& a, const Brick& b) { return a.origin < b.origin; });
  std::uint64_t first = 0;
  for (std::size_t n = 0; n < bricks_.size(); ++n) {
    numbers.at(bricks_[n].origin >> (kBrickShift - 3)) = static_cast<std::uint32_t>(n + 1);
    bricks_[n].first = first;
    first += std::exchange(bricks_[n].count, 0);
  }
  triangles_.resize(first);
  for (auto& list : lists) {
    for (const BrickTriangle& each : list) {
      Brick& brick = bricks_[numbers.at(each.brick << 3) - 1];
      triangles_[brick.first + brick.count++] = each.triangle;
    }
    std::vector<BrickTriangle>().swap(list);
  }
}

double Scatter::work(std::size_t brick) const noexcept {
  return 1000.0 + static_cast<double>(bricks_[brick].count);
}

void Scatter::measure(std::size_t number, const Take& take) const {
  assert(number < bricks_.size());
  const Brick& brick = bricks_[number];
  const BrickLists lists(input_, brick.origin,
                         {triangles_.data() + brick.first, static_cast<std::size_t>(brick.count)});
  LeafMemory memory;
  for (std::size_t leaf = 0; leaf < kLeafNodes; ++leaf) {
    const std::span<const std::uint32_t> near = lists.of_leaf(leaf);
    if (near.empty()) continue;
    const Coord origin = brick.origin + (node_of({0, 0, 0}, leaf) << 3);
    lists.lower_leaf(near, place_mm(input_, origin), memory);
    const auto nearest = std::min_element(memory.squares.begin(), memory.squares.end());
    if (*nearest < kFar) take(origin, memory.squares.data());
  }
}

}  // namespace argil
