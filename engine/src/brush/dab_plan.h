// SPDX-License-Identifier: GPL-3.0-or-later
// What all actions share: which leaves a dab may change, and how it ends.
#pragma once

#include <algorithm>
#include <cassert>
#include <span>
#include <vector>

#include "edit/edit.h"
#include "edit/redistance.h"
#include "field/mask.h"
#include "field/parallel.h"
#include "tool/posed_tool.h"

namespace argil {

/// The images of one dab that come so near to each other that they are applied at once; most often
/// one. Never empty.
using DabImages = std::span<const PosedTool>;

/// The farthest the surface may move before a level is redistanced, in voxels of the finest leaf
/// under the tool: solving must still find it inside the band.
inline constexpr double kVoxelsPerStep = 1.5;

/// The finest level whose voxels a tool of this smallest radius still needs: 8 or more voxels
/// across the radius, within the levels there are.
int level_of_tool(const LevelStack& stack, double smallest_radius_mm);

/// The level for the shape of a tool shrunk to this radius: sharp edges, those of a planar cut too,
/// and the corners of a mesh are finer than its size.
int level_of_shape(const LevelStack& stack, const Tool& tool, double shrunk_radius_mm);

/// The bounds of all images.
Box3 bounds_of(DabImages images);

/// The nodes within a box, its border included.
openvdb::CoordBBox nodes_in(const Box3& box_mm, double voxel_mm);

/// The origins of all leaves, stored or not, that meet the node box.
std::vector<Coord> origins_in(const openvdb::CoordBBox& nodes);

/// Those of the leaves that the level stores.
std::vector<Coord> leaves_in(const LevelStack& stack, int level, const openvdb::CoordBBox& nodes);

/// Finer levels take part where they have leaves, and one leaf around, so that detail may move.
std::vector<Coord> finer_origins(const LevelStack& stack, int level,
                                 const openvdb::CoordBBox& nodes);

/// Leaves of a level where a border of the mask crosses the surface and is too sharp for the next
/// coarser level: its edge would come out as stairs.
std::vector<Coord> border_origins(const LevelStack& stack, int level,
                                  const openvdb::CoordBBox& nodes);

/// Wants what a tool with these bounds reaches, as far as `takes_part(level, origin)`, which
/// several threads ask, says so: on its own level and coarser ones everywhere, on finer ones about
/// the leaves there are and where the mask has a sharp border. Returns the finest level that takes
/// part under the tool.
template <class TakesPart>
int want_reached(Edit& edit, const LevelStack& stack, const Box3& bounds_mm, int tool_level,
                 const TakesPart& takes_part) {
  assert(stack.is_level(tool_level));
  int finest = tool_level;
  for (int level = stack.top(); level >= 0; --level) {
    const openvdb::CoordBBox nodes = reached_nodes(bounds_mm, stack.voxel_mm(level));
    std::vector<Coord> origins =
        level >= tool_level ? origins_in(nodes) : finer_origins(stack, level, nodes);
    if (level < tool_level && stack.mask() != nullptr) {
      const std::vector<Coord> border = border_origins(stack, level, nodes);
      origins.insert(origins.end(), border.begin(), border.end());
    }
    std::vector<std::uint8_t> takes(origins.size());
    for_each_leaf(origins.size(), [&](std::size_t n) { takes[n] = takes_part(level, origins[n]); });
    for (std::size_t n = 0; n < origins.size(); ++n) {
      if (takes[n] == 0) continue;
      edit.want(level, origins[n]);
      finest = std::min(finest, level);
    }
  }
  return finest;
}

/// False where neither a leaf nor what the coarser levels make of one has a node within the band of
/// its level.
bool may_have_band(const LevelStack& stack, int level, const Coord& origin);

/// Loads the edit with all that the images displace. Returns the finest level under them.
int plan_displaced(Edit& edit, const LevelStack& stack, DabImages images, int tool_level);

/// After an action moved the surface on the tool's level and the finer ones: the coarser ones get
/// the restriction, and all are solved outward.
void solve_stamped(Edit& edit);

/// How many steps a move of the surface takes, so that none exceeds kVoxelsPerStep.
int steps_of(double move_mm, double voxel_mm);

/// The fraction of the distance to a fixed target that a dab covers: the size of its strength
/// for each quarter radius.
double fraction_of(const PosedTool& tool);

/// What the mask leaves of an action at the nodes of one leaf.
class LeafMask {
 public:
  /// `mask` null: there is none.
  LeafMask(const Mask* mask, int level, const Coord& origin)
      : has_any_(mask != nullptr && mask->at_nodes(level, origin, mask_)) {}

  bool has_any() const noexcept { return has_any_; }
  /// 1 - m
  double free_fraction(std::size_t node) const noexcept {
    return has_any_ ? 1.0 - static_cast<double>(mask_[node]) : 1.0;
  }

 private:
  LeafValues mask_;  // set where `has_any_`
  bool has_any_;
};

}  // namespace argil
