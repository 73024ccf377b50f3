// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <vector>

#include "action.h"
#include "mask.h"

namespace argil {
namespace {

openvdb::CoordBBox nodes_in(const Box3& box_mm, double voxel_mm) {
  const Vec3 lo = box_mm.min / voxel_mm;
  const Vec3 hi = box_mm.max / voxel_mm;
  return {Coord::floor(openvdb::Vec3d(lo.x, lo.y, lo.z)),
          Coord::ceil(openvdb::Vec3d(hi.x, hi.y, hi.z))};
}

std::vector<Coord> places_under(DabImages images, double voxel_mm) {
  std::vector<Coord> places;
  for (const PosedTool& image : images) {
    for_each_place(nodes_in(image.bounds_mm(), voxel_mm),
                   [&](const Coord& place) { places.push_back(place); });
  }
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

/// What becomes of one place.
struct Painted {
  LeafValues values;
  bool is_changed = false;
};

/// The images that reach a place.
std::vector<const PosedTool*> images_at(const Coord& place, double voxel_mm, DabImages images) {
  std::vector<const PosedTool*> reaching;
  const openvdb::CoordBBox box(place, place.offsetBy(kLeafSide - 1));
  for (const PosedTool& image : images) {
    if (box.hasOverlap(nodes_in(image.bounds_mm(), voxel_mm))) reaching.push_back(&image);
  }
  return reaching;
}

/// Far from the surface the value in the middle stands for the place. Where images overlap the
/// largest falloff counts, so that their order does not.
void paint_place(const LevelStack& stack, const Mask& mask, const Coord& place, DabImages images,
                 Painted& out) {
  const double weight = images.front().strength() * images.front().dab().quarters;
  const auto reaching = images_at(place, mask.voxel_mm(), images);
  const auto painted = [&](float before, const Coord& node) {
    double falloff = 0.0;
    for (const PosedTool* image : reaching) {
      falloff = std::max(falloff, image->falloff(place_mm(node, mask.voxel_mm())));
    }
    return static_cast<float>(std::clamp(static_cast<double>(before) + weight * falloff, 0.0, 1.0));
  };
  const float* before = mask.leaf(place);
  const float constant = mask.constant(place);
  if (before == nullptr && !is_near_surface(stack, place)) {
    const float value = painted(constant, place.offsetBy(kLeafSide / 2));
    out.values.fill(value);
    out.is_changed = value != constant;
    return;
  }
  for (int n = 0; n < kLeafNodes; ++n) {
    const float was = before != nullptr ? before[n] : constant;
    const float value = painted(was, place.offsetBy(n >> 6, (n >> 3) & 7, n & 7));
    out.values[static_cast<std::size_t>(n)] = value;
    out.is_changed = out.is_changed || value != was;
  }
}

}  // namespace

void paint_mask(EditTarget& target, DabImages images) {
  LevelStack& stack = target.stack;
  const double voxel = kMaskVoxels * stack.voxel_mm(0);
  const std::vector<Coord> places = places_under(images, voxel);
  const auto bytes = static_cast<std::int64_t>(places.size() * sizeof(Painted));
  if (bytes > target.free_bytes) throw OverLimit(bytes);
  Mask& mask = stack.mask_to_change();
  std::vector<Painted> painted(places.size());
  for_each_leaf(places.size(),
                [&](std::size_t n) { paint_place(stack, mask, places[n], images, painted[n]); });
  for (std::size_t n = 0; n < places.size(); ++n) {
    if (!painted[n].is_changed) continue;
    target.mask_sink(places[n], mask.leaf(places[n]), mask.constant(places[n]));
    mask.put(places[n], painted[n].values);
  }
  stack.drop_mask_of_nothing();
}

}  // namespace argil
