// SPDX-License-Identifier: GPL-3.0-or-later
// What is too short spreads downwind, as distances do, from node to node, 64 at once: as bits
// within a leaf until nothing is added, then from leaf to leaf.
#include "edit/short_nodes.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <cstring>
#include <utility>

#include "field/leaf_finder.h"
#include "field/leaf_map.h"
#include "field/parallel.h"
#include "field/prolongation.h"
#include "rows/rows.h"

namespace argil {
namespace {

/// Less is too slow. Beside a corner upwind differences of a distance say .59, and the solution
/// there is 1.2 times the distance.
constexpr float kLeastSlope = 0.8F;
/// In voxels. Of a node that rises less along an axis, what is beside it there says next to
/// nothing: a fiftieth.
constexpr float kLeastRise = 0.2F;

/// Which of a leaf's nodes beside each leaf of kHaloOffsets, for the first all of them, lie on a
/// side and within the band.
std::array<bool, kHaloLeaves> banded_beside(const float* values, float side, float band) {
  std::array<bool, kHaloLeaves> any{};
  for (std::size_t row = 0; row < kLeafRows; ++row) {
    unsigned bits = 0;
    for (unsigned z = 0; z < kLeafSide; ++z) {
      const float here = side * values[kLeafSide * row + z];
      bits |= ((here > 0.0F) & (here < band) ? 1U : 0U) << z;
    }
    if (bits == 0) continue;
    const std::size_t x = row / kLeafSide;
    const std::size_t y = row % kLeafSide;
    const std::array<bool, kHaloLeaves> here{true,
                                             x == 0,
                                             x == kLeafSide - 1,
                                             y == 0,
                                             y == kLeafSide - 1,
                                             (bits & 1U) != 0,
                                             (bits >> (kLeafSide - 1)) != 0};
    for (std::size_t n = 0; n < kHaloLeaves; ++n) any[n] |= here[n];
  }
  return any;
}

/// A leaf and what is beside it, as far as its nodes on the job's side read it: where the level has
/// no leaf, what coarser ones say, since the surface may be there. False where no node does.
bool gather_with_coarser(const LevelStack& stack, int level, const Coord& origin,
                         const UpwindJob& job, HaloBlock& block) {
  LeafFinder leaves(stack, level);
  const float* own = leaves.values(origin);
  assert(own != nullptr);
  const std::array<bool, kHaloLeaves> is_read = banded_beside(own, job.side, job.band);
  if (!is_read[0]) return false;
  std::array<LeafValues, kHaloLeaves> interpolated;
  std::array<const float*, kHaloLeaves> around{};
  for_each_halo_leaf(origin, [&](std::size_t n, const Coord& at) {
    around[n] = is_read[n] ? leaves.values(at) : own;
    if (around[n] != nullptr) return;
    prolong_leaf(stack, level, at, interpolated[n]);
    around[n] = interpolated[n].data();
  });
  gather_halo(around, block);
  return true;
}

/// Bits of a leaf's nodes: word x, bit 8 y + z.
using NodeBits = std::array<std::uint64_t, kLeafSide>;

NodeBits bits_from(const unsigned char* rows) noexcept {
  NodeBits bits;
  static_assert(sizeof bits == kLeafRows);
  std::memcpy(bits.data(), rows, sizeof bits);  // little-endian: byte y of word x
  return bits;
}

/// A leaf with nodes that others tell.
struct ToldLeaf {
  Coord origin;
  std::array<NodeBits, 6> by{};  ///< of each neighbour, in the order of kHaloOffsets
  NodeBits found{};
  NodeBits next{};
  bool is_new = false;                    ///< the last round added to `found`
  std::array<std::uint32_t, 6> beside{};  ///< one more than the index of the leaves there
};

class Spread {
 public:
  explicit Spread(std::vector<ToldLeaf> leaves) : leaves_(std::move(leaves)) {
    for (std::size_t n = 0; n < leaves_.size(); ++n) {
      index_.at(leaves_[n].origin) = static_cast<std::uint32_t>(n + 1);
    }
    for_each_leaf(leaves_.size(), [&](std::size_t n) {
      LeafMap<std::uint32_t>::Reader index(index_);
      for_each_halo_leaf(leaves_[n].origin, [&](std::size_t around, const Coord& origin) {
        if (around > 0) leaves_[n].beside[around - 1] = index.get(origin);
      });
    });
  }

  /// Every round reads the one before.
  std::vector<ShortNodes> run() {
    for (bool is_first = true; is_first || any_new(); is_first = false) {
      for_each_leaf(leaves_.size(), [&](std::size_t n) { grow(leaves_[n], is_first); });
      for (ToldLeaf& leaf : leaves_) {
        leaf.is_new = leaf.next != leaf.found;
        leaf.found = leaf.next;
      }
    }
    std::vector<ShortNodes> found;
    for (const ToldLeaf& leaf : leaves_) {
      if (leaf.found == NodeBits{}) continue;
      found.push_back({leaf.origin, {}});
      std::memcpy(found.back().rows.data(), leaf.found.data(), sizeof leaf.found);
    }
    return found;
  }

 private:
  const ToldLeaf* beside(const ToldLeaf& leaf, std::size_t way) const noexcept {
    return leaf.beside[way] == 0 ? nullptr : &leaves_[leaf.beside[way] - 1];
  }
  bool any_new() const {
    return std::any_of(leaves_.begin(), leaves_.end(),
                       [](const ToldLeaf& leaf) { return leaf.is_new; });
  }
  void grow(ToldLeaf& leaf, bool is_first) const;

  std::vector<ToldLeaf> leaves_;
  LeafMap<std::uint32_t> index_;
};

void Spread::grow(ToldLeaf& leaf, bool is_first) const {
  constexpr std::uint64_t kFirst = 0x0101010101010101ULL;  // z = 0 of every y
  constexpr std::uint64_t kLast = 0x8080808080808080ULL;
  static constexpr NodeBits kNone{};
  std::array<const NodeBits*, 6> around{};
  bool is_reached = is_first && leaf.found != kNone;
  for (std::size_t way = 0; way < 6; ++way) {
    const ToldLeaf* other = beside(leaf, way);
    around[way] = other != nullptr ? &other->found : &kNone;
    is_reached = is_reached || (other != nullptr && (other->is_new || is_first));
  }
  leaf.next = leaf.found;
  if (!is_reached) return;
  for (bool grows = true; grows;) {
    const NodeBits now = leaf.next;
    for (std::size_t x = 0; x < now.size(); ++x) {
      const std::array<std::uint64_t, 6> there{
          x > 0 ? now[x - 1] : around[0]->back(),
          x + 1 < now.size() ? now[x + 1] : around[1]->front(),
          now[x] << 8 | (*around[2])[x] >> 56,
          now[x] >> 8 | (*around[3])[x] << 56,
          (now[x] & ~kLast) << 1 | ((*around[4])[x] & kLast) >> 7,
          (now[x] & ~kFirst) >> 1 | ((*around[5])[x] & kFirst) << 7};
      for (std::size_t way = 0; way < 6; ++way) leaf.next[x] |= leaf.by[way][x] & there[way];
    }
    grows = leaf.next != now;
  }
}

}  // namespace

std::vector<ShortNodes> find_short_nodes(const LevelStack& stack, int level, bool is_outside) {
  const UpwindJob job{is_outside ? 1.0F : -1.0F, static_cast<float>(stack.voxel_mm(level)),
                      stack.band_mm(level), kLeastSlope, kLeastRise};
  const std::vector<Coord> origins = stack.sorted_origins(level);
  std::vector<ToldLeaf> leaves(origins.size());
  std::vector<std::uint8_t> is_told(origins.size(), 0);
  for_each_leaf(origins.size(), [&](std::size_t n) {
    HaloBlock block;
    if (!gather_with_coarser(stack, level, origins[n], job, block)) return;
    UpwindRows rows;
    row_loops().find_upwind(block, job, rows);
    is_told[n] = bits_from(rows.told) != NodeBits{} ? 1 : 0;
    leaves[n].origin = origins[n];
    leaves[n].found = bits_from(rows.slow);
    for (std::size_t way = 0; way < 6; ++way) leaves[n].by[way] = bits_from(rows.by[way]);
  });
  std::size_t kept = 0;
  for (std::size_t n = 0; n < leaves.size(); ++n) {
    if (is_told[n] != 0) leaves[kept++] = leaves[n];
  }
  leaves.resize(kept);
  const bool any = std::any_of(leaves.begin(), leaves.end(),
                               [](const ToldLeaf& leaf) { return leaf.found != NodeBits{}; });
  if (!any) return {};
  return Spread(std::move(leaves)).run();
}

}  // namespace argil
