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

/// What the surface under each image is drawn to.
class Planes {
 public:
  Planes(const LevelEdit& level, DabImages images, Side side) : side_(side) {
    for (const PosedTool& image : images) {
      fields_.push_back(local_field(level, image.bounds_mm(), 2));
      planes_.push_back(plane_under(fields_.back(), image));
    }
  }

  /// What the distance at a point of the surface becomes. Only what faces as the plane does is
  /// drawn, so that the back of a thin wall stays.
  double distance_mm(std::size_t image, const Vec3& place_mm) const {
    if (!planes_[image]) return 0.0;
    const LocalPlane& plane = *planes_[image];
    const double distance = plane.distance(place_mm);
    if (side_ == Side::above && distance <= 0.0) return 0.0;
    if (side_ == Side::below && distance >= 0.0) return 0.0;
    const double facing = dot(plane.normal, fields_[image].gradient_at(place_mm));
    return std::clamp(facing, 0.0, 1.0) * distance;
  }

 private:
  Side side_;
  std::vector<LocalField> fields_;
  std::vector<std::optional<LocalPlane>> planes_;
};

/// Draws the surface to the plane that fits it under the tool.
void draw_to_plane(EditTarget& target, DabImages images, int tool_level, Side side) {
  const double weight = fraction_of(images.front());
  displace_in_steps(target, images, tool_level, [&](Edit& edit, int steps) -> MoveLaw {
    return [planes = Planes(edit.level(tool_level), images, side), weight, steps](
               std::size_t image, const Vec3& point_mm, double pull) {
      return part_of_step(weight * pull, steps) * planes.distance_mm(image, point_mm);
    };
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
