// SPDX-License-Identifier: GPL-3.0-or-later
// Full weighting of 17^3 fine nodes to 8^3 coarse ones; rows/restrict_impl.h averages. Changes are
// spread to coarse nodes as bits.
#include "edit/restriction.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>

#include "field/parallel.h"
#include "field/row_bits.h"
#include "rows/rows.h"

namespace argil {
namespace {

constexpr std::size_t kSide = 17;  // fine nodes that decide a leaf's, along each axis

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

/// Which of three leaves, and which of its nodes along an axis, fine node i is.
constexpr std::size_t leaf_at(std::size_t i) { return (i + kLeafSide - 1) / kLeafSide; }
constexpr std::size_t node_at(std::size_t i) { return (i + kLeafSide - 1) % kLeafSide; }

/// The even ones of 16 bits.
std::uint8_t even_bits(std::uint32_t bits) {
  bits &= 0x5555;
  bits = (bits | bits >> 1) & 0x3333;
  bits = (bits | bits >> 2) & 0x0f0f;
  return static_cast<std::uint8_t>(bits | bits >> 4);
}

/// The coarse nodes that a changed fine node has a weight in.
NodeRows reached_by_changes(const FineLeaves& fine) {
  NodeRows reached{};
  if (!fine.any_changed) return reached;
  std::array<std::array<std::uint32_t, kSide>, kSide> rows;  // bits along z
  for (std::size_t x = 0; x < kSide; ++x) {
    for (std::size_t y = 0; y < kSide; ++y) {
      const NodeRows* const* changed = fine.changed.data() + 9 * leaf_at(x) + 3 * leaf_at(y);
      const std::size_t row = kLeafSide * node_at(x) + node_at(y);
      const auto bits = [&](std::size_t k) -> std::uint32_t {
        return changed[k] != nullptr ? (*changed[k])[row] : 0U;
      };
      rows[x][y] = bits(0) >> (kLeafSide - 1) | bits(1) << 1 | bits(2) << 9;
    }
  }
  for (std::size_t i = 0; i < kLeafSide; ++i) {
    std::array<std::uint32_t, kSide> plane;
    for (std::size_t y = 0; y < kSide; ++y) {
      plane[y] = rows[2 * i][y] | rows[2 * i + 1][y] | rows[2 * i + 2][y];
    }
    for (std::size_t j = 0; j < kLeafSide; ++j) {
      const std::uint32_t row = plane[2 * j] | plane[2 * j + 1] | plane[2 * j + 2];
      reached[kLeafSide * i + j] = even_bits(row | row >> 1 | row >> 2);
    }
  }
  return reached;
}

/// Nodes that the finer level decides are flagged; they are overwritten only where the edit changed
/// what they average, or where they are off by more than is allowed: restricting what no edit
/// changed would smooth the coarse level a little each time.
void take_restricted(const Restricted& restricted, float allowed, LeafEdit& leaf) {
  for (std::size_t row = 0; row < restricted.decided.size(); ++row) {
    const unsigned decided = restricted.decided[row];
    leaf.restricted[row] |= restricted.decided[row];
    if (decided == 0) continue;
    const std::size_t first = kLeafSide * row;
    const float* values = restricted.value.data() + first;
    unsigned taken = far_bits(leaf.now() + first, values, allowed) | restricted.changed[row];
    for (taken &= decided; taken != 0; taken &= taken - 1) {
      const auto z = static_cast<std::size_t>(std::countr_zero(taken));
      leaf.write()[first + z] = values[z];
    }
  }
}

}  // namespace

FineLeaves fine_leaves(FineSource& fine, const Coord& coarse_origin) {
  assert(is_leaf_origin(coarse_origin));
  FineLeaves leaves;
  const Coord first = (coarse_origin << 1).offsetBy(-kLeafSide);
  std::size_t n = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 3; ++k, ++n) {
        const Coord origin = first.offsetBy(kLeafSide * i, kLeafSide * j, kLeafSide * k);
        leaves.now[n] = fine.now(origin);
        const NodeRows* changed = fine.changed(origin);
        leaves.any_touched |= changed != nullptr;
        if (leaves.now[n] == nullptr) continue;
        leaves.any_present = true;
        leaves.changed[n] = changed;
        leaves.any_changed |= changed != nullptr;
      }
    }
  }
  return leaves;
}

/// What lies outside the fine band counts as absent: its value is a clamp.
void restrict_leaf(const FineLeaves& fine, float fine_band_mm, Restricted& out) {
  assert(fine_band_mm > 0.0F);
  static const LeafValues absent = [] {
    LeafValues values;
    values.fill(std::numeric_limits<float>::max());
    return values;
  }();
  RestrictJob job{{}, fine_band_mm, fine_band_mm / static_cast<float>(kHalfWidthVoxels)};
  std::transform(fine.now.begin(), fine.now.end(), std::begin(job.leaves),
                 [](const float* values) { return values != nullptr ? values : absent.data(); });
  row_loops().restrict_leaf(job, out.value.data(), out.decided.data(), out.averaged.data());
  out.changed = reached_by_changes(fine);
}

void restrict_edit(const LevelEdit& fine, LevelEdit& coarse, RestrictedLeaves which) {
  assert(fine.level() + 1 == coarse.level() && &fine.stack() == &coarse.stack());
  const float allowed = 0.5F * kRestrictionTolerance * static_cast<float>(fine.voxel_mm());
  std::vector<LeafEdit>& leaves = coarse.leaves();
  for_each_leaf(leaves.size(), [&](std::size_t n) {
    LeafEdit& leaf = leaves[n];
    EditSource source(fine);
    const FineLeaves around = fine_leaves(source, leaf.origin);
    if (!around.any_present) return;
    const bool is_touched = leaf.changed || leaf.marked || around.any_touched;
    if (which == RestrictedLeaves::touched && !is_touched) return;
    Restricted restricted;
    restrict_leaf(around, fine.band_mm(), restricted);
    take_restricted(restricted, allowed, leaf);
  });
}

}  // namespace argil
