// SPDX-License-Identifier: GPL-3.0-or-later
#include "dab_plan.h"

#include <cassert>
#include <cmath>

#include "extend.h"
#include "mask.h"
#include "restriction.h"

namespace argil {

using openvdb::CoordBBox;

CoordBBox reached_nodes(const Box3& bounds_mm, double voxel_mm) {
  assert(is_finite(bounds_mm.min) && is_finite(bounds_mm.max));  // no number of a node else
  const Vec3 lo = bounds_mm.min / voxel_mm;
  const Vec3 hi = bounds_mm.max / voxel_mm;
  CoordBBox box(Coord::floor(openvdb::Vec3d(lo.x, lo.y, lo.z)),
                Coord::ceil(openvdb::Vec3d(hi.x, hi.y, hi.z)));
  box.expand(kReach + 1);
  return box;
}

Box3 bounds_of(DabImages images) {
  Box3 box;
  for (const PosedTool& image : images) {
    box.include(image.bounds_mm().min);
    box.include(image.bounds_mm().max);
  }
  return box;
}

std::vector<Coord> places_in(const CoordBBox& nodes) {
  std::vector<Coord> places;
  for_each_place(nodes, [&](const Coord& place) { places.push_back(place); });
  return places;
}

std::vector<Coord> leaves_in(const LevelStack& stack, int level, const CoordBBox& nodes) {
  using Parent = openvdb::FloatTree::RootNodeType::ChildNodeType::ChildNodeType;
  const CoordBBox places(place_of(nodes.min()), place_of(nodes.max()));
  const auto& tree = stack.grid(level).tree();
  std::vector<Coord> found;
  const int side = static_cast<int>(Parent::DIM);
  const Coord low = places.min() & ~(side - 1);
  for (int x = low.x(); x <= places.max().x(); x += side) {
    for (int y = low.y(); y <= places.max().y(); y += side) {
      for (int z = low.z(); z <= places.max().z(); z += side) {
        const auto* parent = tree.probeConstNode<Parent>(Coord(x, y, z));
        if (parent == nullptr) continue;
        for (auto leaf = parent->cbeginChildOn(); leaf; ++leaf) {
          if (places.isInside(leaf.getCoord())) found.push_back(leaf.getCoord());
        }
      }
    }
  }
  return found;
}

std::vector<Coord> finer_places(const LevelStack& stack, int level, const CoordBBox& nodes) {
  const CoordBBox places(place_of(nodes.min()), place_of(nodes.max()));
  PlaceMap<std::uint8_t> about;
  for (const Coord& place : leaves_in(stack, level, nodes)) {
    CoordBBox around(place, place);
    around.expand(kLeafSide);
    around.intersect(places);
    for_each_place(around, [&](const Coord& near) { about.at(near) = 1; });
  }
  std::vector<Coord> found;
  about.for_each([&](const Coord& place, std::uint8_t) { found.push_back(place); });
  return found;
}

std::vector<Coord> border_places(const LevelStack& stack, int level, const CoordBBox& nodes) {
  // A border less wide than so many voxels of a level is too sharp for it.
  constexpr double kBorderVoxels = 3.0;
  const double voxel = stack.voxel_mm(level);
  Box3 box;
  box.include(place_mm(nodes.min(), voxel));
  box.include(place_mm(nodes.max(), voxel));
  const double slope = 1.0 / (kBorderVoxels * stack.voxel_mm(level + 1));
  std::vector<Coord> places;
  for (const Coord& steep : stack.mask()->steep_places(box, slope)) {
    const Coord last = steep.offsetBy(kLeafSide - 1);
    CoordBBox reached(steep >> std::max(level - 1, 0), last >> std::max(level - 1, 0));
    if (level == 0) reached = CoordBBox(steep << 1, (last << 1).offsetBy(1));
    reached.intersect(nodes);
    if (reached.empty()) continue;
    for_each_place(reached, [&](const Coord& place) { places.push_back(place); });
  }
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  const float band = stack.band_mm(level);
  const auto is_off_surface = [&](const Coord& place) {
    const CoarseNodes coarse = coarse_nodes(stack, level + 1, place);
    return std::none_of(coarse.begin(), coarse.end(),
                        [&](float value) { return std::abs(value) < band; });
  };
  places.erase(std::remove_if(places.begin(), places.end(), is_off_surface), places.end());
  return places;
}

int plan_all(Edit& edit, const LevelStack& stack, DabImages images, int tool_level) {
  int finest = tool_level;
  for (const PosedTool& image : images) {
    finest = std::min(finest, want_reached(edit, stack, image.bounds_mm(), tool_level,
                                           [](int, const Coord&) { return true; }));
  }
  edit.load();
  return finest;
}

void solve_stamped(Edit& edit) {
  for (int n = 0; n < edit.count(); ++n) {
    LevelEdit& level = edit.level(n);
    level.mark_changes();
    if (n > 0) edit.restrict_to(n, RestrictedLeaves::all);
    extend(level, Seeds::normalise);
  }
}

void finish(Edit& edit) {
  edit.drop_empty();
  edit.commit();
}

int steps_of(double move_mm, double voxel_mm) {
  const double steps = std::ceil(std::abs(move_mm) / (kVoxelsPerStep * voxel_mm));
  return std::max(1, static_cast<int>(steps));
}

double share_of(const PosedTool& tool) {
  const double quarters = tool.dab().quarters;
  return quarters == 1.0 ? tool.strength() : 1.0 - std::pow(1.0 - tool.strength(), quarters);
}

Pull strongest_pull(DabImages images, const Vec3& point_mm) noexcept {
  Pull pull;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const double falloff = images[i].falloff(point_mm);
    if (falloff > pull.falloff) pull = {i, falloff};
  }
  return pull;
}

}  // namespace argil
