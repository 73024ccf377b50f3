// SPDX-License-Identifier: GPL-3.0-or-later
// Planning asks the levels for leaves, not for nodes: a dab of a small tool touches a few dozen.
#include "brush/dab_plan.h"

#include <cassert>
#include <cmath>

#include "edit/redistance.h"
#include "edit/restriction.h"
#include "field/mask.h"
#include "field/prolongation.h"

namespace argil {

using openvdb::CoordBBox;

int level_of_tool(const LevelStack& stack, double smallest_radius_mm) {
  assert(std::isfinite(smallest_radius_mm));
  int level = 0;
  while (level < stack.top() && 8.0 * stack.voxel_mm(level + 1) <= smallest_radius_mm) ++level;
  return level;
}

int level_of_shape(const LevelStack& stack, const Tool& tool, double shrunk_radius_mm) {
  double detail = 1.0;
  if (tool.action == Action::trim) {
    detail = 0.5;
  } else if (tool.shape == Shape::box || tool.shape == Shape::mesh) {
    detail = 0.125;
  }
  return level_of_tool(stack, detail * shrunk_radius_mm);
}

Box3 bounds_of(DabImages images) {
  Box3 box;
  for (const PosedTool& image : images) {
    box.include(image.bounds_mm().min);
    box.include(image.bounds_mm().max);
  }
  return box;
}

CoordBBox nodes_in(const Box3& box_mm, double voxel_mm) {
  const Vec3 lo = box_mm.min / voxel_mm;
  const Vec3 hi = box_mm.max / voxel_mm;
  return {Coord::floor(openvdb::Vec3d(lo.x, lo.y, lo.z)),
          Coord::ceil(openvdb::Vec3d(hi.x, hi.y, hi.z))};
}

std::vector<Coord> origins_in(const CoordBBox& nodes) {
  std::vector<Coord> origins;
  for_each_leaf_origin(nodes, [&](const Coord& origin) { origins.push_back(origin); });
  return origins;
}

/// Asks the tree for its lowest inner nodes (16^3 leaves each) and these for their leaves: a box
/// may span millions of leaves of which few are stored.
std::vector<Coord> leaves_in(const LevelStack& stack, int level, const CoordBBox& nodes) {
  using Parent = openvdb::FloatTree::RootNodeType::ChildNodeType::ChildNodeType;
  const CoordBBox origins(leaf_origin(nodes.min()), leaf_origin(nodes.max()));
  const auto& tree = stack.grid(level).tree();
  std::vector<Coord> found;
  const int side = static_cast<int>(Parent::DIM);
  const Coord low = origins.min() & ~(side - 1);
  for (int x = low.x(); x <= origins.max().x(); x += side) {
    for (int y = low.y(); y <= origins.max().y(); y += side) {
      for (int z = low.z(); z <= origins.max().z(); z += side) {
        const auto* parent = tree.probeConstNode<Parent>(Coord(x, y, z));
        if (parent == nullptr) continue;
        for (auto leaf = parent->cbeginChildOn(); leaf; ++leaf) {
          if (origins.isInside(leaf.getCoord())) found.push_back(leaf.getCoord());
        }
      }
    }
  }
  return found;
}

/// A map and not a sorted list: the same neighbours are met many times.
std::vector<Coord> finer_origins(const LevelStack& stack, int level, const CoordBBox& nodes) {
  const CoordBBox origins(leaf_origin(nodes.min()), leaf_origin(nodes.max()));
  LeafMap<std::uint8_t> about;
  for (const Coord& origin : leaves_in(stack, level, nodes)) {
    CoordBBox around(origin, origin);
    around.expand(kLeafSide);
    around.intersect(origins);
    for_each_leaf_origin(around, [&](const Coord& near) { about.at(near) = 1; });
  }
  std::vector<Coord> found;
  about.for_each([&](const Coord& origin, std::uint8_t) { found.push_back(origin); });
  return found;
}

/// Two tests, the cheap one first: where the mask is steep, then whether the surface is near there.
std::vector<Coord> border_origins(const LevelStack& stack, int level, const CoordBBox& nodes) {
  assert(stack.mask() != nullptr && level < stack.top());
  // A border less wide than so many voxels of a level is too sharp for it.
  constexpr double kBorderVoxels = 3.0;
  const double voxel = stack.voxel_mm(level);
  Box3 box;
  box.include(node_mm(nodes.min(), voxel));
  box.include(node_mm(nodes.max(), voxel));
  const double slope = 1.0 / (kBorderVoxels * stack.voxel_mm(level + 1));
  std::vector<Coord> origins;
  for (const Coord& steep : stack.mask()->steep_leaves(box, slope)) {
    const Coord last = steep.offsetBy(kLeafSide - 1);
    CoordBBox reached(steep >> std::max(level - 1, 0), last >> std::max(level - 1, 0));
    if (level == 0) reached = CoordBBox(steep << 1, (last << 1).offsetBy(1));
    reached.intersect(nodes);
    if (reached.empty()) continue;
    for_each_leaf_origin(reached, [&](const Coord& origin) { origins.push_back(origin); });
  }
  std::sort(origins.begin(), origins.end());
  origins.erase(std::unique(origins.begin(), origins.end()), origins.end());
  const float band = stack.band_mm(level);
  const auto is_off_surface = [&](const Coord& origin) {
    const CoarseNodes coarse = coarse_nodes(stack, level + 1, origin);
    return std::none_of(coarse.begin(), coarse.end(),
                        [&](float value) { return std::abs(value) < band; });
  };
  origins.erase(std::remove_if(origins.begin(), origins.end(), is_off_surface), origins.end());
  return origins;
}

namespace {

/// Whether a tool pulls at anything that is nearest to a node of a leaf, judged by a ball around
/// its path.
bool reaches_leaf(const LevelStack& stack, const PosedTool& image, int level, const Coord& origin) {
  const double voxel = stack.voxel_mm(level);
  const double half = 0.5 * (kLeafSide - 1) * voxel;
  const Vec3 middle = node_mm(origin, voxel) + Vec3{half, half, half};
  const Vec3& from = image.dab().from.position_mm;
  const Vec3& at = image.dab().at.position_mm;
  const Vec3& radii = image.radii_mm();
  const double reach = 0.5 * length(at - from) +
                       image.reach() * std::max({radii.x, radii.y, radii.z}) +
                       std::sqrt(3.0) * half + static_cast<double>(stack.band_mm(level));
  return length(middle - 0.5 * (from + at)) <= reach;
}

}  // namespace

bool may_have_band(const LevelStack& stack, int level, const Coord& origin) {
  if (stack.has_leaf(level, origin)) return true;
  if (level == stack.top()) return false;
  const float band = stack.band_mm(level);
  return may_coarse_be_below(stack, level + 1, origin, 1.0F, band) &&
         may_coarse_be_below(stack, level + 1, origin, -1.0F, band);
}

int plan_displaced(Edit& edit, const LevelStack& stack, DabImages images, int tool_level) {
  assert(!images.empty());
  int finest = tool_level;
  for (const PosedTool& image : images) {
    const auto takes_part = [&](int level, const Coord& origin) {
      return reaches_leaf(stack, image, level, origin) && may_have_band(stack, level, origin);
    };
    finest = std::min(finest, want_reached(edit, stack, image.bounds_mm(), tool_level, takes_part));
  }
  edit.load();
  return finest;
}

/// From the finest level up, since each coarser one is restricted from the finer before it is
/// solved.
void solve_stamped(Edit& edit) {
  for (int n = 0; n < edit.count(); ++n) {
    LevelEdit& level = edit.level(n);
    level.mark_changes();
    if (n > 0) edit.restrict_to(n, RestrictedLeaves::all);
    redistance(level, Seeds::normalise);
  }
}

int steps_of(double move_mm, double voxel_mm) {
  assert(std::isfinite(move_mm) && voxel_mm > 0.0);
  const double steps = std::ceil(std::abs(move_mm) / (kVoxelsPerStep * voxel_mm));
  return std::max(1, static_cast<int>(steps));
}

/// 1 - (1 - s)^q, so that dabs of any spacing cover as much of the distance per length of path.
double fraction_of(const PosedTool& tool) {
  const double strength = std::abs(tool.strength());
  assert(strength <= 1.0);
  const double quarters = tool.dab().quarters;
  return quarters == 1.0 ? strength : 1.0 - std::pow(1.0 - strength, quarters);
}

}  // namespace argil
