// SPDX-License-Identifier: GPL-3.0-or-later
#include "symmetrise.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <set>

#include "leaf_values.h"
#include "nesting.h"
#include "retention.h"

namespace argil {
namespace {

/// Leaves computed at once, in parallel, before they are written.
constexpr std::size_t kChunk = 1024;

using LevelPlaces = std::vector<std::vector<Coord>>;  // by level

/// The places, their images, and the coarser ones above all those.
LevelPlaces with_images(const LevelStack& stack, const LatticeSymmetry& symmetry,
                        const LeafList& leaves) {
  std::vector<std::set<Coord>> all(static_cast<std::size_t>(stack.count()));
  for (const auto& [level, place] : leaves) {
    Coord at = place;
    for (int n = level; n < stack.count(); ++n, at = place_of(coarser(at))) {
      for (const LatticeMap& map : symmetry.maps()) {
        all[static_cast<std::size_t>(n)].insert(map.place(at));
      }
    }
  }
  LevelPlaces lists;
  lists.reserve(all.size());
  for (const std::set<Coord>& set : all) lists.emplace_back(set.begin(), set.end());
  return lists;
}

/// What was touched; what stands beside it, since the image of a node on the low side of a leaf
/// lies in the next leaf, and a level may end elsewhere now; and the finer leaves around what
/// changed, which may end on it.
LeafList reached_by(const LevelStack& stack, const LeafList& touched) {
  LeafList reached;
  for (const auto& [level, place] : touched) {
    reached.emplace_back(level, place);
    const auto reach = [&](int n, const Coord& low, int side) {
      for_each_place({low, low.offsetBy(side - 1)}, [&](const Coord& beside) {
        if (stack.has_leaf(n, beside)) reached.emplace_back(n, beside);
      });
    };
    reach(level, place.offsetBy(-kLeafSide), 3 * kLeafSide);
    for (int octant = 1; octant < 8; ++octant) {
      reached.emplace_back(
          level, place.offsetBy(octant & 4 ? -8 : 0, octant & 2 ? -8 : 0, octant & 1 ? -8 : 0));
    }
    if (level > 0) reach(level - 1, (place << 1).offsetBy(-kLeafSide), 4 * kLeafSide);
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
    const Coord place = place_of(node);
    if (level != last_level_ || place != last_place_) {
      last_values_ = found(level, place);
      last_level_ = level;
      last_place_ = place;
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
      const auto found = step->find({level, place_of(node)});
      if (found != step->end()) return &found->second;
    }
    return nullptr;
  }
  const float* found(int level, const Coord& place) const {
    const SavedLeaf* former = saved(level, place);
    if (former != nullptr) return former->values ? former->values->data() : nullptr;
    const VdbLeaf* leaf = stack_.leaf(level, place);
    return leaf != nullptr ? leaf->buffer().data() : nullptr;
  }

  const LevelStack& stack_;
  const UndoStep& stroke_;
  const UndoStep& images_;
  mutable int last_level_ = -1;
  mutable Coord last_place_;
  mutable const float* last_values_ = nullptr;
};

/// But for the rounding of strokes that painted both sides.
bool is_held_alike(const LevelStack& stack, int level, const Coord& a, const Coord& b) {
  constexpr double kRounding = 1e-4;
  const Mask* mask = stack.mask();
  const double voxel = stack.voxel_mm(level);
  return mask == nullptr ||
         std::abs(mask->at(place_mm(a, voxel)) - mask->at(place_mm(b, voxel))) <= kRounding;
}

/// Whether the clay was symmetric at the places, and is held symmetrically.
bool was_symmetric(const EditTarget& target, const LatticeSymmetry& symmetry,
                   const LeavesBefore& before, const LevelPlaces& places) {
  const LevelStack& stack = target.stack;
  std::atomic<bool> is_symmetric{true};
  for (int level = 0; level < stack.count(); ++level) {
    const std::vector<Coord>& list = places[static_cast<std::size_t>(level)];
    const RetentionRule rule = retention_rule(stack, level, 2.0 * target.tolerance_mm);
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
                     is_held_alike(stack, level, node, image);
            });
        if (!is_close) is_symmetric = false;
      }
    });
  }
  return is_symmetric;
}

class Symmetriser {
 public:
  Symmetriser(EditTarget& target, const LatticeSymmetry& symmetry, const LevelPlaces& places)
      : target_(target), stack_(target.stack), symmetry_(symmetry), places_(places) {}

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
    for (const Coord& place : places_[static_cast<std::size_t>(level)]) {
      if (!symmetry_.is_representative_place(place) || !stack_.has_leaf(level, place)) continue;
      const bool is_marginal =
          std::any_of(symmetry_.maps().begin(), symmetry_.maps().end(),
                      [&](const LatticeMap& map) { return !has_band_in(level, place, map); }) &&
          std::none_of(
              symmetry_.maps().begin(), symmetry_.maps().end(),
              [&](const LatticeMap& map) { return has_child(stack_, level, map.place(place)); });
      if (is_marginal) erase(level, place);
    }
  }

  /// Whether some node of a place whose image its image stores lies within the band.
  bool has_band_in(int level, const Coord& place, const LatticeMap& map) const {
    Coord low = place;
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
    return !all_around(node, [&](const Coord& place) {
      return stack_.has_leaf(level, symmetry_.representative_place(place));
    });
  }

  /// A finer node at the border of its level keeps its value by giving it to the coarser one.
  float injected(int level, const Coord& node, float value) const {
    if (!stands_for_all(node)) return value;
    const Coord fine = node << 1;
    const VdbLeaf* leaf = stack_.leaf(level - 1, fine);
    if (leaf == nullptr || !is_border_node(level - 1, fine)) return value;
    const float finer = leaf->buffer().data()[leaf_offset(fine)];
    return std::abs(finer) < stack_.band_mm(level - 1) ? finer : value;
  }

  /// Where its level ends every image reads the coarser levels in its own place: copied from a
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
    write(level, places_[static_cast<std::size_t>(level)], [&](const Coord& place, LeafValues& to) {
      const VdbLeaf* leaf = stack_.leaf(level, place);
      if (leaf == nullptr) return false;
      for (int n = 0; n < kLeafNodes; ++n) {
        const Coord node = place.offsetBy(n >> 6, n >> 3 & 7, n & 7);
        to[static_cast<std::size_t>(n)] = law(node, leaf->buffer().data()[n]);
      }
      return true;
    });
  }

  /// Where the place that stands for all has a leaf its images have one, with its values; other
  /// leaves get the values that stand for theirs and may be dropped.
  void make_images(int level) {
    write(level, places_[static_cast<std::size_t>(level)], [&](const Coord& place, LeafValues& to) {
      const bool stays = stack_.has_leaf(level, symmetry_.representative_place(place));
      if (!stays && !stack_.has_leaf(level, place)) return false;
      for (int n = 0; n < kLeafNodes; ++n) {
        const Coord node = place.offsetBy(n >> 6, n >> 3 & 7, n & 7);
        to[static_cast<std::size_t>(n)] = image_of(level, node);
      }
      return true;
    });
  }

  /// Writes the leaves at the places for which `fill` returns true, as far as they differ.
  template <class Fill>
  void write(int level, const std::vector<Coord>& places, const Fill& fill) {
    std::vector<LeafValues> values(std::min(kChunk, places.size()));
    std::vector<std::uint8_t> filled(values.size());
    for (std::size_t begin = 0; begin < places.size(); begin += kChunk) {
      const std::size_t count = std::min(kChunk, places.size() - begin);
      for_each_leaf(count, [&](std::size_t n) { filled[n] = fill(places[begin + n], values[n]); });
      for (std::size_t n = 0; n < count; ++n) {
        if (filled[n] != 0) put(level, places[begin + n], values[n]);
      }
    }
  }

  void put(int level, const Coord& place, const LeafValues& values) {
    const VdbLeaf* leaf = stack_.leaf(level, place);
    if (leaf == nullptr) {
      count_copy();
      target_.sink({level, place}, nullptr, stack_.grid(level).tree().getValue(place));
      stack_.set_leaf(level, place, values.data());
      return;
    }
    const float* now = leaf->buffer().data();
    if (std::equal(values.begin(), values.end(), now)) return;
    count_copy();
    target_.sink(change_of_values(level, place, now, values.data()), now, 0.0F);
    stack_.rewrite_leaf(level, place, values.data());
  }

  /// Drops leaves of the level that the places which stand for theirs have not.
  void drop_others(int level) {
    for (const Coord& place : places_[static_cast<std::size_t>(level)]) {
      const Coord first = symmetry_.representative_place(place);
      if (!stack_.has_leaf(level, place) || stack_.has_leaf(level, first)) continue;
      const auto finer_present = [&](const Coord& at) { return stack_.has_leaf(level - 1, at); };
      if (level > 0 && required_by_finer(place, finer_present) &&
          sides_differ(stack_, level, place, kLeafSide)) {
        continue;
      }
      erase(level, place);
    }
  }

  /// What leaves hold at the far ends of their cells lies in the next ones.
  void drop_empty(int level) {
    for (const Coord& changed : places_[static_cast<std::size_t>(level)]) {
      for_each_place({changed.offsetBy(-kLeafSide), changed}, [&](const Coord& place) {
        if (stack_.has_leaf(level, place) && is_empty(stack_, level, place)) erase(level, place);
      });
    }
  }

  void erase(int level, const Coord& place) {
    const float* values = stack_.leaf(level, place)->buffer().data();
    const float band = stack_.band_mm(level);
    const float tile = values[0] < 0.0F ? -band : band;
    target_.sink({level, place}, values, 0.0F);
    stack_.erase_leaf(level, place, tile);
  }

  /// A leaf more, here or in the step that the sink fills.
  void count_copy() {
    copied_bytes_ += static_cast<std::int64_t>(sizeof(LeafValues));
    if (copied_bytes_ > target_.free_bytes) throw OverLimit(copied_bytes_);
  }

  EditTarget& target_;
  LevelStack& stack_;
  const LatticeSymmetry& symmetry_;
  const LevelPlaces& places_;
  std::int64_t copied_bytes_ = 0;
};

}  // namespace

bool is_symmetric(const EditTarget& target, const LatticeSymmetry& symmetry) {
  const LevelStack& stack = target.stack;
  const LevelPlaces places = with_images(stack, symmetry, all_leaves(stack));
  const UndoStep none;
  return was_symmetric(target, symmetry, {stack, none, none}, places);
}

void symmetrise_all(EditTarget& target, const LatticeSymmetry& symmetry) {
  const LevelStack& stack = target.stack;
  const LevelPlaces places = with_images(stack, symmetry, all_leaves(stack));
  Symmetriser(target, symmetry, places).run();
}

bool symmetrise(EditTarget& target, const LatticeSymmetry& symmetry, const UndoStep& stroke,
                const UndoStep& images, const LeafList& touched) {
  const LevelStack& stack = target.stack;
  const LevelPlaces places = with_images(stack, symmetry, reached_by(stack, touched));
  if (!was_symmetric(target, symmetry, {stack, stroke, images}, places)) return false;
  Symmetriser(target, symmetry, places).run();
  return true;
}

LeafList leaves_that_see(const LevelStack& stack, const LeafList& changed) {
  LeafList leaves = reached_by(stack, changed);
  for (const auto& [level, place] : changed) {
    if (level == stack.top()) continue;
    const int above = level + 1;
    for_each_required_place(place,
                            [&](const Coord& coarse) { leaves.emplace_back(above, coarse); });
  }
  std::sort(leaves.begin(), leaves.end());
  leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
  return leaves;
}

}  // namespace argil
