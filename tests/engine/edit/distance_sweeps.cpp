// SPDX-License-Identifier: GPL-3.0-or-later
// Sweeps solve what marching solves.
#include "edit/distance_sweeps.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "clay/clay_access.h"
#include "field/fast_march.h"
#include "support/bumpy_clay.h"

namespace argil {
namespace {

NodeRows all_nodes() {
  NodeRows rows;
  rows.fill(0xff);
  return rows;
}

/// The finest level of a bumpy ball, every value off by up to a third, as an edit.
class BentLevel {
 public:
  BentLevel()
      : clay_(test::bumpy_ball(6.0, 0.25).value()),
        edit_(levels_of(clay_), memory_, 0, levels_of(clay_).sorted_origins(0)) {
    for (LeafEdit& leaf : edit_.leaves()) {
      float* values = leaf.write();
      for (std::size_t n = 0; n < kLeafNodes; ++n) {
        const Coord node = node_of(leaf.origin, n);
        const double bend =
            1.0 + std::sin(0.9 * node.x()) * std::cos(0.7 * node.y() + node.z()) / 3;
        values[n] =
            std::clamp(static_cast<float>(bend) * values[n], -edit_.band_mm(), edit_.band_mm());
      }
    }
    edit_.mark_changes();
  }

  LevelEdit& edit() { return edit_; }

  void sweep() {
    std::vector<SweptLeaf> swept;
    for (LeafEdit& leaf : edit_.leaves()) swept.push_back({&leaf, all_nodes(), {}});
    sweep_distances(edit_, swept);
  }

  /// Around all leaves.
  openvdb::CoordBBox box() const {
    openvdb::CoordBBox box;
    for (const LeafEdit& leaf : edit_.leaves()) {
      box.expand(leaf.origin);
      box.expand(leaf.origin.offsetBy(kLeafSide - 1));
    }
    box.expand(2);
    return box;
  }

 private:
  Clay clay_;
  EditMemory memory_;
  LevelEdit edit_;
};

bool is_next_to_the_surface(const std::vector<float>& value, std::size_t n, const Coord& dim) {
  const std::size_t strides[3] = {
      static_cast<std::size_t>(dim.y()) * static_cast<std::size_t>(dim.z()),
      static_cast<std::size_t>(dim.z()), 1};
  return std::any_of(std::begin(strides), std::end(strides), [&](std::size_t stride) {
    return (value[n] < 0.0F) != (value[n - stride] < 0.0F) ||
           (value[n] < 0.0F) != (value[n + stride] < 0.0F);
  });
}

/// Marches from the nodes next to the surface, as the sweeps left them, and from where there is no
/// leaf; returns how far each node of a leaf then is from the sweeps, in voxels.
std::vector<double> march_from_seeds(BentLevel& level) {
  const openvdb::CoordBBox box = level.box();
  const Coord dim = box.dim();
  MarchBlock block;
  block.n = {dim.x(), dim.y(), dim.z()};
  block.voxel = static_cast<float>(level.edit().voxel_mm());
  level.edit().gather_now(box, block.value);
  const std::vector<float> swept = block.value;
  block.state.assign(swept.size(), MarchBlock::kFixed);
  std::size_t n = 0;
  for (auto node = box.begin(); node; ++node, ++n) {
    if (level.edit().find(leaf_origin(*node)) == nullptr) continue;
    if (!is_next_to_the_surface(swept, n, dim)) block.state[n] = MarchBlock::kUnknown;
  }
  fast_march(block, level.edit().band_mm());
  std::vector<double> apart;
  for (std::size_t i = 0; i < swept.size(); ++i) {
    if (block.state[i] != MarchBlock::kUnknown) continue;
    apart.push_back(std::abs(static_cast<double>(swept[i] - block.value[i])) /
                    static_cast<double>(block.voxel));
  }
  std::sort(apart.begin(), apart.end());
  return apart;
}

TEST(DistanceSweeps, AgreeWithTheMarch) {
  BentLevel level;
  level.sweep();
  const std::vector<double> apart = march_from_seeds(level);
  ASSERT_GT(apart.size(), 50'000U);
  const double p99 = apart[apart.size() * 99 / 100];
  RecordProperty("p99_voxels", std::to_string(p99));
  RecordProperty("most_voxels", std::to_string(apart.back()));
  EXPECT_LE(p99, 0.001);
  EXPECT_LE(apart.back(), 0.01);
}

TEST(DistanceSweeps, KeepTheSideOfEveryNode) {
  BentLevel level;
  std::vector<float> before;
  std::vector<float> after;
  level.edit().gather_now(level.box(), before);
  level.sweep();
  level.edit().gather_now(level.box(), after);
  for (std::size_t n = 0; n < before.size(); ++n) {
    ASSERT_EQ(before[n] < 0.0F, after[n] < 0.0F) << n;
  }
}

TEST(DistanceSweeps, WriteDirtyNodesAndNoOthers) {
  BentLevel level;
  std::vector<LeafEdit>& leaves = level.edit().leaves();
  NodeRows dirty{};
  dirty[9] = 0x0c;
  dirty[30] = 0x81;
  std::vector<LeafValues> before(leaves.size());
  std::vector<SweptLeaf> swept;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    std::copy_n(leaves[i].now(), kLeafNodes, before[i].begin());
    if (i % 2 == 0) swept.push_back({&leaves[i], dirty, dirty});
  }
  sweep_distances(level.edit(), swept);
  int written = 0;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    for (std::size_t n = 0; n < kLeafNodes; ++n) {
      if (leaves[i].now()[n] == before[i][n]) continue;
      EXPECT_EQ(i % 2, 0U);
      EXPECT_NE(dirty[n / 8] >> n % 8 & 1, 0) << n;
      ++written;
    }
  }
  EXPECT_GT(written, 100);
}

}  // namespace
}  // namespace argil
