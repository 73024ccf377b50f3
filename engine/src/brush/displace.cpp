// SPDX-License-Identifier: GPL-3.0-or-later
// Every node takes the displacement of the surface point nearest to it, which its own value and
// gradient tell. Values are read from the stack and written to the edit, so all nodes see the level
// as it was before the step.
#include "brush/displace.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "edit/redistance.h"
#include "field/halo.h"
#include "field/parallel.h"

namespace argil {
namespace {

/// The point of the surface nearest to a node within the band; the node itself where the field does
/// not tell, in the middle of something thin.
Vec3 nearest_on_surface(const LeafHalo& value, std::size_t n, const Vec3& point_mm, float band) {
  assert(std::abs(value[n]) < band);
  const float here = value[n];
  Vec3 rise;
  for (std::size_t a = 0; a < 3; ++a) {
    const float low = value[n - kHaloStride[a]];
    const float high = value[n + kHaloStride[a]];
    const bool is_low = std::abs(low) < band;  // not so for NaN
    const bool is_high = std::abs(high) < band;
    float step = 0.0F;
    if (is_low && is_high) {
      step = 0.5F * (high - low);
    } else if (is_high) {
      step = high - here;
    } else if (is_low) {
      step = here - low;
    }
    rise[a] = static_cast<double>(step);
  }
  const double voxel = static_cast<double>(band) / kHalfWidthVoxels;
  const double steep = length(rise);
  if (steep < 0.5 * voxel) return point_mm;
  return point_mm - (static_cast<double>(here) / steep) * rise;
}

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
      : level_(level), images_(images), law_(law), pull_(pull), bounds_(bounds_of(images)) {
    const Mask* mask = level.stack().mask();
    if (mask != nullptr && !mask->is_zero_in(bounds_)) mask_ = mask;
  }

  /// The farthest a node would have moved.
  double apply(LeafEdit& leaf) const {
    const double voxel = level_.voxel_mm();
    const auto band = static_cast<double>(level_.band_mm());
    const Vec3 first = node_mm(leaf.origin, voxel);
    const double side = (kLeafSide - 1) * voxel;
    const std::vector<std::size_t> near = images_near(first, side, band);
    if (near.empty()) return 0.0;
    LeafHalo value = with_halo(level_.stack(), level_.level(), leaf.origin);
    if (!leaf.existed) overlay_leaf(leaf.before(), value);
    const double most = kVoxelsPerStep * voxel;
    double largest = 0.0;
    rewrite_nodes(
        leaf, voxel, level_.band_mm(), [&](std::size_t node, const Vec3& point, float before) {
          if (std::abs(static_cast<double>(before)) >= band) return before;
          if (!overlaps(bounds_, point, point, std::abs(static_cast<double>(before)))) {
            return before;
          }
          const Vec3 foot = nearest_on_surface(value, halo_index(node), point, level_.band_mm());
          const double move = move_at(near, foot, point);
          largest = std::max(largest, std::abs(move));
          return before + static_cast<float>(std::clamp(move, -most, most));
        });
    return largest;
  }

 private:
  struct Pull {
    std::size_t image = 0;
    double strength = 0.0;
  };

  /// Those that reach what is nearest to the nodes of a leaf: of a whole stroke few.
  std::vector<std::size_t> images_near(const Vec3& first, double side, double band) const {
    std::vector<std::size_t> near;
    for (std::size_t i = 0; i < images_.size(); ++i) {
      if (overlaps(images_[i].bounds_mm(), first, first + Vec3{side, side, side}, band)) {
        near.push_back(i);
      }
    }
    return near;
  }

  /// On a mirror plane two have the same pull, and the first counts.
  Pull strongest_pull(const std::vector<std::size_t>& near, const Vec3& point_mm) const {
    Pull strongest;
    for (const std::size_t i : near) {
      const double pull = pull_ ? pull_(images_[i], point_mm) : images_[i].falloff(point_mm);
      if (pull > strongest.strength) strongest = {i, pull};
    }
    return strongest;
  }

  /// A node that is masked itself stays, however free the surface nearest to it.
  double move_at(const std::vector<std::size_t>& near, const Vec3& place_mm,
                 const Vec3& own_mm) const {
    const Pull pull = strongest_pull(near, place_mm);
    if (pull.strength <= 0.0) return 0.0;
    const double masked = mask_ != nullptr ? std::max(mask_->at(place_mm), mask_->at(own_mm)) : 0.0;
    return masked < 1.0 ? law_(pull.image, place_mm, pull.strength * (1.0 - masked)) : 0.0;
  }

  const LevelEdit& level_;
  DabImages images_;
  const MoveLaw& law_;
  PullLaw pull_;
  Box3 bounds_;
  const Mask* mask_ = nullptr;
};

}  // namespace

float displace(LevelEdit& level, DabImages images, const MoveLaw& law, PullLaw pull) {
  assert(!images.empty() && law);
  auto& leaves = level.leaves();
  const Displacement displacement(level, images, law, pull);
  std::vector<double> largest(leaves.size(), 0.0);
  for_each_leaf(leaves.size(), [&](std::size_t n) { largest[n] = displacement.apply(leaves[n]); });
  return leaves.empty() ? 0.0F
                        : static_cast<float>(*std::max_element(largest.begin(), largest.end()));
}

void displace_in_steps(EditTarget& target, DabImages images, int tool_level,
                       const std::function<MoveLaw(Edit& edit, int steps)>& law_of) {
  int steps = 1;
  for (int step = 0; step < steps; ++step) {
    Edit edit(target);
    const int finest = plan_all(edit, target.stack, images, tool_level);
    MoveLaw law = law_of(edit, steps);
    bool is_finest_done = false;
    // How far the surface goes is known only when the law was asked; the finest leaves decide, and
    // their first step counts when one is enough.
    if (step == 0) {
      const double voxel = target.stack.voxel_mm(finest);
      const float farthest = displace(edit.level(finest), images, law);
      steps = std::min(kMostSteps, steps_of(static_cast<double>(farthest), voxel));
      is_finest_done = steps == 1;
      if (steps > 1) law = law_of(edit, steps);
    }
    for (int n = 0; n < edit.count(); ++n) {
      if (n != finest || !is_finest_done) displace(edit.level(n), images, law);
    }
    commit_displaced(target, edit);
  }
}

}  // namespace argil
