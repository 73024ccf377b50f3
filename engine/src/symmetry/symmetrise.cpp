// SPDX-License-Identifier: GPL-3.0-or-later
// One of all images, the one with the greatest coordinates, gives the others its values. Nodes
// where a level ends need care: a mirror plane leads through nodes, and leaves of eight nodes are
// not mirrored onto leaves, so of two images only one may be stored. Such a node hands its value to
// the coarser level first, and then every image reads that.
#include "symmetry/symmetrise.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>

#include "edit/leaf_set.h"
#include "edit/prune.h"
#include "field/leaf_finder.h"
#include "field/nesting.h"
#include "field/parallel.h"
#include "field/sampling.h"

namespace argil {
namespace {

/// Leaves computed at once, in parallel, before they are written.
constexpr std::size_t kChunk = 1024;

using LevelOrigins = std::vector<std::vector<Coord>>;  // by level

/// The leaves, their images, and the coarser ones above all those.
LevelOrigins with_images(const LevelStack& stack, const LatticeSymmetry& symmetry,
                         const LeafList& leaves) {
  LeafSet seen(stack.count());
  LeafSet images(stack.count());
  for (const auto& [level, origin] : leaves) {
    Coord at = origin;
    for (int n = level; n < stack.count() && seen.insert(n, at); ++n) {
      for (const LatticeMap& map : symmetry.maps()) images.insert(n, map.leaf(at));
      at = leaf_origin(coarser(at));
    }
  }
  LevelOrigins lists;
  for (int n = 0; n < stack.count(); ++n) lists.push_back(images.sorted(n));
  return lists;
}

/// What was touched; what stands beside it, since the image of a node on the low side of a leaf
/// lies in the next leaf, and a level may end elsewhere now; and the finer leaves around what
/// changed, which may end on it.
LeafSet reached_by(const LevelStack& stack, const LeafList& touched) {
  LeafSet reached(stack.count());
  std::vector<LeafFinder> stored;
  for (int level = 0; level < stack.count(); ++level) stored.emplace_back(stack, level);
  const auto reach = [&](int n, const Coord& low, int side) {
    LeafFinder& finder = stored[static_cast<std::size_t>(n)];
    for_each_leaf_origin({low, low.offsetBy(side - 1)}, [&](const Coord& beside) {
      if (finder.has_leaf(beside)) reached.insert(n, beside);
    });
  };
  for (const auto& [level, origin] : touched) {
    reach(level, origin.offsetBy(-kLeafSide), 3 * kLeafSide);
    for (int octant = 0; octant < 8; ++octant) {
      reached.insert(
          level, origin.offsetBy(octant & 4 ? -8 : 0, octant & 2 ? -8 : 0, octant & 1 ? -8 : 0));
    }
    if (level > 0) reach(level - 1, (origin << 1).offsetBy(-kLeafSide), 4 * kLeafSide);
  }
  return reached;
}

/// The leaves as they were before a stroke, and before its images were made alike. For one thread.
class LeavesBefore {
 public:
  LeavesBefore(const LevelStack& stack, const UndoStep& stroke, const UndoStep& images)
      : stack_(stack), stroke_(stroke), images_(images) {}

  int top() const noexcept { return stack_.top(); }
  /// Most questions are for nodes of the leaf of the last one.
  const float* values(int level, const Coord& node) const {
    const Coord origin = leaf_origin(node);
    if (level != last_level_ || origin != last_origin_) {
      last_values_ = found(level, origin);
      last_level_ = level;
      last_origin_ = origin;
    }
    return last_values_;
  }
  float constant(const Coord& node) const {
    const SavedLeaf* former = saved(top(), node);
    return former != nullptr ? former->tile : stack_.grid(top()).tree().getValue(node);
  }

 private:
  const SavedLeaf* saved(int level, const Coord& node) const {
    for (const UndoStep* step : {&stroke_, &images_}) {
      const auto found = step->find({level, leaf_origin(node)});
      if (found != step->end()) return &found->second;
    }
    return nullptr;
  }
  const float* found(int level, const Coord& origin) const {
    const SavedLeaf* former = saved(level, origin);
    if (former != nullptr) return former->values ? former->values->data() : nullptr;
    const VdbLeaf* leaf = stack_.leaf(level, origin);
    return leaf != nullptr ? leaf->buffer().data() : nullptr;
  }

  const LevelStack& stack_;
  const UndoStep& stroke_;
  const UndoStep& images_;
  mutable int last_level_ = -1;
  mutable Coord last_origin_;
  mutable const float* last_values_ = nullptr;
};

/// But for the rounding of strokes that painted both sides.
bool is_masked_alike(const LevelStack& stack, int level, const Coord& a, const Coord& b) {
  constexpr double kRounding = 1e-4;
  const Mask* mask = stack.mask();
  const double voxel = stack.voxel_mm(level);
  return mask == nullptr ||
         std::abs(mask->at(node_mm(a, voxel)) - mask->at(node_mm(b, voxel))) <= kRounding;
}

/// Whether the clay was symmetric in these leaves, and is masked symmetrically.
bool was_symmetric(const EditTarget& target, const LatticeSymmetry& symmetry,
                   const LeavesBefore& before, const LevelOrigins& origins) {
  const LevelStack& stack = target.stack;
  std::atomic<bool> is_symmetric{true};
  for (int level = 0; level < stack.count(); ++level) {
    const std::vector<Coord>& list = origins[static_cast<std::size_t>(level)];
    const CoarseningCriterion rule = coarsening_criterion(stack, level, 2.0 * target.tolerance_mm);
    for_each_leaf(list.size(), [&](std::size_t at) {
      const LeavesBefore own = before;
      const float* values = own.values(level, list[at]);
      for (int n = 0; values != nullptr && is_symmetric && n < kLeafNodes; ++n) {
        if (std::abs(values[n]) >= 3.0F * rule.voxel_mm) continue;
        const Coord node = list[at].offsetBy(n >> 6, n >> 3 & 7, n & 7);
        // The first map changes nothing.
        const bool is_close = std::all_of(
            symmetry.maps().begin() + 1, symmetry.maps().end(), [&](const LatticeMap& map) {
              const Coord image = map.node(node);
              return !node_misses(values[n], sample_of(own, level, image), rule) &&
                     is_masked_alike(stack, level, node, image);
            });
        if (!is_close) is_symmetric = false;
      }
    });
  }
  return is_symmetric;
}

class Symmetriser {
 public:
  Symmetriser(EditTarget& target, const LatticeSymmetry& symmetry, const LevelOrigins& origins)
      : target_(target), stack_(target.stack), symmetry_(symmetry), origins_(origins) {
    assert(std::all_of(origins.begin(), origins.end(), are_sorted_origins));
    assert(target.sink);
  }

  void run() {
    for (int level = 0; level < stack_.count(); ++level) drop_marginal(level);
    for (int level = 1; level < stack_.count(); ++level) {
      rewrite(level, [&](const Coord& node, float value) { return injected(level, node, value); });
    }
    // Coarser levels first: the finer ones read them where they have no leaf.
    for (int level = stack_.top(); level >= 0; --level) make_images(level);
    for (int level = 0; level < stack_.count(); ++level) {
      drop_others(level);
      drop_empty(level);
    }
  }

 private:
  bool stands_for_all(const Coord& node) const { return symmetry_.is_representative_node(node); }

  /// Drops leaves whose band lies in shared faces only, two voxels and more from the surface: some
  /// image of theirs would store none of it and be there for nothing.
  void drop_marginal(int level) {
    for (const Coord& origin : origins_[static_cast<std::size_t>(level)]) {
      if (!symmetry_.is_representative_leaf(origin) || !stack_.has_leaf(level, origin)) continue;
      const bool is_marginal =
          std::any_of(symmetry_.maps().begin(), symmetry_.maps().end(),
                      [&](const LatticeMap& map) { return !has_band_in(level, origin, map); }) &&
          std::none_of(
              symmetry_.maps().begin(), symmetry_.maps().end(),
              [&](const LatticeMap& map) { return has_child(stack_, level, map.leaf(origin)); });
      if (is_marginal) erase(level, origin);
    }
  }

  /// Whether some node of a leaf whose image its image stores lies within the band.
  bool has_band_in(int level, const Coord& origin, const LatticeMap& map) const {
    Coord low = origin;
    for (std::size_t a = 0; a < 3; ++a) {
      if (map.sign[a] < 0) ++low[static_cast<int>(map.axis[a])];
    }
    const float band = stack_.band_mm(level);
    for (int n = kLeafNodes - 1; n >= 0; --n) {
      const Coord node = low.offsetBy(n >> 6, n >> 3 & 7, n & 7);
      if (std::abs(stack_.sample(level, node)) < band) return true;
    }
    return false;
  }

  /// Where the level ends. Of two mirror images only one is stored there, in the leaf on its higher
  /// side.
  bool is_border_node(int level, const Coord& node) const {
    return !all_around(node, [&](const Coord& origin) {
      return stack_.has_leaf(level, symmetry_.representative_leaf(origin));
    });
  }

  /// A finer node at the border of its level keeps its value by giving it to the coarser one.
  float injected(int level, const Coord& node, float value) const {
    assert(level > 0);
    if (!stands_for_all(node)) return value;
    const Coord fine = node << 1;
    const VdbLeaf* leaf = stack_.leaf(level - 1, fine);
    if (leaf == nullptr || !is_border_node(level - 1, fine)) return value;
    const float finer = leaf->buffer().data()[leaf_offset(fine)];
    return std::abs(finer) < stack_.band_mm(level - 1) ? finer : value;
  }

  /// Where its level ends every image reads the coarser levels where it is itself: copied from a
  /// quarter turn they would have other roundings. At the coarsest level nothing but the side is
  /// there.
  float image_of(int level, const Coord& node) const {
    const float band = stack_.band_mm(level);
    const bool is_border = is_border_node(level, node);
    if (is_border && level < stack_.top()) {
      return std::clamp(stack_.sample_above(level, node), -band, band);
    }
    const float value = stack_.sample(level, symmetry_.representative_node(node));
    if (is_border) return value < 0.0F ? -band : band;
    return std::clamp(value, -band, band);
  }

  /// Gives every node of the level's leaves the value `law(node, value)`.
  template <class Law>
  void rewrite(int level, const Law& law) {
    write(level, origins_[static_cast<std::size_t>(level)],
          [&](const Coord& origin, LeafValues& to) {
            const VdbLeaf* leaf = stack_.leaf(level, origin);
            if (leaf == nullptr) return false;
            for (int n = 0; n < kLeafNodes; ++n) {
              const Coord node = origin.offsetBy(n >> 6, n >> 3 & 7, n & 7);
              to[static_cast<std::size_t>(n)] = law(node, leaf->buffer().data()[n]);
            }
            return true;
          });
  }

  /// Where the leaf that stands for all is stored its images are, with its values; other
  /// leaves get the values that stand for theirs and may be dropped.
  void make_images(int level) {
    write(level, origins_[static_cast<std::size_t>(level)],
          [&](const Coord& origin, LeafValues& to) {
            const bool stays = stack_.has_leaf(level, symmetry_.representative_leaf(origin));
            if (!stays && !stack_.has_leaf(level, origin)) return false;
            for (int n = 0; n < kLeafNodes; ++n) {
              const Coord node = origin.offsetBy(n >> 6, n >> 3 & 7, n & 7);
              to[static_cast<std::size_t>(n)] = image_of(level, node);
            }
            return true;
          });
  }

  /// Writes the leaves for which `fill` returns true, as far as they differ.
  template <class Fill>
  void write(int level, const std::vector<Coord>& origins, const Fill& fill) {
    std::vector<LeafValues> values(std::min(kChunk, origins.size()));
    std::vector<std::uint8_t> filled(values.size());
    for (std::size_t begin = 0; begin < origins.size(); begin += kChunk) {
      const std::size_t count = std::min(kChunk, origins.size() - begin);
      for_each_leaf(count, [&](std::size_t n) { filled[n] = fill(origins[begin + n], values[n]); });
      for (std::size_t n = 0; n < count; ++n) {
        if (filled[n] != 0) put(level, origins[begin + n], values[n]);
      }
    }
  }

  void put(int level, const Coord& origin, const LeafValues& values) {
    assert(is_leaf_origin(origin));
    const VdbLeaf* leaf = stack_.leaf(level, origin);
    if (leaf == nullptr) {
      count_copy();
      target_.sink({level, origin}, nullptr, stack_.grid(level).tree().getValue(origin));
      stack_.set_leaf(level, origin, values.data());
      return;
    }
    const float* now = leaf->buffer().data();
    if (std::equal(values.begin(), values.end(), now)) return;
    count_copy();
    target_.sink(change_of_values(level, origin, now, values.data()), now, 0.0F);
    stack_.rewrite_leaf(level, origin, values.data());
  }

  /// Drops leaves of the level for which the one that stands for them is not stored.
  void drop_others(int level) {
    for (const Coord& origin : origins_[static_cast<std::size_t>(level)]) {
      const Coord first = symmetry_.representative_leaf(origin);
      if (!stack_.has_leaf(level, origin) || stack_.has_leaf(level, first)) continue;
      const auto finer_present = [&](const Coord& at) { return stack_.has_leaf(level - 1, at); };
      if (level > 0 && required_by_finer(origin, finer_present) &&
          sides_differ(stack_, level, origin, kLeafSide)) {
        continue;
      }
      erase(level, origin);
    }
  }

  /// What leaves see at the far ends of their cells lies in the next ones.
  void drop_empty(int level) {
    for (const Coord& changed : origins_[static_cast<std::size_t>(level)]) {
      for_each_leaf_origin({changed.offsetBy(-kLeafSide), changed}, [&](const Coord& origin) {
        if (stack_.has_leaf(level, origin) && is_empty(stack_, level, origin)) erase(level, origin);
      });
    }
  }

  void erase(int level, const Coord& origin) {
    assert(stack_.has_leaf(level, origin));
    const float* values = stack_.leaf(level, origin)->buffer().data();
    const float band = stack_.band_mm(level);
    const float tile = values[0] < 0.0F ? -band : band;
    target_.sink({level, origin}, values, 0.0F);
    stack_.erase_leaf(level, origin, tile);
  }

  /// A leaf more, here or in the step that the sink fills.
  void count_copy() {
    copied_bytes_ += static_cast<std::int64_t>(sizeof(LeafValues));
    if (copied_bytes_ > target_.free_bytes) throw OverLimit(copied_bytes_);
  }

  EditTarget& target_;
  LevelStack& stack_;
  const LatticeSymmetry& symmetry_;
  const LevelOrigins& origins_;
  std::int64_t copied_bytes_ = 0;
};

}  // namespace

/// A clay without a stroke: nothing was saved, so the leaves before are the leaves now.
bool is_symmetric(const EditTarget& target, const LatticeSymmetry& symmetry) {
  const LevelStack& stack = target.stack;
  const LevelOrigins origins = with_images(stack, symmetry, all_leaves(stack));
  const UndoStep none;
  return was_symmetric(target, symmetry, {stack, none, none}, origins);
}

void symmetrise_all(EditTarget& target, const LatticeSymmetry& symmetry) {
  const LevelStack& stack = target.stack;
  const LevelOrigins origins = with_images(stack, symmetry, all_leaves(stack));
  Symmetriser(target, symmetry, origins).run();
}

bool symmetrise(EditTarget& target, const LatticeSymmetry& symmetry, const UndoStep& stroke,
                const UndoStep& images, const LeafList& touched) {
  const LevelStack& stack = target.stack;
  const LevelOrigins origins = with_images(stack, symmetry, reached_by(stack, touched).list());
  if (!was_symmetric(target, symmetry, {stack, stroke, images}, origins)) return false;
  Symmetriser(target, symmetry, origins).run();
  return true;
}

LeafList leaves_that_see(const LevelStack& stack, const LeafList& changed) {
  LeafSet leaves = reached_by(stack, changed);
  for (const auto& [level, origin] : changed) {
    if (level == stack.top()) continue;
    const int above = level + 1;
    for_each_required_parent(origin, [&](const Coord& coarse) { leaves.insert(above, coarse); });
  }
  return leaves.list();
}

}  // namespace argil
