// SPDX-License-Identifier: GPL-3.0-or-later
// As far as this from the surface all values around a node have one sign, so that sizes are solved
// and signs put back at the end.
#include "edit/deepened_part.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <limits>

#include "edit/rows_reading.h"
#include "field/leaf_finder.h"
#include "field/parallel.h"

namespace argil {
namespace {

constexpr int kMostTurns = 24;         // of all leaves
constexpr int kMostPasses = 12;        // over the rows of one
constexpr float kStillVoxels = 3e-3F;  ///< what moves less has settled

}  // namespace

DeepenedPart::DeepenedPart(const LevelStack& stack, int level, const Coord& first,
                           const Coord& last)
    : voxel_(static_cast<float>(stack.voxel_mm(level))), depth_(kDepthVoxels * voxel_) {
  assert(is_leaf_origin(first) && is_leaf_origin(last));
  find_leaves(stack, level, first, last);
  const float band = stack.band_mm(level);
  for_each_leaf(leaves_.size(), [&](std::size_t n) { open(leaves_[n], band); });
  solve();
  sign(stack, level);
}

/// Those of the band in this part, then those beside them.
void DeepenedPart::find_leaves(const LevelStack& stack, int level, const Coord& first,
                               const Coord& last) {
  LeafFinder stored(stack, level);
  std::vector<Coord> origins;
  for_each_leaf_origin({first, last}, [&](const Coord& origin) {
    if (stored.has_leaf(origin)) origins.push_back(origin);
  });
  const openvdb::CoordBBox part(first, last);
  std::vector<Coord> all;
  const auto add = [&](const Coord& origin) {
    std::uint32_t& index = index_.at(origin);
    if (index != 0) return;
    all.push_back(origin);
    index = static_cast<std::uint32_t>(all.size());
  };
  for (const Coord& origin : origins) add(origin);
  for (const Coord& origin : origins) {
    for_each_leaf_origin({origin.offsetBy(-kLeafSide), origin.offsetBy(kLeafSide)},
                         [&](const Coord& at) {
                           if (part.isInside(at)) add(at);
                         });
  }
  leaves_.resize(all.size());
  for (std::size_t n = 0; n < all.size(); ++n) {
    leaves_[n].origin = all[n];
    if (n < origins.size()) leaves_[n].stored = stored.values(all[n]);
  }
}

void DeepenedPart::open(Leaf& leaf, float band) const {
  for_each_halo_leaf(leaf.origin, [&](std::size_t n, const Coord& origin) {
    if (n == 0) return;
    const std::uint32_t found = index_.get(origin);
    leaf.beside[n - 1] = found != 0 ? found - 1 : kNone;
  });
  if (leaf.stored == nullptr) {
    leaf.values.fill(depth_);
    leaf.kept.fill(0);
    return;
  }
  for (std::size_t row = 0; row < leaf.kept.size(); ++row) {
    unsigned kept = 0;
    for (std::size_t n = kLeafSide * row; n < kLeafSide * (row + 1); ++n) {
      const float size = std::abs(leaf.stored[n]);
      kept |= (size < band ? 1U : 0U) << n % kLeafSide;
      leaf.values[n] = size < band ? size : depth_;
    }
    leaf.kept[row] = static_cast<std::uint8_t>(kept);
  }
}

void DeepenedPart::solve() {
  std::array<std::vector<std::uint32_t>, 2> turns;
  for (std::uint32_t n = 0; n < leaves_.size(); ++n) {
    const Coord at = leaves_[n].origin >> 3;
    turns[static_cast<std::size_t>((at.x() + at.y() + at.z()) & 1)].push_back(n);
  }
  for (int turn = 0; turn < kMostTurns; ++turn) {
    std::atomic<bool> any = false;
    for (const auto& leaves : turns) {
      for_each_leaf(leaves.size(), [&](std::size_t n) {
        if (solve_leaf(leaves_[leaves[n]])) any.store(true, std::memory_order_relaxed);
      });
    }
    if (!any) return;
  }
}

std::uint64_t DeepenedPart::rows_to_solve(const Leaf& leaf) const noexcept {
  const auto moved = [&](std::size_t n) -> std::uint64_t {
    return leaf.beside[n] != kNone ? leaves_[leaf.beside[n]].moved : 0;
  };
  return leaf.asked | rows_reading(0, moved(0), moved(1), moved(2), moved(3)) | moved(4) | moved(5);
}

bool DeepenedPart::solve_leaf(Leaf& leaf) const {
  std::uint64_t rows = rows_to_solve(leaf);
  leaf.moved = 0;
  leaf.asked = 0;
  if (rows == 0) return false;
  static const LeafValues none = [] {
    LeafValues values;
    values.fill(std::numeric_limits<float>::max());
    return values;
  }();
  std::array<const float*, kHaloLeaves> around{leaf.values.data()};
  for (std::size_t n = 0; n < leaf.beside.size(); ++n) {
    around[n + 1] = leaf.beside[n] != kNone ? leaves_[leaf.beside[n]].values.data() : none.data();
  }
  HaloBlock block;
  gather_halo(around, block);
  for (int pass = 0; pass < kMostPasses && rows != 0; ++pass) {
    const std::uint64_t moved = row_loops().deepen(block, leaf.kept.data(), voxel_, depth_,
                                                   kStillVoxels * voxel_, rows, pass);
    leaf.moved |= moved;
    rows = rows_reading(moved, 0, 0, 0, 0);
  }
  leaf.asked = rows;
  for (std::size_t row = 0; row < kLeafRows; ++row) {
    const auto i = static_cast<int>(row / kLeafSide);
    const auto j = static_cast<int>(row % kLeafSide);
    std::copy_n(block.value + HaloBlock::index(i, j, 0), kLeafSide,
                leaf.values.begin() + static_cast<std::ptrdiff_t>(kLeafSide * row));
  }
  return (leaf.moved | leaf.asked) != 0;
}

void DeepenedPart::sign(const LevelStack& stack, int level) {
  for_each_leaf(leaves_.size(), [&](std::size_t n) {
    Leaf& leaf = leaves_[n];
    if (leaf.stored != nullptr) {
      for (std::size_t i = 0; i < kLeafNodes; ++i) {
        if (leaf.stored[i] < 0.0F) leaf.values[i] = -leaf.values[i];
      }
    } else if (stack.grid(level).tree().getValue(leaf.origin) < 0.0F) {
      for (float& value : leaf.values) value = -value;
    }
  });
}

}  // namespace argil
