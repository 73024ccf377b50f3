// SPDX-License-Identifier: GPL-3.0-or-later
// The plane is fitted again for every dab to the clay as it stands, on the tool's level; all levels
// move towards it by the same law.
#include <algorithm>
#include <optional>
#include <vector>

#include "brush/action.h"
#include "brush/displace.h"
#include "brush/local_plane.h"

namespace argil {
namespace {

/// From where the surface is drawn to the plane.
enum class Side { both, above, below };

/// Draws the surface under each image to the plane that fits it.
class PlaneLaw final : public MoveLaw {
 public:
  PlaneLaw(const LevelEdit& level, DabImages images, Side side, double weight, int steps)
      : side_(side), weight_(weight), steps_(steps) {
    for (const PosedTool& image : images) {
      fields_.push_back(local_field(level, image.bounds_mm(), 2));
      planes_.push_back(plane_under(fields_.back(), image));
    }
  }

  void moves(std::size_t image, const LeafFeet& feet, LeafMoves& out) const override {
    if (!planes_[image]) {
      for_each_pulled(feet, [&](std::size_t n) { out.mm[n] = 0.0F; });
      return;
    }
    const LocalPlane& plane = *planes_[image];
    const LeafMoves facing = facings(plane, fields_[image], feet);
    for_each_pulled(feet, [&](std::size_t n) {
      const double distance = drawn(plane.distance(feet.point_mm(n)));
      const double part = part_of_step(weight_ * static_cast<double>(feet.rows.pull[n]), steps_);
      out.mm[n] = static_cast<float>(part * distance) * std::clamp(facing.mm[n], 0.0F, 1.0F);
    });
  }

 private:
  double drawn(double distance) const noexcept {
    if (side_ == Side::above) return std::max(distance, 0.0);
    return side_ == Side::below ? std::min(distance, 0.0) : distance;
  }

  /// How far the surface faces as the plane does. Only what does is drawn, so that the back of a
  /// thin wall stays.
  static LeafMoves facings(const LocalPlane& plane, const LocalField& field, const LeafFeet& feet) {
    LeafMoves facing;
    facing.mm.fill(0.0F);
    for (std::size_t a = 0; a < 3; ++a) {
      Vec3 step;
      step[a] = field.voxel_mm;
      LeafMoves low;
      LeafMoves high;
      read_at_feet(field, feet, -step, low);
      read_at_feet(field, feet, step, high);
      const auto weight = static_cast<float>(plane.normal[a] / (2.0 * field.voxel_mm));
      for_each_pulled(feet,
                      [&](std::size_t n) { facing.mm[n] += weight * (high.mm[n] - low.mm[n]); });
    }
    return facing;
  }

  Side side_;
  double weight_;
  int steps_;
  std::vector<LocalField> fields_;
  std::vector<std::optional<LocalPlane>> planes_;
};

/// Draws the surface to the plane that fits it under the tool.
void draw_to_plane(EditTarget& target, DabImages images, int tool_level, Side side) {
  const double weight = fraction_of(images.front());
  displace_in_steps(target, images, tool_level, [&](Edit& edit, int steps) {
    return std::make_unique<PlaneLaw>(edit.level(tool_level), images, side, weight, steps);
  });
}

}  // namespace

void actions::flatten(EditTarget& target, DabImages images, int tool_level) {
  draw_to_plane(target, images, tool_level, Side::both);
}

void actions::scrape(EditTarget& target, DabImages images, int tool_level) {
  draw_to_plane(target, images, tool_level, Side::above);
}

void actions::fill(EditTarget& target, DabImages images, int tool_level) {
  draw_to_plane(target, images, tool_level, Side::below);
}

}  // namespace argil
