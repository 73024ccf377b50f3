// SPDX-License-Identifier: GPL-3.0-or-later
#include "edit/short_nodes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "argil/engine/clay.h"

#include "clay/clay_access.h"
#include "field/prolongation.h"

namespace argil {
namespace {

/// A wedge of 20 degrees, its edge along y at x = 0, less 1 mm all around as an offset leaves it:
/// before the new edge, which is at x = 5.8, the values are those of the old faces.
Clay shrunk_wedge() {
  constexpr double kHalf = 10.0 * std::numbers::pi / 180.0;
  ClayOptions options;
  options.voxel_mm = 0.25;
  const auto distance = [](const Vec3& p) {
    const double face = std::abs(p.z) * std::cos(kHalf) - p.x * std::sin(kHalf);
    return std::max({face, std::abs(p.y) - 4.0, p.x - 20.0}) + 1.0;
  };
  Box3 bounds;
  bounds.include({-2.0, -4.0, -4.0});
  bounds.include({20.0, 4.0, 4.0});
  return Clay::from_distance(distance, bounds, options).value();
}

constexpr std::array<std::array<int, 3>, 6> kWays{
    {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};

/// Node by node, what the bits of many say at once.
class NodeByNode {
 public:
  NodeByNode(const LevelStack& stack, int level, bool is_outside)
      : stack_(stack), level_(level), side_(is_outside ? 1.0F : -1.0F) {}

  std::set<Coord> run() {
    std::vector<Coord> told;
    std::set<Coord> found;
    for (const Coord& origin : stack_.sorted_origins(level_)) {
      for (std::size_t n = 0; n < kLeafNodes; ++n) {
        const Coord node = node_of(origin, n);
        if (!is_told(node)) continue;
        told.push_back(node);
        if (slope(node) < 0.8F) found.insert(node);
      }
    }
    for (bool grows = true; grows;) {
      grows = false;
      for (const Coord& node : told) {
        if (found.count(node) > 0 || !is_told_by(node, found)) continue;
        found.insert(node);
        grows = true;
      }
    }
    return found;
  }

 private:
  /// What coarser levels say where the level has no leaf.
  float at(const Coord& node) const {
    if (stack_.has_leaf(level_, leaf_origin(node))) return side_ * stack_.sample(level_, node);
    LeafValues coarse;
    prolong_leaf(stack_, level_, leaf_origin(node), coarse);
    return side_ * coarse[static_cast<std::size_t>(leaf_offset(node))];
  }
  static Coord beside(const Coord& node, std::size_t way) {
    return node.offsetBy(kWays[way][0], kWays[way][1], kWays[way][2]);
  }
  bool is_told(const Coord& node) const {
    const float here = at(node);
    if (!(here > 0.0F && here < stack_.band_mm(level_))) return false;
    for (std::size_t way = 0; way < kWays.size(); ++way) {
      if (at(beside(node, way)) <= 0.0F) return false;
    }
    return true;
  }
  /// How far it rises from the nearer of two, in voxels, and which that is.
  std::pair<float, std::size_t> rise(const Coord& node, std::size_t axis) const {
    const float here = at(node);
    const float low = at(beside(node, 2 * axis));
    const float high = at(beside(node, 2 * axis + 1));
    const float nearest = std::min({here, low, high});
    return {(here - nearest) / static_cast<float>(stack_.voxel_mm(level_)),
            2 * axis + (high < std::min(low, here) ? 1 : 0)};
  }
  float slope(const Coord& node) const {
    float squares = 0.0F;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float up = rise(node, axis).first;
      squares += up * up;
    }
    return std::sqrt(squares);
  }
  bool is_told_by(const Coord& node, const std::set<Coord>& some) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto [up, way] = rise(node, axis);
      if (up >= 0.2F && some.count(beside(node, way)) > 0) return true;
    }
    return false;
  }

  const LevelStack& stack_;
  int level_;
  float side_;
};

std::set<Coord> nodes_of(const std::vector<ShortNodes>& leaves) {
  std::set<Coord> nodes;
  for (const ShortNodes& leaf : leaves) {
    for (std::size_t n = 0; n < kLeafNodes; ++n) {
      if ((leaf.rows[n / 8] >> n % 8 & 1) != 0) nodes.insert(node_of(leaf.origin, n));
    }
  }
  return nodes;
}

TEST(ShortNodes, AreThoseThatRiseTooSlowlyAndAllThatTheyTell) {
  const Clay clay = shrunk_wedge();
  const LevelStack& stack = levels_of(clay);
  for (int level = 0; level < stack.count(); ++level) {
    for (const bool is_outside : {true, false}) {
      const std::set<Coord> expected = NodeByNode(stack, level, is_outside).run();
      if (level == 0 && is_outside) {
        EXPECT_GT(expected.size(), 500U);
      }
      EXPECT_EQ(nodes_of(find_short_nodes(stack, level, is_outside)), expected)
          << level << ' ' << is_outside;
    }
  }
}

/// Before the edge of the wedge, and not beside its faces.
TEST(ShortNodes, LieBeyondTheEndOfWhatWasShrunk) {
  const Clay clay = shrunk_wedge();
  const LevelStack& stack = levels_of(clay);
  std::size_t before_edge = 0;
  for (const Coord& node : nodes_of(find_short_nodes(stack, 0, true))) {
    if (std::abs(node.y()) > 8 || node.x() > 40) continue;  // other ends have corners of their own
    EXPECT_LT(stack.voxel_mm(0) * node.x(), 7.0) << node;
    ++before_edge;
  }
  EXPECT_GT(before_edge, 30U);
}

TEST(ShortNodesGolden, AreTheSameForAnyThreads) {
  const Clay clay = shrunk_wedge();
  std::vector<std::set<Coord>> found;
  for (const std::size_t threads : {1, 2, 7}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    found.push_back(nodes_of(find_short_nodes(levels_of(clay), 0, true)));
  }
  EXPECT_EQ(found[1], found[0]);
  EXPECT_EQ(found[2], found[0]);
}

}  // namespace
}  // namespace argil
