// SPDX-License-Identifier: GPL-3.0-or-later
// The target is the tool's level averaged over 5^3 nodes; displacing towards it by its own distance
// is a step of curvature flow.
#include <cmath>
#include <memory>
#include <utility>

#include "action/action.h"
#include "brush/displace.h"
#include "brush/local_field.h"

namespace argil {
namespace {

/// The tool's level averaged twice with (1, 2, 1)/4 along each axis.
LocalField averaged_field(const LevelEdit& level, const Box3& bounds_mm) {
  // Two passes, trilinear reading, and the ends of the lines, which stay.
  constexpr int kSmoothMargin = 4;
  LocalField target = local_field(level, bounds_mm, kSmoothMargin);
  average_twice(target);
  return target;
}

/// Draws the surface to where the averaged field is zero, by that field's own distance.
class SmoothLaw final : public MoveLaw {
 public:
  SmoothLaw(LocalField target, double weight, DisplaceStep step)
      : target_(std::move(target)), weight_(static_cast<float>(weight)), step_(step) {}

  void moves(std::size_t, const LeafFeet& feet, LeafMoves& out) const override {
    read_at_feet(target_, feet, {}, out);
    for_each_pulled(
        feet, [&](std::size_t n) { out.mm[n] *= step_.part_of(weight_ * feet.rows.pull[n]); });
  }

 private:
  LocalField target_;
  float weight_;
  DisplaceStep step_;
};

}  // namespace

void actions::smooth(EditTarget& target, DabImages images, int tool_level) {
  // One field for all images, so that those which overlap are drawn to the same target.
  const Box3 bounds = bounds_of(images);
  // Averages of averages go on like heat: so much per length of path, in passes of at most the
  // whole.
  const double weight = images.front().strength() * images.front().dab().quarters;
  const double passes = std::ceil(weight);
  for (double pass = 0.0; pass < passes; pass += 1.0) {
    displace_in_steps(target, images, tool_level, [&](Edit& edit, DisplaceStep step) {
      return std::make_unique<SmoothLaw>(averaged_field(edit.level(tool_level), bounds),
                                         weight / passes, step);
    });
  }
}

}  // namespace argil
