// SPDX-License-Identifier: GPL-3.0-or-later
// What all actions share: which leaves a dab may change, and how it ends.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "edit.h"
#include "mask.h"
#include "posed_tool.h"

namespace argil {

/// The images of one dab that come so near to each other that they are applied at once; most often
/// one. Never empty.
using DabImages = std::span<const PosedTool>;

/// The farthest the surface may move before distances are solved anew, in voxels of the finest leaf
/// under the tool: solving must still find it inside the band.
inline constexpr double kVoxelsPerStep = 1.5;

/// Nodes of a level that a tool with these bounds can change, directly or by solving distance anew.
openvdb::CoordBBox reached_nodes(const Box3& bounds_mm, double voxel_mm);

/// The bounds of all images.
Box3 bounds_of(DabImages images);

/// All leaf places of the node box.
std::vector<Coord> places_in(const openvdb::CoordBBox& nodes);

/// Those where the level has leaves.
std::vector<Coord> leaves_in(const LevelStack& stack, int level, const openvdb::CoordBBox& nodes);

/// Finer levels take part where they have leaves, and one leaf around, so that detail may move.
std::vector<Coord> finer_places(const LevelStack& stack, int level,
                                const openvdb::CoordBBox& nodes);

/// Places of a level where a border of the mask crosses the surface and is too sharp for the next
/// coarser level: its edge would come out as stairs.
std::vector<Coord> border_places(const LevelStack& stack, int level,
                                 const openvdb::CoordBBox& nodes);

/// Wants what a tool with these bounds reaches, as far as `takes_part(level, place)`, which several
/// threads ask, says so: on its own level and coarser ones everywhere, on finer ones about the
/// leaves there are and where the mask has a sharp border. Returns the finest level that takes part
/// under the tool.
template <class TakesPart>
int want_reached(Edit& edit, const LevelStack& stack, const Box3& bounds_mm, int tool_level,
                 const TakesPart& takes_part) {
  int finest = tool_level;
  for (int level = stack.top(); level >= 0; --level) {
    const openvdb::CoordBBox nodes = reached_nodes(bounds_mm, stack.voxel_mm(level));
    std::vector<Coord> places =
        level >= tool_level ? places_in(nodes) : finer_places(stack, level, nodes);
    if (level < tool_level && stack.mask() != nullptr) {
      const std::vector<Coord> border = border_places(stack, level, nodes);
      places.insert(places.end(), border.begin(), border.end());
    }
    if (level < tool_level && !places.empty()) finest = level;
    std::vector<std::uint8_t> takes(places.size());
    for_each_leaf(places.size(), [&](std::size_t n) { takes[n] = takes_part(level, places[n]); });
    for (std::size_t n = 0; n < places.size(); ++n) {
      if (takes[n] != 0) edit.want(level, places[n]);
    }
  }
  return finest;
}

/// Loads the edit with all that the images reach. Returns the finest level under them.
int plan_all(Edit& edit, const LevelStack& stack, DabImages images, int tool_level);

/// After an action moved the surface on the tool's level and the finer ones: the coarser ones get
/// the restriction, and all are solved outward.
void solve_stamped(Edit& edit);

/// Drops what holds nothing and writes the rest; what is not needed goes when the stroke ends.
void finish(Edit& edit);

/// How many steps a move of the surface takes, so that none exceeds kVoxelsPerStep.
int steps_of(double move_mm, double voxel_mm);

/// The share of the way to a fixed target that a dab goes: its strength for each quarter radius.
double share_of(const PosedTool& tool);

/// The image that has the most to say at a place, and how much: its falloff. On a mirror plane two
/// say as much, and the first answers.
struct Pull {
  std::size_t image = 0;
  double falloff = 0.0;
};
Pull strongest_pull(DabImages images, const Vec3& point_mm) noexcept;

/// What the mask leaves of an action at the nodes of one leaf.
class LeafMask {
 public:
  LeafMask(const Mask* mask, int level, const Coord& place)
      : holds_(mask != nullptr && mask->at_nodes(level, place, held_)) {}

  bool holds_any() const noexcept { return holds_; }
  /// 1 - m
  double free_share(std::size_t node) const noexcept {
    return holds_ ? 1.0 - static_cast<double>(held_[node]) : 1.0;
  }

 private:
  LeafValues held_;  // set where `holds_`
  bool holds_;
};

/// Calls visit(node, point_mm, before) -> float for every node of the leaf and stores the result,
/// clamped to the band, in `now`.
template <class Visit>
void rewrite_nodes(LeafEdit& leaf, double voxel_mm, float band, Visit&& visit) {
  std::size_t n = 0;
  for (int i = 0; i < kLeafSide; ++i) {
    for (int j = 0; j < kLeafSide; ++j) {
      for (int k = 0; k < kLeafSide; ++k, ++n) {
        const Vec3 point{voxel_mm * (leaf.place.x() + i), voxel_mm * (leaf.place.y() + j),
                         voxel_mm * (leaf.place.z() + k)};
        leaf.now[n] = std::clamp(visit(n, point, leaf.before[n]), -band, band);
      }
    }
  }
}

}  // namespace argil
