// SPDX-License-Identifier: GPL-3.0-or-later
// Every node takes the displacement of the surface point nearest to it, its foot, which its own
// value and gradient tell. Values are read from the stack and written to the edit, so all nodes see
// the level as it was before the step. A leaf is worked on row by row (rows/rows.h).
#include "brush/displace.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "edit/redistance.h"
#include "field/halo.h"
#include "field/nesting.h"
#include "field/parallel.h"

namespace argil {
namespace {

/// Whether a box meets the box from `low` to `high`, grown by a margin.
bool overlaps(const Box3& box, const Vec3& low, const Vec3& high, double margin) {
  for (std::size_t a = 0; a < 3; ++a) {
    if (box.min[a] > high[a] + margin || box.max[a] < low[a] - margin) return false;
  }
  return true;
}

/// What one leaf is displaced by.
class Displacement {
 public:
  Displacement(const LevelEdit& level, DabImages images, const MoveLaw& law, PullLaw pull)
      : level_(level), images_(images), law_(law), pull_(pull) {
    const Mask* mask = level.stack().mask();
    if (mask != nullptr && !mask->is_zero_in(bounds_of(images))) mask_ = mask;
  }

  /// The farthest a node would have moved.
  float apply(LeafEdit& leaf) const {
    LeafFeet feet;
    feet.voxel_mm = level_.voxel_mm();
    feet.origin_mm = node_mm(leaf.origin, feet.voxel_mm);
    const std::vector<std::size_t> near = images_near(feet);
    if (near.empty() || !has_band(leaf.before(), level_.band_mm())) return 0.0F;
    HaloBlock value;
    gather_halo(level_.stack(), level_.level(), leaf.origin, value);
    if (!leaf.existed) set_own(leaf.before(), value);
    row_loops().find_feet(value, static_cast<float>(feet.voxel_mm), level_.band_mm(), feet.rows);
    law_.shift_feet(near, feet);
    LeafMoves moves;
    return find_moves(leaf, near, feet, moves) ? add(leaf, feet, moves) : 0.0F;
  }

 private:
  /// Those that reach what is nearest to the nodes of a leaf: of a whole stroke few.
  std::vector<std::size_t> images_near(const LeafFeet& feet) const {
    const double side = (kLeafSide - 1) * feet.voxel_mm;
    const auto band = static_cast<double>(level_.band_mm());
    std::vector<std::size_t> near;
    for (std::size_t i = 0; i < images_.size(); ++i) {
      if (overlaps(images_[i].bounds_mm(), feet.origin_mm, feet.origin_mm + Vec3{side, side, side},
                   band)) {
        near.push_back(i);
      }
    }
    return near;
  }

  /// What all images do; false when none does anything. Where several pull, the strongest counts:
  /// on a mirror plane two have the same pull, and there the first.
  bool find_moves(const LeafEdit& leaf, const std::vector<std::size_t>& near, LeafFeet& feet,
                  LeafMoves& moves) const {
    if (near.size() == 1) {
      if (!pull_at(near.front(), feet)) return false;
      mask_pulls(leaf, feet);
      law_.moves(near.front(), feet, moves);
      return true;
    }
    std::vector<LeafValues> pulls(near.size());
    bool is_pulled = false;
    for (std::size_t i = 0; i < near.size(); ++i) {
      is_pulled = pull_at(near[i], feet) || is_pulled;
      for (std::size_t n = 0; n < kLeafNodes; ++n) {
        pulls[i][n] = feet.rows.at.is_asked[n / kRowNodes] ? feet.rows.pull[n] : 0.0F;
      }
    }
    if (!is_pulled) return false;
    keep_strongest(pulls);
    moves.mm.fill(0.0F);
    std::array<bool, kLeafRows> moved{};
    for (std::size_t i = 0; i < near.size(); ++i)
      add_moves(leaf, near[i], pulls[i], feet, moves, moved);
    std::copy(moved.begin(), moved.end(), feet.rows.at.is_asked);
    return true;
  }

  bool pull_at(std::size_t image, LeafFeet& feet) const {
    law_.pull(image, images_[image], pull_, feet);
    return std::any_of(feet.rows.at.is_asked, feet.rows.at.is_asked + kLeafRows,
                       [](bool is) { return is; });
  }

  static void keep_strongest(std::vector<LeafValues>& pulls) {
    for (std::size_t n = 0; n < kLeafNodes; ++n) {
      std::size_t strongest = 0;
      for (std::size_t i = 1; i < pulls.size(); ++i) {
        if (pulls[i][n] > pulls[strongest][n]) strongest = i;
      }
      for (std::size_t i = 0; i < pulls.size(); ++i) {
        if (i != strongest) pulls[i][n] = 0.0F;
      }
    }
  }

  /// What one of several images does where it is the strongest.
  void add_moves(const LeafEdit& leaf, std::size_t image, const LeafValues& pull, LeafFeet& feet,
                 LeafMoves& moves, std::array<bool, kLeafRows>& moved) const {
    for (std::size_t row = 0; row < kLeafRows; ++row) {
      const float* first = pull.data() + row * kRowNodes;
      feet.rows.at.is_asked[row] =
          std::any_of(first, first + kRowNodes, [](float each) { return each > 0.0F; });
      if (feet.rows.at.is_asked[row])
        std::copy_n(first, kRowNodes, feet.rows.pull + row * kRowNodes);
    }
    mask_pulls(leaf, feet);
    LeafMoves own;
    law_.moves(image, feet, own);
    for (std::size_t n = 0; n < kLeafNodes; ++n) {
      if (!feet.rows.at.is_asked[n / kRowNodes]) continue;
      moves.mm[n] += own.mm[n];
      moved[n / kRowNodes] = true;
    }
  }

  /// A node that is masked itself stays, however free the surface nearest to it.
  void mask_pulls(const LeafEdit& leaf, LeafFeet& feet) const {
    if (mask_ == nullptr) return;
    for (std::size_t n = 0; n < kLeafNodes; ++n) {
      if (!feet.rows.at.is_asked[n / kRowNodes] || feet.rows.pull[n] <= 0.0F) continue;
      const Vec3 node = node_mm(node_of(leaf.origin, n), feet.voxel_mm);
      const double masked = std::max(mask_->at(feet.point_mm(n)), mask_->at(node));
      feet.rows.pull[n] *= static_cast<float>(1.0 - std::min(masked, 1.0));
    }
  }

  /// Nodes outside the band stay.
  float add(LeafEdit& leaf, const LeafFeet& feet, const LeafMoves& moves) const {
    const auto most = static_cast<float>(kVoxelsPerStep * feet.voxel_mm);
    LeafValues now;
    std::copy_n(leaf.before(), kLeafNodes, now.begin());
    const float largest = row_loops().displace(moves.mm.data(), feet.rows.at.is_asked,
                                               level_.band_mm(), most, now.data());
    leaf.write_all(now);
    return largest;
  }

  const LevelEdit& level_;
  DabImages images_;
  const MoveLaw& law_;
  PullLaw pull_;
  const Mask* mask_ = nullptr;
};

}  // namespace

float displace(LevelEdit& level, DabImages images, const MoveLaw& law, PullLaw pull) {
  assert(!images.empty());
  auto& leaves = level.leaves();
  const Displacement displacement(level, images, law, pull);
  std::vector<float> largest(leaves.size(), 0.0F);
  for_each_leaf(leaves.size(), [&](std::size_t n) { largest[n] = displacement.apply(leaves[n]); });
  return leaves.empty() ? 0.0F : *std::max_element(largest.begin(), largest.end());
}

namespace {

std::unique_ptr<Edit> planned(EditTarget& target, DabImages images, int tool_level) {
  auto edit = std::make_unique<Edit>(target);
  plan_displaced(*edit, target.stack, images, tool_level);
  return edit;
}

/// How many steps a displacement by this far takes on the finest level under the tool.
int steps_to_go(Edit& edit, const LevelStack& stack, double farthest_mm) {
  for (int n = 0; n < edit.count(); ++n) {
    const std::vector<LeafEdit>& leaves = edit.level(n).leaves();
    const bool is_here = std::any_of(leaves.begin(), leaves.end(),
                                     [](const LeafEdit& leaf) { return leaf.existed; });
    if (is_here) return std::min(steps_of(farthest_mm, stack.voxel_mm(n)), kMostSteps);
  }
  return 1;
}

/// Displaces all levels. Returns how many steps it would have taken on the level where it goes the
/// most voxels.
int displace_all(Edit& edit, const LevelStack& stack, DabImages images, const MoveLaw& law) {
  int wanted = 1;
  for (int n = 0; n < edit.count(); ++n) {
    const float farthest = displace(edit.level(n), images, law);
    wanted = std::max(wanted, steps_of(static_cast<double>(farthest), stack.voxel_mm(n)));
  }
  return std::min(wanted, kMostSteps);
}

}  // namespace

void displace_in_steps(EditTarget& target, DabImages images, int tool_level,
                       const LawMaker& law_of) {
  const LevelStack& stack = target.stack;
  std::unique_ptr<Edit> edit = planned(target, images, tool_level);
  std::unique_ptr<MoveLaw> law = law_of(*edit, {});
  int steps = 1;
  if (const std::optional<double> farthest = law->farthest_mm()) {
    steps = steps_to_go(*edit, stack, *farthest);
  } else {
    // How far the surface goes is known only when the law was asked.
    steps = displace_all(*edit, stack, images, *law);
    if (steps == 1) return commit_displaced(target, *edit);
    edit = nullptr;
  }
  std::vector<Box3> reached;
  for (const PosedTool& image : images) reached.push_back(image.bounds_mm());
  for (int step = 0; step < steps; ++step) {
    if (edit == nullptr) edit = planned(target, images, tool_level);
    law = law_of(*edit, {step, steps});
    displace_all(*edit, stack, images, *law);
    commit_displaced(target, *edit);
    edit = nullptr;
    // What moved is a distance again before the next step: else the surface leaves its band.
    if (step + 1 < steps) flush_queue(target, reached);
  }
}

}  // namespace argil
