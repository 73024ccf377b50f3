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

using Places = std::vector<std::vector<Coord>>;  // by level

/// The places, their images, and the coarser ones above all those.
Places with_images(const LevelStack& stack, const LatticeSymmetry& symmetry,
                   const std::vector<LeafPlace>& places) {
  std::vector<std::set<Coord>> all(static_cast<std::size_t>(stack.count()));
  for (const LeafPlace& leaf : places) {
    Coord at = leaf.place;
    for (int n = leaf.level; n < stack.count(); ++n, at = place_of(coarser(at))) {
      for (const LatticeMap& map : symmetry.maps()) {
        all[static_cast<std::size_t>(n)].insert(map.place(at));
      }
    }
  }
  Places lists;
  lists.reserve(all.size());
  for (const std::set<Coord>& set : all) lists.emplace_back(set.begin(), set.end());
  return lists;
}

/// What a step touched; what stands beside it, since the image of a node on the low side of a leaf
/// lies in the next leaf, and a level may end elsewhere now; and the finer leaves around what
/// changed, which may end on it.
std::vector<LeafPlace> reached_by(const LevelStack& stack, const UndoStep& step) {
  std::vector<LeafPlace> reached;
  for (const auto& entry : step) {
    const auto& [level, place] = entry.first;
    reached.push_back({level, place});
    const auto reach = [&](int n, const Coord& low, int side) {
      for_each_place({low, low.offsetBy(side - 1)}, [&](const Coord& beside) {
        if (stack.has_leaf(n, beside)) reached.push_back({n, beside});
      });
    };
    reach(level, place.offsetBy(-kLeafSide), 3 * kLeafSide);
    for (int octant = 1; octant < 8; ++octant) {
      reached.push_back(
          {level, place.offsetBy(octant & 4 ? -8 : 0, octant & 2 ? -8 : 0, octant & 1 ? -8 : 0)});
    }
    if (level > 0) reach(level - 1, (place << 1).offsetBy(-kLeafSide), 4 * kLeafSide);
  }
  return reached;
}

/// The leaves as they were before a step.
struct LeavesBefore {
  const LevelStack& stack;
  const UndoStep& step;

  int top() const noexcept { return stack.top(); }
  const float* values(int level, const Coord& node) const {
    const auto saved = step.find({level, place_of(node)});
    if (saved != step.end()) return saved->second.values ? saved->second.values->data() : nullptr;
    const VdbLeaf* leaf = stack.leaf(level, node);
    return leaf != nullptr ? leaf->buffer().data() : nullptr;
  }
  float constant(const Coord& node) const {
    const auto saved = step.find({top(), place_of(node)});
    return saved != step.end() ? saved->second.tile : stack.grid(top()).tree().getValue(node);
  }
};

/// But for the rounding of strokes that painted both sides.
bool is_held_alike(const LevelStack& stack, int level, const Coord& a, const Coord& b) {
  constexpr double kRounding = 1e-4;
  const Mask* mask = stack.mask();
  const double voxel = stack.voxel_mm(level);
  return mask == nullptr ||
         std::abs(mask->at(place_mm(a, voxel)) - mask->at(place_mm(b, voxel))) <= kRounding;
}

/// Whether the clay was symmetric at the places before the step, and is held symmetrically.
bool was_symmetric(const EditTarget& target, const LatticeSymmetry& symmetry, const UndoStep& step,
                   const Places& places) {
  const LevelStack& stack = target.stack;
  const LeavesBefore before{stack, step};
  const auto allowed = static_cast<float>(2.0 * target.tolerance_mm);
  std::atomic<bool> is_symmetric{true};
  for (int level = 0; level < stack.count(); ++level) {
    const std::vector<Coord>& list = places[static_cast<std::size_t>(level)];
    const auto voxel = static_cast<float>(stack.voxel_mm(level));
    for_each_leaf(list.size(), [&](std::size_t at) {
      const float* values = before.values(level, list[at]);
      for (int n = 0; values != nullptr && is_symmetric && n < kLeafNodes; ++n) {
        if (std::abs(values[n]) >= 1.5F * voxel) continue;
        const Coord node = list[at].offsetBy(n >> 6, n >> 3 & 7, n & 7);
        const bool is_close =
            std::all_of(symmetry.maps().begin(), symmetry.maps().end(), [&](const LatticeMap& map) {
              const Coord image = map.node(node);
              return std::abs(values[n] - sample_of(before, level, image)) <= allowed &&
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
  Symmetriser(EditTarget& target, const LatticeSymmetry& symmetry, Places places)
      : target_(target), stack_(target.stack), symmetry_(symmetry), places_(std::move(places)) {}

  void run() {
    for (int level = 1; level < stack_.count(); ++level) {
      rewrite(level, [&](const Coord& node, float value) { return injected(level, node, value); });
    }
    // Coarser levels first: the finer ones read them where they have no leaf.
    for (int level = stack_.top(); level >= 0; --level) make_images(level);
    for (int level = 0; level < stack_.count(); ++level) drop_others(level);
  }

 private:
  bool stands_for_all(const Coord& node) const {
    return symmetry_.representative_node(node) == node;
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
      target_.sink({level, place}, nullptr, stack_.grid(level).tree().getValue(place));
      stack_.set_leaf(level, place, values.data());
      return;
    }
    const float* now = leaf->buffer().data();
    if (std::equal(values.begin(), values.end(), now)) return;
    target_.sink(change_of_values(level, place, now, values.data()), now, 0.0F);
    stack_.rewrite_leaf(level, place, values.data());
  }

  /// Drops leaves of the level that the places which stand for theirs have not.
  void drop_others(int level) {
    for (const Coord& place : places_[static_cast<std::size_t>(level)]) {
      const VdbLeaf* leaf = stack_.leaf(level, place);
      const Coord first = symmetry_.representative_place(place);
      if (leaf == nullptr || stack_.has_leaf(level, first)) continue;
      const auto finer_present = [&](const Coord& at) { return stack_.has_leaf(level - 1, at); };
      if (level > 0 && required_by_finer(place, finer_present) &&
          sides_differ(stack_, level, place, kLeafSide)) {
        continue;
      }
      const float* values = leaf->buffer().data();
      target_.sink({level, place}, values, 0.0F);
      const float band = stack_.band_mm(level);
      stack_.erase_leaf(level, place, values[0] < 0.0F ? -band : band);
    }
  }

  EditTarget& target_;
  LevelStack& stack_;
  const LatticeSymmetry& symmetry_;
  Places places_;
};

}  // namespace

void symmetrise_all(EditTarget& target, const LatticeSymmetry& symmetry) {
  const LevelStack& stack = target.stack;
  std::vector<LeafPlace> all;
  for (int level = 0; level < stack.count(); ++level) {
    for (const Coord& place : stack.sorted_places(level)) all.push_back({level, place});
  }
  Symmetriser(target, symmetry, with_images(stack, symmetry, all)).run();
}

bool symmetrise(EditTarget& target, const LatticeSymmetry& symmetry, const UndoStep& step) {
  const LevelStack& stack = target.stack;
  Places places = with_images(stack, symmetry, reached_by(stack, step));
  if (!was_symmetric(target, symmetry, step, places)) return false;
  Symmetriser(target, symmetry, std::move(places)).run();
  return true;
}

}  // namespace argil
