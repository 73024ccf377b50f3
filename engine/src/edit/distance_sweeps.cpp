// SPDX-License-Identifier: GPL-3.0-or-later
// What the surface says goes one node farther with each sweep, wherever leaves begin: all leaves
// are swept together. One that was nearly right needs few. A leaf rests once nothing moves in it or
// beside it.
#include "edit/distance_sweeps.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <vector>

#include "edit/filled_around.h"
#include "edit/rows_reading.h"
#include "field/halo.h"
#include "field/parallel.h"

namespace argil {
namespace {

constexpr int kMostSweeps = 32;
/// In these. A node that still moves after them is solved by first differences, which always
/// settle: second ones may be taken and left in turn for ever.
constexpr int kSecondOrderSweeps = 10;
constexpr float kSettledVoxels = 1e-3F;  ///< what moves less has settled

/// A leaf that is solved: its values before and after a sweep, which change places.
struct Leaf {
  Leaf() noexcept {}  // NOLINT(modernize-use-equals-default): the values are not to be cleared

  const float* before = nullptr;
  NodeRows kept;
  NodeRows anew;
  NodeRows plain{};  ///< solved by first differences only
  std::array<LeafValues, 2> values;
  std::size_t now = 0;       ///< which of these is read
  std::uint64_t solves = 0;  ///< rows with a node that is not kept
  std::uint64_t moved = 0;   ///< rows in which the last sweep moved a node
  std::uint64_t swept = 0;   ///< rows of the next sweep
  /// Around it: the values of leaves that stay as they are; where null, the index of one that is
  /// solved too.
  std::array<const float*, kHaloLeaves> stays{};
  std::array<std::uint32_t, kHaloLeaves> solved{};

  const float* values_now() const noexcept { return values[now].data(); }
};

void set_flags(const NodeRows& rows, NodeFlags& flags) {
  for (std::size_t row = 0; row < rows.size(); ++row) {
    for (std::size_t z = 0; z < kLeafSide; ++z) {
      flags.is_set[row * kLeafSide + z] = rows[row] >> z & 1;
    }
  }
}

std::vector<Coord> origins_of(std::span<const SweptLeaf> leaves) {
  std::vector<Coord> origins;
  origins.reserve(leaves.size());
  for (const SweptLeaf& swept : leaves) origins.push_back(swept.leaf->origin);
  return origins;
}

NodeRows rows_of(const NodeFlags& flags) {
  NodeRows rows{};
  for (std::size_t n = 0; n < kLeafNodes; ++n) {
    rows[n / kLeafSide] |= static_cast<std::uint8_t>(flags.is_set[n] << n % kLeafSide);
  }
  return rows;
}

std::uint64_t rows_not_all(const NodeRows& kept) noexcept {
  std::uint64_t rows = 0;
  for (std::size_t row = 0; row < kept.size(); ++row) {
    rows |= std::uint64_t{kept[row] != 0xff ? 1U : 0U} << row;
  }
  return rows;
}

class Sweeps {
 public:
  Sweeps(const LevelEdit& edit, std::span<const SweptLeaf> wanted)
      : edit_(edit),
        voxel_(static_cast<float>(edit.voxel_mm())),
        filled_(edit, origins_of(wanted), FilledAround::Reach::beside),
        leaves_(wanted.size()) {
    for (std::size_t n = 0; n < wanted.size(); ++n) {
      assert(edit.find(wanted[n].leaf->origin) == wanted[n].leaf);
      std::uint32_t& index = index_.at(wanted[n].leaf->origin);
      assert(index == 0);
      index = static_cast<std::uint32_t>(n + 1);
    }
    for_each_leaf(leaves_.size(), [&](std::size_t n) { open(wanted[n], leaves_[n]); });
  }

  /// False: asked to stop.
  bool solve(const std::function<bool()>& goes_on) {
    if (goes_on && !goes_on()) return false;
    for_each_leaf(leaves_.size(), [&](std::size_t n) { seed(leaves_[n]); });
    for (int sweep = 0; sweep < kMostSweeps && is_moving(); ++sweep) {
      if (goes_on && !goes_on()) return false;
      for_each_leaf(leaves_.size(), [&](std::size_t n) {
        if (leaves_[n].swept != 0) this->sweep(leaves_[n], sweep < kSecondOrderSweeps);
      });
      choose_next();
    }
    return true;
  }

  const LeafValues& values(std::size_t n) const { return leaves_[n].values[leaves_[n].now]; }

 private:
  void open(const SweptLeaf& wanted, Leaf& leaf) const {
    leaf.before = wanted.leaf->now();
    for (std::size_t row = 0; row < leaf.kept.size(); ++row) {
      leaf.kept[row] = static_cast<std::uint8_t>(~wanted.dirty[row] | wanted.leaf->restricted[row]);
    }
    leaf.anew = wanted.anew;
    LevelEdit::Reader reader(edit_);
    LeafMap<std::uint32_t>::Reader indices(index_);
    FilledAround::Reader filled(filled_);
    for_each_halo_leaf(wanted.leaf->origin, [&](std::size_t around, const Coord& origin) {
      if (const std::uint32_t found = indices.get(origin)) {
        leaf.solved[around] = found - 1;
      } else if (const float* values = reader.filled_now(origin)) {
        leaf.stays[around] = values;
      } else {
        leaf.stays[around] = filled.values(origin);
        assert(leaf.stays[around] != nullptr);
      }
    });
  }

  /// What these rows read; `values` says which of a solved leaf's.
  template <class Values>
  void gather(const Leaf& leaf, std::uint64_t rows, const Values& values, HaloBlock& block) const {
    std::array<const float*, kHaloLeaves> around = leaf.stays;
    for (std::size_t n = 0; n < kHaloLeaves; ++n) {
      if (around[n] == nullptr) around[n] = values(leaves_[leaf.solved[n]]);
    }
    gather_halo(around, rows, block);
  }

  void seed(Leaf& leaf) const {
    HaloBlock block;
    gather(
        leaf, ~std::uint64_t{0}, [](const Leaf& other) { return other.before; }, block);
    NodeFlags kept;
    NodeFlags anew;
    set_flags(leaf.kept, kept);
    set_flags(leaf.anew, anew);
    row_loops().seed(block, anew, voxel_, kept, leaf.values[0].data());
    leaf.kept = rows_of(kept);
    leaf.solves = rows_not_all(leaf.kept);
    leaf.swept = leaf.solves;
  }

  void sweep(Leaf& leaf, bool takes_second_differences) const {
    HaloBlock block;
    gather(
        leaf, leaf.swept, [](const Leaf& other) { return other.values_now(); }, block);
    leaf.moved = row_loops().sweep(
        block, leaf.kept.data(), voxel_, edit_.band_mm(), kSettledVoxels * voxel_, leaf.swept,
        takes_second_differences ? nullptr : leaf.plain.data(), leaf.values[1 - leaf.now].data());
  }

  void choose_next() {
    for (Leaf& leaf : leaves_) {
      if (leaf.swept != 0) {
        leaf.now = 1 - leaf.now;
      } else {
        leaf.moved = 0;
      }
    }
    for (Leaf& leaf : leaves_) {
      const auto moved_at = [&](std::size_t around) -> std::uint64_t {
        return leaf.stays[around] == nullptr ? leaves_[leaf.solved[around]].moved : 0;
      };
      const std::uint64_t reading =
          rows_reading(leaf.moved, moved_at(1), moved_at(2), moved_at(3), moved_at(4)) |
          moved_at(5) | moved_at(6);
      leaf.swept = reading & leaf.solves;
    }
  }

  bool is_moving() const {
    return std::any_of(leaves_.begin(), leaves_.end(),
                       [](const Leaf& leaf) { return leaf.swept != 0; });
  }

  const LevelEdit& edit_;
  float voxel_;
  FilledAround filled_;
  LeafMap<std::uint32_t> index_;  ///< one more than that of a leaf
  std::vector<Leaf> leaves_;
};

}  // namespace

bool sweep_distances(LevelEdit& edit, std::span<const SweptLeaf> leaves,
                     const std::function<bool()>& goes_on) {
  if (leaves.empty()) return true;
  Sweeps sweeps(edit, leaves);
  if (!sweeps.solve(goes_on)) return false;
  for_each_leaf(leaves.size(), [&](std::size_t n) { leaves[n].leaf->write_all(sweeps.values(n)); });
  edit.mark_changes();
  return true;
}

}  // namespace argil
