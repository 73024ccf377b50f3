// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "argil/core/vec3.h"

#include "feet/cluster_list.h"
#include "feet/placed_feet.h"
#include "field/level_stack.h"

namespace argil {

/// Feet on one side of a surface in a tree of boxes. Thread-safe.
class FeetTree {
 public:
  FeetTree() = default;
  FeetTree(std::vector<PlacedFeet> feet, const LevelStack& stack);

  bool is_empty() const noexcept { return feet_.empty(); }

  /// What collect() found, and its memory.
  struct Found {
    static constexpr int kNoLevel = 1 << 20;

    std::vector<ClusterList> lists;  ///< by level, places from the cube's centre
    float bound_mm = 0.0F;  ///< no node is farther from the surface, if less than was asked
    int finest = kNoLevel;  ///< the finest level that has any
    bool is_near = false;   ///< all nodes are nearer than `least_mm`: nothing was listed
  };

  /// The clusters of feet for the points of the surface that nodes within `half_mm` of `center_mm`
  /// along each axis may be nearest to, as far as these are not farther than `most_mm`.
  /// Cost     2 to 5 us.
  void collect(const Vec3& center_mm, double half_mm, float least_mm, float most_mm,
               Found& found) const;

 private:
  /// Boxes around up to eight parts of the tree.
  struct Branch {
    ClusterBoxes boxes;  ///< around the points of the surface below feet; the rest are empty
    Vec3 at_mm;          ///< what boxes are counted from
    std::array<float, ClusterBoxes::kClusters> apart;  ///< the most of `apart_mm_` within
    std::size_t first = 0;                             ///< child, whom the others follow
    bool has_leaves = false;                           ///< children are `feet_`, else branches
  };
  struct Part;
  struct Search;

  Part part_of(const PlacedFeet& feet) const;
  Branch branch_over(const std::vector<Part>& parts, std::size_t begin) const;
  void visit(const Branch& branch, Search& search) const;
  void take(const PlacedFeet& feet, Search& search) const;

  std::vector<PlacedFeet> feet_;
  std::vector<float> apart_mm_;   ///< how far feet are from each other, by level
  std::vector<Branch> branches_;  ///< the root last
};

}  // namespace argil
