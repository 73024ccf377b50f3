// SPDX-License-Identifier: GPL-3.0-or-later
// Which nodes of which leaves are solved again; distance_sweeps.cpp solves them. Changed nodes are
// spread as bits, of a leaf and kReach around it.
#include "edit/redistance.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>

#include "edit/distance_sweeps.h"
#include "field/leaf_change.h"
#include "field/mask.h"
#include "field/parallel.h"

namespace argil {
namespace {

using openvdb::CoordBBox;

NodeRows all_nodes() {
  NodeRows rows;
  rows.fill(0xff);
  return rows;
}

/// The changed nodes of a leaf and kReach around it: bit z + kReach of row (x, y).
class ChangedAround {
 public:
  ChangedAround(const LevelEdit& edit, const Coord& origin) {
    static_assert(kReach <= kLeafSide && kSide <= 32);
    LevelEdit::Reader reader(edit);
    CoordBBox around(origin, origin.offsetBy(kLeafSide - 1));
    around.expand(kReach);
    for_each_leaf_origin(around, [&](const Coord& at) {
      const LeafEdit* leaf = reader.find(at);
      if (leaf != nullptr && (leaf->changed || leaf->marked)) add(*leaf, at - origin);
    });
  }

  bool any() const noexcept { return any_; }

  /// Nodes of the leaf that some changed one is within kReach of, along every axis.
  NodeRows reached() const {
    Rows along = rows_;
    for (std::uint32_t& row : along) {
      std::uint32_t wide = 0;
      for (int step = 0; step <= 2 * kReach; ++step) wide |= row >> step;
      row = wide & 0xffU;
    }
    return spread(along);
  }

  /// Nodes of the leaf that are changed or next to one that is.
  NodeRows touched() const {
    NodeRows nodes{};
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const std::size_t at = (n / kLeafSide + kReach) * kSide + n % kLeafSide + kReach;
      const std::uint32_t here = rows_[at];
      const std::uint32_t beside =
          rows_[at - 1] | rows_[at + 1] | rows_[at - kSide] | rows_[at + kSide];
      nodes[n] = static_cast<std::uint8_t>((here | here << 1 | here >> 1 | beside) >> kReach);
    }
    return nodes;
  }

 private:
  static constexpr std::size_t kSide = kLeafSide + 2 * kReach;
  using Rows = std::array<std::uint32_t, kSide * kSide>;

  void add(const LeafEdit& leaf, const Coord& offset) {
    any_ = true;
    const CoordBBox box(Coord(-kReach), Coord(kLeafSide + kReach - 1));
    const Coord lo = Coord::maxComponent(offset, box.min());
    const Coord hi = Coord::minComponent(offset.offsetBy(kLeafSide - 1), box.max());
    for (int x = lo.x(); x <= hi.x(); ++x) {
      for (int y = lo.y(); y <= hi.y(); ++y) {
        const auto row = static_cast<std::size_t>(kLeafSide * (x - offset.x()) + y - offset.y());
        const std::uint32_t nodes = leaf.marked ? 0xffU : leaf.changed_nodes[row];
        const int shift = offset.z() + kReach;  // of the leaf's first node
        const std::uint32_t bits = shift >= 0 ? nodes << shift : nodes >> -shift;
        rows_[static_cast<std::size_t>(x + kReach) * kSide +
              static_cast<std::size_t>(y + kReach)] |= bits & ((1U << kSide) - 1U);
      }
    }
  }

  /// The rows of the leaf after each has taken in those up to kReach beside it, along y and x.
  static NodeRows spread(const Rows& rows) {
    Rows wide{};
    for (std::size_t x = 0; x < kSide; ++x) {
      for (std::size_t y = 0; y < kLeafSide; ++y) {
        for (std::size_t step = 0; step <= 2 * kReach; ++step) {
          wide[x * kSide + y] |= rows[x * kSide + y + step];
        }
      }
    }
    NodeRows nodes{};
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      std::uint32_t row = 0;
      for (std::size_t step = 0; step <= 2 * kReach; ++step) {
        row |= wide[(n / kLeafSide + step) * kSide + n % kLeafSide];
      }
      nodes[n] = static_cast<std::uint8_t>(row);
    }
    return nodes;
  }

  Rows rows_{};
  bool any_ = false;
};

/// The nodes of a leaf that are masked whole: they must not move.
NodeRows masked_nodes(const LevelEdit& edit, const Coord& origin) {
  NodeRows masked{};
  LeafValues mask;
  if (edit.stack().mask() == nullptr ||
      !edit.stack().mask()->at_nodes(edit.level(), origin, mask)) {
    return masked;
  }
  for (std::size_t n = 0; n < kLeafNodes; ++n) {
    if (mask[n] >= 1.0F) masked[n / 8] |= static_cast<std::uint8_t>(1U << n % 8);
  }
  return masked;
}

/// Those leaves of the edit of which some node is to be solved.
template <class NodesOf>
std::vector<SweptLeaf> swept_leaves(LevelEdit& edit, const NodesOf& nodes_of) {
  std::vector<LeafEdit>& leaves = edit.leaves();
  std::vector<SweptLeaf> swept(leaves.size());
  for_each_leaf(leaves.size(), [&](std::size_t n) { swept[n] = nodes_of(leaves[n]); });
  std::erase_if(swept, [](const SweptLeaf& each) { return each.leaf == nullptr; });
  return swept;
}

}  // namespace

void redistance(LevelEdit& edit, Seeds seeds) {
  edit.mark_changes();
  const auto nodes_of = [&](LeafEdit& leaf) -> SweptLeaf {
    const ChangedAround changed(edit, leaf.origin);
    if (!changed.any()) return {};
    SweptLeaf swept{&leaf, changed.reached(), {}};
    if (swept.dirty == NodeRows{}) return {};
    if (seeds == Seeds::normalise) swept.anew = changed.touched();
    return swept;
  };
  sweep_distances(edit, swept_leaves(edit, nodes_of));
}

void redistance_marked(LevelEdit& edit) {
  const auto nodes_of = [&](LeafEdit& leaf) -> SweptLeaf {
    if (!leaf.marked) return {};
    SweptLeaf swept{&leaf, all_nodes(), all_nodes()};
    const NodeRows masked = masked_nodes(edit, leaf.origin);
    for (std::size_t row = 0; row < masked.size(); ++row) {
      swept.dirty[row] &= static_cast<std::uint8_t>(~masked[row]);
    }
    return swept;
  };
  sweep_distances(edit, swept_leaves(edit, nodes_of));
}

CoordBBox reached_nodes(const Box3& bounds_mm, double voxel_mm) {
  assert(is_finite(bounds_mm.min) && is_finite(bounds_mm.max));  // else they have no nodes
  const Vec3 lo = bounds_mm.min / voxel_mm;
  const Vec3 hi = bounds_mm.max / voxel_mm;
  CoordBBox box(Coord::floor(openvdb::Vec3d(lo.x, lo.y, lo.z)),
                Coord::ceil(openvdb::Vec3d(hi.x, hi.y, hi.z)));
  box.expand(kReach + 1);
  return box;
}

}  // namespace argil
