// SPDX-License-Identifier: GPL-3.0-or-later
#include "field/level_reader.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>

namespace argil {
namespace {

/// How near to the surface layers and windows ask, in voxels.
constexpr float kAsked = 2.62F;
constexpr float kDiagonal = 1.7320509F;

std::size_t size_of(const NodeBox& box) noexcept {
  const auto n = box.sides();
  return static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1]) *
         static_cast<std::size_t>(n[2]);
}

/// Calls visit(row, node) for each row along z of a part of a box; `row` is where the block of the
/// box has it.
template <class Visit>
void for_each_row(const NodeBox& box, const NodeBox& part, const Visit& visit) {
  const auto n = box.sides();
  for (int x = part.low.x(); x <= part.high.x(); ++x) {
    for (int y = part.low.y(); y <= part.high.y(); ++y) {
      const Coord node(x, y, part.low.z());
      const Coord at = node - box.low;
      visit((static_cast<std::size_t>(at.x()) * static_cast<std::size_t>(n[1]) +
             static_cast<std::size_t>(at.y())) *
                    static_cast<std::size_t>(n[2]) +
                static_cast<std::size_t>(at.z()),
            node);
    }
  }
}

void fill_part(const NodeBox& box, const NodeBox& part, float value, std::span<float> out) {
  const auto row = static_cast<std::size_t>(part.sides()[2]);
  for_each_row(box, part, [&](std::size_t at, const Coord&) { std::fill_n(&out[at], row, value); });
}

/// Whether all values are on one side, none of them within `band`.
bool is_beyond(std::span<const float> values, float band) {
  const bool is_inside = values.front() < 0.0F;
  return std::ranges::all_of(
      values, [&](float value) { return (value < 0.0F) == is_inside && std::abs(value) >= band; });
}

}  // namespace

LevelReader::LevelReader(const LevelStack& stack)
    : stack_(&stack), scratch_(static_cast<std::size_t>(stack.count())) {
  finders_.reserve(static_cast<std::size_t>(stack.count()));
  for (int level = 0; level < stack.count(); ++level) finders_.emplace_back(stack, level);
}

/// The finest coarser level that has a leaf around a node; beyond the top, none has.
int LevelReader::level_above(int level, const Coord& node) {
  int above = level + 1;
  while (above < stack_->count() && leaf(above, node >> (above - level)) == nullptr) ++above;
  return above;
}

/// Whether the nodes of the level `above` in a leaf, on one side of the surface, are so far from it
/// that none between them is within what layers and windows ask for.
bool LevelReader::is_far_above(int level, int above, const Coord& origin) {
  const int shift = above - level;
  const Coord low = origin >> shift;
  const float* values = values_of(*leaf(above, low));
  const int side = std::max(kLeafSide >> shift, 1);
  const float between = kDiagonal * (1.0F - 1.0F / static_cast<float>(1 << std::min(shift, 8)));
  const float far = kAsked * static_cast<float>(stack_->voxel_mm(level)) +
                    between * static_cast<float>(stack_->voxel_mm(above));
  float least = std::numeric_limits<float>::infinity();
  float most = -least;
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) {
      const float* row = values + leaf_offset(low.offsetBy(x, y, 0));
      for (int z = 0; z < side; ++z) {
        least = std::min(least, row[z]);
        most = std::max(most, row[z]);
      }
    }
  }
  return least >= far || most <= -far;
}

LevelReader::Reading LevelReader::look(int level, const Coord& origin) {
  if (leaf(level, origin) != nullptr) return {level, false};
  const int above = level_above(level, origin);
  if (above > stack_->top()) return {stack_->top(), true};
  return {above, is_far_above(level, above, origin)};
}

float LevelReader::far_value(int level, const Coord& origin) const {
  const int top = stack_->top();
  const float tile = stack_->grid(top).tree().getValue(origin >> (top - level));
  return tile < 0.0F ? -stack_->band_mm(level) : stack_->band_mm(level);
}

LevelReader::Reading LevelReader::read(int level, const NodeBox& box, std::span<float> out) {
  assert(stack_->is_level(level) && out.size() == size_of(box));
  Reading all{level, true};
  for_each_leaf_origin({box.low, box.high}, [&](const Coord& origin) {
    const Reading found = read_part(level, box, part_of(box, origin), out);
    all.coarsest = std::max(all.coarsest, found.coarsest);
    all.is_far &= found.is_far;
  });
  all.is_far = all.is_far && is_beyond(out, stack_->band_mm(level));
  return all;
}

/// The part of a box that lies in one leaf.
LevelReader::Reading LevelReader::read_part(int level, const NodeBox& box, const NodeBox& part,
                                            std::span<float> out) {
  if (const VdbLeaf* found = leaf(level, part.low)) {
    const float* values = values_of(*found);
    const auto row = static_cast<std::size_t>(part.sides()[2]);
    for_each_row(box, part, [&](std::size_t at, const Coord& node) {
      std::memcpy(&out[at], values + leaf_offset(node), row * sizeof(float));
    });
    return {level, false};
  }
  return interpolate(level, box, part, out);
}

LevelReader::Reading LevelReader::interpolate(int level, const NodeBox& box, const NodeBox& part,
                                              std::span<float> out) {
  const Coord origin = leaf_origin(part.low);
  const int above = level_above(level, origin);
  if (above > stack_->top()) {
    fill_part(box, part, far_value(level, origin), out);
    return {stack_->top(), true};
  }
  const float band = stack_->band_mm(level);
  if (is_far_above(level, above, origin)) {
    const float value =
        values_of(*leaf(above, origin >> (above - level)))[leaf_offset(origin >> (above - level))];
    fill_part(box, part, std::copysign(band, value), out);
    return {above, true};
  }
  const double ratio = std::ldexp(1.0, level - above);
  const NodeBox support = resample_support(part, ratio);
  Scratch& scratch = scratch_[static_cast<std::size_t>(level)];
  scratch.coarse.resize(size_of(support));
  const Reading coarse = read(above, support, scratch.coarse);
  if (is_beyond(scratch.coarse, band)) {
    fill_part(box, part, std::copysign(band, scratch.coarse.front()), out);
    return {coarse.coarsest, true};
  }
  scratch.fine.resize(size_of(part));
  const auto crease = static_cast<float>(kCreasedVoxels * stack_->voxel_mm(above));
  resample(scratch.coarse, support, ratio, part, crease, scratch.fine, scratch.resample);
  const float* from = scratch.fine.data();
  const auto row = static_cast<std::size_t>(part.sides()[2]);
  for_each_row(box, part, [&](std::size_t at, const Coord&) {
    std::copy_n(from, row, &out[at]);
    from += row;
  });
  return {coarse.coarsest, false};
}

}  // namespace argil
