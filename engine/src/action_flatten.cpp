// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <optional>
#include <vector>

#include "action.h"
#include "displace.h"
#include "local_plane.h"

namespace argil {
namespace {

/// What the surface under each image is drawn to.
class Planes {
 public:
  Planes(const LevelEdit& level, DabImages images) : action_(images.front().tool().action) {
    for (const PosedTool& image : images) {
      fields_.push_back(local_field(level, image.bounds_mm(), 2));
      planes_.push_back(plane_under(fields_.back(), image));
    }
  }

  /// What the distance at a place of the surface becomes. Only what faces as the plane does is
  /// drawn, so that the back of a thin wall stays.
  double distance_mm(std::size_t image, const Vec3& place_mm) const {
    if (!planes_[image]) return 0.0;
    const LocalPlane& plane = *planes_[image];
    const double distance = plane.distance(place_mm);
    if (action_ == Action::scrape && distance <= 0.0) return 0.0;
    if (action_ == Action::fill && distance >= 0.0) return 0.0;
    const double facing = dot(plane.normal, fields_[image].gradient_at(place_mm));
    return std::clamp(facing, 0.0, 1.0) * distance;
  }

 private:
  Action action_;
  std::vector<LocalField> fields_;
  std::vector<std::optional<LocalPlane>> planes_;
};

}  // namespace

void flatten(EditTarget& target, DabImages images, int tool_level) {
  const double weight = share_of(images.front());
  displace_in_steps(target, images, tool_level, [&](Edit& edit, int steps) -> MoveLaw {
    return [planes = Planes(edit.level(tool_level), images), weight, steps](
               std::size_t image, const Vec3& place, double pull) {
      return part_of_way(weight * pull, steps) * planes.distance_mm(image, place);
    };
  });
}

}  // namespace argil
