// SPDX-License-Identifier: GPL-3.0-or-later
#include "edit/stroke_start.h"

#include <algorithm>
#include <cassert>

#include "field/sampling.h"
#include "field/upsample.h"

namespace argil {

const SavedLeaf* StrokeStart::saved(int level, const Coord& node) const {
  const auto found = step_.find({level, leaf_origin(node)});
  return found == step_.end() ? nullptr : &found->second;
}

const float* StrokeStart::values(int level, const Coord& node) const {
  if (const SavedLeaf* leaf = saved(level, node)) {
    return leaf->values != nullptr ? leaf->values->data() : nullptr;
  }
  const VdbLeaf* leaf = stack_.leaf(level, node);
  return leaf != nullptr ? values_of(*leaf) : nullptr;
}

float StrokeStart::constant(const Coord& node) const {
  const SavedLeaf* leaf = saved(top(), node);
  return leaf != nullptr ? leaf->tile : stack_.grid(top()).tree().getValue(node);
}

float StrokeStart::sample(int level, const Coord& node) const {
  return sample_of(*this, level, node);
}

void StrokeStart::read(int level, const Coord& origin, LeafValues& out) const {
  assert(is_leaf_origin(origin));
  if (const float* stored = values(level, origin)) {
    std::copy_n(stored, kLeafNodes, out.begin());
  } else if (level == top()) {
    out.fill(constant(origin));
  } else {
    upsample(gather_coarse(
                 origin, [&](const Coord& at) { return values(level + 1, at); },
                 [&](const Coord& node) { return sample(level + 1, node); }),
             out);
    clamp_to(stack_.band_mm(level), out);
  }
}

}  // namespace argil
