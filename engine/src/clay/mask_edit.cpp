// SPDX-License-Identifier: GPL-3.0-or-later
// The mask as a whole: clear, invert, blur, fill, sharpen.
#include <algorithm>
#include <array>
#include <cassert>
#include <new>
#include <vector>

#include "argil/engine/clay.h"

#include "clay/clay_access.h"
#include "clay/clay_state.h"
#include "field/mask.h"
#include "field/mask_reach.h"
#include "field/parallel.h"

namespace argil {
namespace {

/// (1, 2, 1)/4 three times.
constexpr std::array<float, 7> kBlur{1.0F / 64,  6.0F / 64, 15.0F / 64, 20.0F / 64,
                                     15.0F / 64, 6.0F / 64, 1.0F / 64};
constexpr int kBlurReach = 3;
constexpr int kBlurSide = kLeafSide + 2 * kBlurReach;

/// Exact, and twice is as before: values are multiples of 2^-20.
std::shared_ptr<Mask> inverted(const Mask& from) {
  auto mask = std::make_shared<Mask>(from.voxel_mm(), 1.0F - from.elsewhere());
  for (const Coord& origin : from.sorted_origins()) {
    const float* values = from.leaf(origin);
    if (values == nullptr) {
      mask->put(origin, 1.0F - from.constant(origin));
      continue;
    }
    LeafValues free;
    std::transform(values, values + kLeafNodes, free.begin(), [](float v) { return 1.0F - v; });
    mask->put(origin, free);
  }
  return mask;
}

/// Averages along the middle index of `in`, seen as [outer][kBlurSide][inner].
void blur_along(const std::vector<float>& in, std::size_t inner, std::vector<float>& out) {
  assert(in.size() % (kBlurSide * inner) == 0);
  const std::size_t outer = in.size() / (kBlurSide * inner);
  out.assign(outer * kLeafSide * inner, 0.0F);
  for (std::size_t o = 0; o < outer; ++o) {
    for (std::size_t n = 0; n < kLeafSide; ++n) {
      for (std::size_t tap = 0; tap < kBlur.size(); ++tap) {
        const float* from = in.data() + (o * kBlurSide + n + tap) * inner;
        float* to = out.data() + (o * kLeafSide + n) * inner;
        for (std::size_t i = 0; i < inner; ++i) to[i] += kBlur[tap] * from[i];
      }
    }
  }
}

/// One axis after the other, each pass leaving out the border that the next needs no more.
LeafValues blurred_leaf(const Mask& mask, const Coord& origin) {
  std::vector<float> nodes;
  nodes.reserve(kBlurSide * kBlurSide * kBlurSide);
  const Coord low = origin.offsetBy(-kBlurReach);
  mask.read({low, low.offsetBy(kBlurSide - 1)}, nodes);
  std::vector<float> planes;
  std::vector<float> rows;
  blur_along(nodes, kBlurSide * kBlurSide, planes);
  blur_along(planes, kBlurSide, rows);
  blur_along(rows, 1, planes);
  LeafValues values;
  std::transform(planes.begin(), planes.end(), values.begin(),
                 [](float v) { return std::clamp(v, 0.0F, 1.0F); });
  return values;
}

/// One value in a leaf and all around it: an average changes nothing.
bool is_uniform_around(const Mask& mask, const Coord& origin) {
  bool is_uniform = true;
  openvdb::CoordBBox around(origin, origin);
  around.expand(kLeafSide);
  for_each_leaf_origin(around, [&](const Coord& near) {
    is_uniform =
        is_uniform && mask.leaf(near) == nullptr && mask.constant(near) == mask.constant(origin);
  });
  return is_uniform;
}

/// Leaves that hold a border and those around them; far from the surface only those that count node
/// by node already.
std::vector<Coord> leaves_to_blur(const LevelStack& stack, const Mask& mask) {
  std::vector<Coord> origins;
  for (const Coord& kept : mask.sorted_origins()) {
    openvdb::CoordBBox around(kept, kept);
    around.expand(kLeafSide);
    for_each_leaf_origin(around, [&](const Coord& origin) { origins.push_back(origin); });
  }
  std::sort(origins.begin(), origins.end());
  origins.erase(std::unique(origins.begin(), origins.end()), origins.end());
  std::vector<char> counts(origins.size(), 0);
  for_each_leaf(origins.size(), [&](std::size_t n) {
    const bool counts_by_node =
        mask.leaf(origins[n]) != nullptr || is_near_surface(stack, origins[n]);
    counts[n] = counts_by_node && !is_uniform_around(mask, origins[n]) ? 1 : 0;
  });
  std::vector<Coord> chosen;
  for (std::size_t n = 0; n < origins.size(); ++n) {
    if (counts[n] != 0) chosen.push_back(origins[n]);
  }
  return chosen;
}

/// Refuses what would take more than is left.
void need(std::int64_t bytes, std::int64_t free_bytes) {
  if (bytes > free_bytes) throw OverLimit(bytes);
}

std::shared_ptr<Mask> blurred(const LevelStack& stack, const Mask& from, std::int64_t free_bytes) {
  const std::vector<Coord> origins = leaves_to_blur(stack, from);
  need(from.bytes() + static_cast<std::int64_t>(origins.size() * sizeof(LeafValues)), free_bytes);
  std::vector<LeafValues> values(origins.size());
  for_each_leaf(origins.size(), [&](std::size_t n) { values[n] = blurred_leaf(from, origins[n]); });
  std::shared_ptr<Mask> mask = from.copy();
  for (std::size_t n = 0; n < origins.size(); ++n) mask->put(origins[n], values[n]);
  return mask;
}

/// Twice as steep about a half, node by node: the border stays where it is.
std::shared_ptr<Mask> sharpened(const Mask& from) {
  const auto steeper = [](float value) { return std::clamp(2.0F * value - 0.5F, 0.0F, 1.0F); };
  auto mask = std::make_shared<Mask>(from.voxel_mm(), steeper(from.elsewhere()));
  for (const Coord& origin : from.sorted_origins()) {
    const float* values = from.leaf(origin);
    if (values == nullptr) {
      mask->put(origin, steeper(from.constant(origin)));
      continue;
    }
    LeafValues sharp;
    std::transform(values, values + kLeafNodes, sharp.begin(), steeper);
    mask->put(origin, sharp);
  }
  return mask;
}

/// Null where nothing is masked. The mask as it was stays for undo, so a new one is all added.
std::shared_ptr<Mask> edited(const LevelStack& stack, MaskEdit edit, std::int64_t free_bytes) {
  const Mask nothing(kMaskVoxels * stack.voxel_mm(0), 0.0F);
  const Mask& now = stack.mask() != nullptr ? *stack.mask() : nothing;
  std::shared_ptr<Mask> mask;
  if (edit == MaskEdit::invert) {
    need(now.bytes(), free_bytes);
    mask = inverted(now);
  }
  if (edit == MaskEdit::blur) mask = blurred(stack, now, free_bytes);
  if (edit == MaskEdit::sharpen) {
    need(now.bytes(), free_bytes);
    mask = sharpened(now);
  }
  if (edit == MaskEdit::fill) mask = std::make_shared<Mask>(now.voxel_mm(), 1.0F);
  return mask != nullptr && mask->is_nothing() ? nullptr : mask;
}

}  // namespace

Result<void> Clay::apply(MaskEdit edit) {
  if (edit < MaskEdit::clear || edit > MaskEdit::sharpen) {
    return Error{ErrorKind::bad_input, "the mask edit has the number " +
                                           std::to_string(static_cast<int>(edit)) +
                                           "; must be clear, invert, blur, fill or sharpen"};
  }
  return ClayAccess::change_mask(*this, [edit](const LevelStack& stack, std::int64_t free_bytes) {
    return edited(stack, edit, free_bytes);
  });
}

Result<void> ClayAccess::change_mask(Clay& clay, const MaskMaker& make) {
  Clay::State& state = *clay.state_;
  const ChangingCall call(state.user);
  if (state.open) return stroke_is_open();
  try {
    auto mask = make(*state.levels, state.free_bytes());
    state.history.make_room();
    state.push_undo(FormerMask{state.levels->exchange_mask(std::move(mask))});
    return {};
  } catch (const std::bad_alloc& fault) {
    return out_of_memory(fault, "change the mask");
  }
}

double Clay::mask_at(const Vec3& point_mm) const {
  const Mask* mask = levels().mask();
  const double most = kMaxNode * options().voxel_mm;
  const auto is_within = [&](double c) { return c >= -most && c <= most; };
  if (mask == nullptr) return 0.0;
  if (!is_within(point_mm.x) || !is_within(point_mm.y) || !is_within(point_mm.z)) {
    return static_cast<double>(mask->elsewhere());
  }
  return mask->at(point_mm);
}

bool Clay::has_mask() const noexcept { return levels().mask() != nullptr; }

}  // namespace argil
