// SPDX-License-Identifier: GPL-3.0-or-later
#include "displace.h"

#include <cmath>

#include "rim.h"
#include "settle.h"

namespace argil {
namespace {

/// The place of the surface nearest to a node within the band; the node's own where the field does
/// not tell, in the middle of something thin.
Vec3 nearest_on_surface(const LeafRim& value, std::size_t n, const Vec3& point_mm, float band) {
  const float here = value[n];
  Vec3 rise;
  for (std::size_t a = 0; a < 3; ++a) {
    const float low = value[n - kRimStride[a]];
    const float high = value[n + kRimStride[a]];
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

bool overlaps(const Box3& box, const Vec3& low, const Vec3& high, double margin) {
  for (std::size_t a = 0; a < 3; ++a) {
    if (box.min[a] > high[a] + margin || box.max[a] < low[a] - margin) return false;
  }
  return true;
}

/// What one leaf is displaced by.
class Displacement {
 public:
  Displacement(const LevelEdit& level, DabImages images, const MoveLaw& law)
      : level_(level), images_(images), law_(law), bounds_(bounds_of(images)) {
    const Mask* mask = level.stack().mask();
    if (mask != nullptr && !mask->is_zero_in(bounds_)) mask_ = mask;
  }

  /// The farthest a node would have moved.
  double apply(LeafEdit& leaf) const {
    const double voxel = level_.voxel_mm();
    const auto band = static_cast<double>(level_.band_mm());
    const Vec3 first = place_mm(leaf.place, voxel);
    const double side = (kLeafSide - 1) * voxel;
    if (!overlaps(bounds_, first, first + Vec3{side, side, side}, band)) return 0.0;
    LeafRim value = with_rim(level_.stack(), level_.level(), leaf.place);
    if (!leaf.existed) overlay_leaf(leaf.before, value);
    const double most = kVoxelsPerStep * voxel;
    double largest = 0.0;
    rewrite_nodes(
        leaf, voxel, level_.band_mm(), [&](std::size_t node, const Vec3& point, float before) {
          if (std::abs(static_cast<double>(before)) >= band) return before;
          if (!overlaps(bounds_, point, point, std::abs(static_cast<double>(before)))) {
            return before;
          }
          const double move =
              move_at(nearest_on_surface(value, rim_index(node), point, level_.band_mm()), point);
          largest = std::max(largest, std::abs(move));
          return before + static_cast<float>(std::clamp(move, -most, most));
        });
    return largest;
  }

 private:
  /// A node that is held itself stays, however free the surface nearest to it.
  double move_at(const Vec3& place_mm, const Vec3& node_mm) const {
    const Pull pull = strongest_pull(images_, place_mm);
    if (pull.falloff <= 0.0) return 0.0;
    const double held = mask_ != nullptr ? std::max(mask_->at(place_mm), mask_->at(node_mm)) : 0.0;
    return held < 1.0 ? law_(pull.image, place_mm, pull.falloff * (1.0 - held)) : 0.0;
  }

  const LevelEdit& level_;
  DabImages images_;
  const MoveLaw& law_;
  Box3 bounds_;
  const Mask* mask_ = nullptr;
};

}  // namespace

float displace(LevelEdit& level, DabImages images, const MoveLaw& law) {
  auto& leaves = level.leaves();
  const Displacement displacement(level, images, law);
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
    finish_displaced(target, edit);
  }
}

}  // namespace argil
