// SPDX-License-Identifier: GPL-3.0-or-later
#include "level_edit.h"

#include <algorithm>
#include <cstring>

namespace argil {
namespace {

constexpr int kCoarseSide = 5;

/// Leaf by leaf: `values(place)` gives a leaf's values or null, and then `sample(node)` each value.
template <class Values, class Sample>
CoarseNodes gather_coarse(const Coord& fine_place, const Values& values, const Sample& sample) {
  CoarseNodes out;
  const Coord low = coarser(fine_place);
  const openvdb::CoordBBox box(low, low.offsetBy(kCoarseSide - 1));
  for_each_place(box, [&](const Coord& place) {
    const float* leaf = values(place);
    const Coord first = Coord::maxComponent(place, box.min());
    const Coord last = Coord::minComponent(place.offsetBy(kLeafSide - 1), box.max());
    for (int x = first.x(); x <= last.x(); ++x) {
      for (int y = first.y(); y <= last.y(); ++y) {
        const int row = ((x - low.x()) * kCoarseSide + y - low.y()) * kCoarseSide - low.z();
        for (int z = first.z(); z <= last.z(); ++z) {
          const Coord node(x, y, z);
          out[static_cast<std::size_t>(row + z)] =
              leaf != nullptr ? leaf[leaf_offset(node)] : sample(node);
        }
      }
    }
  });
  return out;
}

void clamp_to(float band, LeafValues& values) {
  for (float& v : values) v = v < -band ? -band : (v > band ? band : v);
}

}  // namespace

CoarseNodes coarse_nodes(const LevelStack& stack, int coarser, const Coord& place) {
  return gather_coarse(
      place,
      [&](const Coord& at) -> const float* {
        const VdbLeaf* leaf = stack.leaf(coarser, at);
        return leaf != nullptr ? leaf->buffer().data() : nullptr;
      },
      [&](const Coord& node) { return stack.sample(coarser, node); });
}

CoarseNodes coarse_nodes(const LevelEdit& coarser, const Coord& place) {
  const LevelStack& stack = coarser.stack();
  return gather_coarse(
      place,
      [&](const Coord& at) -> const float* {
        if (const LeafEdit* edit = coarser.find(at)) return edit->now.data();
        const VdbLeaf* leaf = stack.leaf(coarser.level(), at);
        return leaf != nullptr ? leaf->buffer().data() : nullptr;
      },
      [&](const Coord& node) { return stack.sample(coarser.level(), node); });
}

void upsample(const CoarseNodes& coarse, LeafValues& out) {
  const auto mid = [](float a, float b) { return 0.5F * (a + b); };
  std::array<float, 8 * 25> along_x{};
  std::array<float, 8 * 8 * 5> along_y{};
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::size_t jk = 0; jk < 25; ++jk) {
      const float a = coarse[(i / 2) * 25 + jk];
      along_x[i * 25 + jk] = i % 2 == 0 ? a : mid(a, coarse[(i / 2 + 1) * 25 + jk]);
    }
  }
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::size_t j = 0; j < 8; ++j) {
      for (std::size_t k = 0; k < 5; ++k) {
        const float a = along_x[i * 25 + (j / 2) * 5 + k];
        along_y[(i * 8 + j) * 5 + k] =
            j % 2 == 0 ? a : mid(a, along_x[i * 25 + (j / 2 + 1) * 5 + k]);
      }
    }
  }
  for (std::size_t ij = 0; ij < 64; ++ij) {
    for (std::size_t k = 0; k < 8; ++k) {
      const float a = along_y[ij * 5 + k / 2];
      out[ij * 8 + k] = k % 2 == 0 ? a : mid(a, along_y[ij * 5 + k / 2 + 1]);
    }
  }
}

void prolong_leaf(const LevelStack& stack, int level, const Coord& place, LeafValues& out) {
  if (level == stack.top()) {
    out.fill(stack.grid(level).tree().getValue(place));
    return;
  }
  upsample(coarse_nodes(stack, level + 1, place), out);
  clamp_to(stack.band_mm(level), out);
}

std::vector<LeafEdit> EditMemory::take(std::size_t count) {
  std::vector<LeafEdit> leaves;
  if (!kept_.empty()) {
    leaves = std::move(kept_.back());
    kept_.pop_back();
    leaves_ -= leaves.capacity();
  }
  leaves.clear();
  leaves.resize(count);
  return leaves;
}

void EditMemory::give(std::vector<LeafEdit>&& leaves) noexcept {
  constexpr std::size_t kMostLeaves = (std::size_t{64} << 20) / sizeof(LeafEdit);
  if (kept_.size() == kMostKept || leaves_ + leaves.capacity() > kMostLeaves) return;
  leaves_ += leaves.capacity();
  kept_.push_back(std::move(leaves));
}

LevelEdit::LevelEdit(const LevelStack& stack, EditMemory& memory, int level,
                     const std::vector<Coord>& places, const LevelEdit* coarser)
    : stack_(stack), memory_(memory), level_(level), leaves_(memory.take(places.size())) {
  for_each_leaf(places.size(), [&](std::size_t i) {
    LeafEdit& edit = leaves_[i];
    edit.place = places[i];
    const VdbLeaf* leaf = stack.leaf(level, places[i]);
    edit.existed = leaf != nullptr;
    if (leaf != nullptr) {
      std::memcpy(edit.before.data(), leaf->buffer().data(), sizeof(LeafValues));
    } else if (coarser != nullptr) {
      upsample(coarse_nodes(*coarser, places[i]), edit.before);
      clamp_to(stack.band_mm(level), edit.before);
    } else {
      prolong_leaf(stack, level, places[i], edit.before);
    }
    edit.now = edit.before;
  });
  for (std::size_t i = 0; i < places.size(); ++i) {
    index_.at(places[i]) = static_cast<std::uint32_t>(i + 1);
  }
}

LeafEdit* LevelEdit::find(const Coord& place) {
  const std::uint32_t found = index_.get(place);
  return found == 0 ? nullptr : &leaves_[found - 1];
}

const LeafEdit* LevelEdit::find(const Coord& place) const {
  const std::uint32_t found = index_.get(place);
  return found == 0 ? nullptr : &leaves_[found - 1];
}

float LevelEdit::now(const Coord& node) const {
  if (const LeafEdit* edit = find(place_of(node))) {
    return edit->now[static_cast<std::size_t>(leaf_offset(node))];
  }
  return stack_.sample(level_, node);
}

const float* LevelEdit::values_now(const Coord& place) const {
  if (const LeafEdit* edit = find(place)) return edit->present ? edit->now.data() : nullptr;
  const VdbLeaf* leaf = stack_.leaf(level_, place);
  return leaf == nullptr ? nullptr : leaf->buffer().data();
}

void copy_into_box(const Coord& place, const float* values, const openvdb::CoordBBox& box,
                   std::vector<float>& out) {
  const Coord dim = box.dim();
  const Coord lo = Coord::maxComponent(place, box.min());
  const Coord hi = Coord::minComponent(place.offsetBy(kLeafSide - 1), box.max());
  const auto run = static_cast<std::size_t>(hi.z() - lo.z() + 1);
  for (int x = lo.x(); x <= hi.x(); ++x) {
    for (int y = lo.y(); y <= hi.y(); ++y) {
      const Coord at = Coord(x, y, lo.z()) - box.min();
      const auto to = (static_cast<std::size_t>(at.x()) * static_cast<std::size_t>(dim.y()) +
                       static_cast<std::size_t>(at.y())) *
                          static_cast<std::size_t>(dim.z()) +
                      static_cast<std::size_t>(at.z());
      std::memcpy(&out[to], values + leaf_offset(Coord(x, y, lo.z())), run * sizeof(float));
    }
  }
}

void LevelEdit::gather_now(const openvdb::CoordBBox& box, std::vector<float>& out) const {
  out.resize(static_cast<std::size_t>(box.volume()));
  for_each_place(box, [&](const Coord& place) {
    LeafValues filled;
    const LeafEdit* edit = find(place);
    const float* values = edit != nullptr ? edit->now.data() : values_now(place);
    if (values == nullptr) {
      prolong_leaf(stack_, level_, place, filled);
      values = filled.data();
    }
    copy_into_box(place, values, box, out);
  });
}

void LevelEdit::mark_changes() {
  for_each_leaf(leaves_.size(), [&](std::size_t n) {
    LeafEdit& leaf = leaves_[n];
    leaf.changed = std::memcmp(leaf.now.data(), leaf.before.data(), sizeof(LeafValues)) != 0;
    if (leaf.changed) leaf.changed_nodes = changed_nodes(leaf.before.data(), leaf.now.data());
  });
}

}  // namespace argil
