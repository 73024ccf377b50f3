// SPDX-License-Identifier: GPL-3.0-or-later
// Painting touches no level, so it needs neither an Edit nor redistancing: the leaves of the mask
// under the tool are computed in parallel and put back by one thread.
#include <algorithm>
#include <cassert>
#include <vector>

#include "action/action.h"
#include "brush/dab_plan.h"
#include "field/mask.h"
#include "field/mask_reach.h"
#include "field/parallel.h"

namespace argil {
namespace {

/// Sorted and without repeats: images may overlap, and a leaf is painted once.
std::vector<Coord> origins_under(DabImages images, double voxel_mm) {
  std::vector<Coord> origins;
  for (const PosedTool& image : images) {
    for_each_leaf_origin(nodes_in(image.bounds_mm(), voxel_mm),
                         [&](const Coord& origin) { origins.push_back(origin); });
  }
  std::sort(origins.begin(), origins.end());
  origins.erase(std::unique(origins.begin(), origins.end()), origins.end());
  return origins;
}

/// What becomes of one leaf of the mask.
struct Painted {
  LeafValues values;
  bool is_changed = false;
};

/// The images that reach a leaf.
std::vector<const PosedTool*> images_at(const Coord& origin, double voxel_mm, DabImages images) {
  std::vector<const PosedTool*> reaching;
  const openvdb::CoordBBox box(origin, origin.offsetBy(kLeafSide - 1));
  for (const PosedTool& image : images) {
    if (box.hasOverlap(nodes_in(image.bounds_mm(), voxel_mm))) reaching.push_back(&image);
  }
  return reaching;
}

/// Far from the surface the value in the middle stands for the whole leaf. Where images overlap the
/// largest falloff counts, so that their order does not.
void paint_leaf(const LevelStack& stack, const Mask& mask, const Coord& origin, DabImages images,
                Painted& out) {
  const double weight = images.front().strength() * images.front().dab().quarters;
  const auto reaching = images_at(origin, mask.voxel_mm(), images);
  const auto painted = [&](float before, const Coord& node) {
    double falloff = 0.0;
    for (const PosedTool* image : reaching) {
      falloff = std::max(falloff, image->falloff(node_mm(node, mask.voxel_mm())));
    }
    return static_cast<float>(std::clamp(static_cast<double>(before) + weight * falloff, 0.0, 1.0));
  };
  const float* before = mask.leaf(origin);
  const float constant = mask.constant(origin);
  if (before == nullptr && !is_near_surface(stack, origin)) {
    const float value = painted(constant, origin.offsetBy(kLeafSide / 2));
    out.values.fill(value);
    out.is_changed = value != constant;
    return;
  }
  for (int n = 0; n < kLeafNodes; ++n) {
    const float was = before != nullptr ? before[n] : constant;
    const float value = painted(was, origin.offsetBy(n >> 6, (n >> 3) & 7, n & 7));
    out.values[static_cast<std::size_t>(n)] = value;
    out.is_changed = out.is_changed || value != was;
  }
}

}  // namespace

void actions::mask(EditTarget& target, DabImages images) {
  assert(!images.empty() && target.mask_sink);
  LevelStack& stack = target.stack;
  const double voxel = kMaskVoxels * stack.voxel_mm(0);
  const std::vector<Coord> origins = origins_under(images, voxel);
  const auto bytes = static_cast<std::int64_t>(origins.size() * sizeof(Painted));
  if (bytes > target.free_bytes) throw OverLimit(bytes);
  Mask& mask = stack.mask_to_change();
  std::vector<Painted> painted(origins.size());
  for_each_leaf(origins.size(),
                [&](std::size_t n) { paint_leaf(stack, mask, origins[n], images, painted[n]); });
  for (std::size_t n = 0; n < origins.size(); ++n) {
    if (!painted[n].is_changed) continue;
    target.mask_sink(origins[n], mask.leaf(origins[n]), mask.constant(origins[n]));
    mask.put(origins[n], painted[n].values);
  }
  stack.drop_mask_of_nothing();
}

}  // namespace argil
