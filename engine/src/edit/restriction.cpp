// SPDX-License-Identifier: GPL-3.0-or-later
// Full weighting of 17^3 fine nodes to 8^3 coarse ones, along x and y by rows of floats, which the
// compiler turns into vector instructions, then along z. Nodes without a value are NaN, so that an
// average with one of them is NaN too and needs no test: the node's own value stands instead.
#include "edit/restriction.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

#include "field/parallel.h"

namespace argil {
namespace {

constexpr std::size_t kSide = FineNeighbourhood::kSide;
constexpr std::size_t kRow = FineNeighbourhood::kRow;
constexpr std::size_t kCoarse = kLeafSide;
constexpr float kAbsent = std::numeric_limits<float>::quiet_NaN();

using Row = FineNeighbourhood::Row;

constexpr std::size_t row_of(std::size_t i, std::size_t j) { return i * kSide + j; }

class EditSource final : public FineSource {
 public:
  explicit EditSource(const LevelEdit& edit) : leaves_(edit) {}
  const float* now(const Coord& origin) override { return leaves_.values_now(origin); }
  const NodeRows* changed(const Coord& origin) override {
    const LeafEdit* leaf = leaves_.find(origin);
    return leaf != nullptr && leaf->changed ? &leaf->changed_nodes : nullptr;
  }

 private:
  LevelEdit::Reader leaves_;
};

/// Whether the edit changed one of the finer leaves that decide nodes of the leaf.
bool finer_changed(const LevelEdit& fine, const Coord& origin) {
  const Coord low = (origin << 1).offsetBy(-1);
  bool changed = false;
  LevelEdit::Reader leaves(fine);
  for_each_leaf_origin({low, low.offsetBy(kSide - 1)}, [&](const Coord& at) {
    if (changed) return;
    const LeafEdit* leaf = leaves.find(at);
    changed = leaf != nullptr && leaf->changed;
  });
  return changed;
}

/// The leaves that meet a block, by bits of their place along each axis: the one below the coarse
/// leaf's first, and the two that it covers.
struct FineLeaves {
  std::array<const float*, 27> now{};
  std::array<const NodeRows*, 27> changed{};
};

FineLeaves leaves_of_block(FineSource& fine, const Coord& coarse_origin, FineNeighbourhood& out) {
  FineLeaves leaves;
  const Coord first = (coarse_origin << 1).offsetBy(-kLeafSide);
  std::size_t n = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 3; ++k, ++n) {
        const Coord origin = first.offsetBy(kLeafSide * i, kLeafSide * j, kLeafSide * k);
        leaves.now[n] = fine.now(origin);
        if (leaves.now[n] == nullptr) continue;
        out.any_present = true;
        leaves.changed[n] = fine.changed(origin);
        out.any_changed |= leaves.changed[n] != nullptr;
      }
    }
  }
  return leaves;
}

/// Which of three leaves, and which of its nodes along an axis, node i of the block is.
constexpr std::size_t leaf_at(std::size_t i) { return (i + kLeafSide - 1) / kLeafSide; }
constexpr std::size_t node_at(std::size_t i) { return (i + kLeafSide - 1) % kLeafSide; }

/// A node as restriction takes it: nothing of what lies outside the band.
float in_band(float value, float band) { return std::abs(value) < band ? value : kAbsent; }

/// A row of the block out of the three leaves along it, each `offset` nodes from its first.
void gather_row(const std::array<const float*, 3>& leaves, std::size_t offset, float band,
                Row& row) {
  row[0] = leaves[0] != nullptr ? in_band(leaves[0][offset + kLeafSide - 1], band) : kAbsent;
  for (std::size_t k = 1; k < 3; ++k) {
    float* to = row.data() + 1 + (k - 1) * kLeafSide;
    if (leaves[k] == nullptr) {
      std::fill_n(to, kLeafSide, kAbsent);
    } else {
      for (std::size_t z = 0; z < kLeafSide; ++z) to[z] = in_band(leaves[k][offset + z], band);
    }
  }
  std::fill(row.begin() + kSide, row.end(), kAbsent);
}

/// Bit z of each row where a node changed.
void gather_changes(const FineLeaves& leaves, FineNeighbourhood& out) {
  for (std::size_t x = 0; x < kSide; ++x) {
    for (std::size_t y = 0; y < kSide; ++y) {
      const std::size_t first = 9 * leaf_at(x) + 3 * leaf_at(y);
      const std::size_t row = kLeafSide * node_at(x) + node_at(y);
      const auto bits = [&](std::size_t k) -> std::uint32_t {
        const NodeRows* changed = leaves.changed[first + k];
        return changed != nullptr ? (*changed)[row] : 0U;
      };
      out.changed[row_of(x, y)] = bits(0) >> (kLeafSide - 1) | bits(1) << 1 | bits(2) << 9;
    }
  }
}

/// The rows of the block weighted along x and y: those of the coarse nodes.
using CoarseRows = std::array<std::array<Row, kCoarse>, kCoarse>;
void weigh_rows(const FineNeighbourhood& fine, CoarseRows& out) {
  std::array<Row, kSide> along_x;
  for (std::size_t i = 0; i < kCoarse; ++i) {
    for (std::size_t j = 0; j < kSide; ++j) {
      const Row& before = fine.rows[row_of(2 * i, j)];
      const Row& here = fine.rows[row_of(2 * i + 1, j)];
      const Row& after = fine.rows[row_of(2 * i + 2, j)];
      for (std::size_t k = 0; k < kRow; ++k) along_x[j][k] = weighted(before[k], here[k], after[k]);
    }
    for (std::size_t j = 0; j < kCoarse; ++j) {
      const Row& before = along_x[2 * j];
      const Row& here = along_x[2 * j + 1];
      const Row& after = along_x[2 * j + 2];
      for (std::size_t k = 0; k < kRow; ++k) {
        out[i][j][k] = weighted(before[k], here[k], after[k]);
      }
    }
  }
}

std::uint8_t changed_nodes_of_row(const FineNeighbourhood& fine, std::size_t i, std::size_t j) {
  std::uint32_t rows = 0;
  for (std::size_t a = 0; a <= 2; ++a) {
    for (std::size_t b = 0; b <= 2; ++b) rows |= fine.changed[row_of(2 * i + a, 2 * j + b)];
  }
  unsigned nodes = 0;
  for (unsigned k = 0; k < kLeafSide && rows != 0; ++k) {
    nodes |= ((rows >> 2 * k & 7U) != 0 ? 1U : 0U) << k;
  }
  return static_cast<std::uint8_t>(nodes);
}

/// Nodes that the finer level decides are flagged; they are overwritten only where the edit changed
/// what they average, or where they are off by more than is allowed: restricting what no edit
/// changed would smooth the coarse level a little each time.
void take_restricted(const Restricted& restricted, float allowed, LeafEdit& leaf) {
  for (std::size_t row = 0; row < restricted.decided.size(); ++row) {
    leaf.restricted[row] |= restricted.decided[row];
    for (unsigned decided = restricted.decided[row]; decided != 0; decided &= decided - 1) {
      const auto z = static_cast<unsigned>(std::countr_zero(decided));
      const std::size_t node = kLeafSide * row + z;
      const bool off = std::abs(leaf.now()[node] - restricted.value[node]) > allowed;
      const bool is_changed = (restricted.changed[row] >> z & 1U) != 0;
      if (off || is_changed) leaf.write()[node] = restricted.value[node];
    }
  }
}

}  // namespace

/// What lies outside the fine band counts as absent: its value is a clamp.
void gather_fine(FineSource& fine, const Coord& coarse_origin, float fine_band,
                 FineNeighbourhood& out) {
  assert(is_leaf_origin(coarse_origin) && fine_band > 0.0F);
  out.voxel = fine_band / static_cast<float>(kHalfWidthVoxels);
  out.any_present = out.any_changed = false;
  const FineLeaves leaves = leaves_of_block(fine, coarse_origin, out);
  if (!out.any_present) return;
  for (std::size_t x = 0; x < kSide; ++x) {
    for (std::size_t y = 0; y < kSide; ++y) {
      const std::size_t first = 9 * leaf_at(x) + 3 * leaf_at(y);
      gather_row({leaves.now[first], leaves.now[first + 1], leaves.now[first + 2]},
                 kLeafSide * (kLeafSide * node_at(x) + node_at(y)), fine_band,
                 out.rows[row_of(x, y)]);
    }
  }
  if (out.any_changed) {
    gather_changes(leaves, out);
  } else {
    out.changed.fill(0);
  }
}

void restrict_leaf(const FineNeighbourhood& fine, Restricted& out) {
  CoarseRows rows;
  weigh_rows(fine, rows);
  for (std::size_t i = 0; i < kCoarse; ++i) {
    for (std::size_t j = 0; j < kCoarse; ++j) {
      const Row& same = fine.rows[row_of(2 * i + 1, 2 * j + 1)];
      const Row& mean = rows[i][j];
      unsigned decided = 0;
      unsigned averaged = 0;
      const std::size_t row = i * kCoarse + j;
      for (std::size_t k = 0; k < kCoarse; ++k) {
        const float value =
            without_rounding(weighted(mean[2 * k], mean[2 * k + 1], mean[2 * k + 2]), fine.voxel);
        const float here = same[2 * k + 1];
        const bool is_averaged = !std::isnan(value);
        out.value[row * kCoarse + k] = is_averaged ? value : here;
        averaged |= (is_averaged ? 1U : 0U) << k;
        decided |= (std::isnan(here) ? 0U : 1U) << k;
      }
      out.decided[row] = static_cast<std::uint8_t>(decided);
      out.averaged[row] = static_cast<std::uint8_t>(averaged);
      out.changed[row] = fine.any_changed ? changed_nodes_of_row(fine, i, j) : std::uint8_t{0};
    }
  }
}

void restrict_edit(const LevelEdit& fine, LevelEdit& coarse, RestrictedLeaves which) {
  assert(fine.level() + 1 == coarse.level() && &fine.stack() == &coarse.stack());
  const float allowed = 0.5F * kRestrictionTolerance * static_cast<float>(fine.voxel_mm());
  std::vector<LeafEdit>& leaves = coarse.leaves();
  for_each_leaf(leaves.size(), [&](std::size_t n) {
    LeafEdit& leaf = leaves[n];
    if (which == RestrictedLeaves::touched && !leaf.changed && !finer_changed(fine, leaf.origin)) {
      return;
    }
    FineNeighbourhood around;
    EditSource source(fine);
    gather_fine(source, leaf.origin, fine.band_mm(), around);
    if (!around.any_present) return;
    Restricted restricted;
    restrict_leaf(around, restricted);
    take_restricted(restricted, allowed, leaf);
  });
}

}  // namespace argil
