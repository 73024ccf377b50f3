// SPDX-License-Identifier: GPL-3.0-or-later
// Full weighting of 17^3 fine nodes to 8^3 coarse ones, along x and y by rows of floats, which the
// compiler turns into vector instructions, then along z. Nodes without a value are NaN, so that an
// average with one of them is NaN too and needs no test: the node's own value stands instead.
#include "edit/restriction.h"

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

/// `count` nodes of a row as restriction takes them: nothing of what lies outside the band.
void copy_in_band(const float* from, std::size_t count, float band, float* to) {
  for (std::size_t z = 0; z < count; ++z) to[z] = std::abs(from[z]) < band ? from[z] : kAbsent;
}

/// The part of one fine leaf, `now`, in the block that starts at `block_low`.
void gather_leaf(const float* now, const NodeRows* changed, const Coord& origin,
                 const Coord& block_low, float band, FineNeighbourhood& out) {
  const Coord lo = Coord::maxComponent(origin, block_low) - block_low;
  const Coord hi =
      Coord::minComponent(origin.offsetBy(kLeafSide - 1), block_low.offsetBy(kSide - 1)) -
      block_low;
  const int shift = (origin - block_low).z();  // where the leaf's first node is in the block
  const auto first = static_cast<std::size_t>(lo.z());
  const bool is_whole_row = hi.z() - lo.z() + 1 == kLeafSide;
  assert(is_whole_row || hi.z() == lo.z());  // the block begins one node below a leaf
  for (int x = lo.x(); x <= hi.x(); ++x) {
    for (int y = lo.y(); y <= hi.y(); ++y) {
      const std::size_t row = row_of(static_cast<std::size_t>(x), static_cast<std::size_t>(y));
      const int from = leaf_offset(block_low.offsetBy(x, y, lo.z()));
      // Of a constant length, so that a row is a few vector instructions.
      if (is_whole_row) {
        copy_in_band(now + from, kLeafSide, band, out.rows[row].data() + first);
      } else {
        copy_in_band(now + from, 1, band, out.rows[row].data() + first);
      }
      if (changed == nullptr) continue;
      const std::uint32_t bits = (*changed)[static_cast<std::size_t>(from / kLeafSide)];
      out.changed[row] |= shift < 0 ? bits >> -shift : bits << shift;
    }
  }
  out.any_changed = out.any_changed || changed != nullptr;
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
    for (unsigned decided = restricted.decided[row]; decided != 0; decided &= decided - 1) {
      const auto z = static_cast<unsigned>(std::countr_zero(decided));
      const std::size_t node = kLeafSide * row + z;
      leaf.restricted.set(node);
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
  for (Row& row : out.rows) row.fill(kAbsent);
  out.changed.fill(0);
  out.voxel = fine_band / static_cast<float>(kHalfWidthVoxels);
  out.any_present = out.any_changed = false;
  const Coord low = (coarse_origin << 1).offsetBy(-1);
  for_each_leaf_origin({low, low.offsetBy(kSide - 1)}, [&](const Coord& origin) {
    const float* now = fine.now(origin);
    if (now == nullptr) return;
    out.any_present = true;
    gather_leaf(now, fine.changed(origin), origin, low, fine_band, out);
  });
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
