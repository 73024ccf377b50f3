// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <optional>
#include <vector>

#include "action.h"
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

  /// Only what faces as the plane does is drawn, so that the back of a thin wall stays.
  float operator()(std::size_t image, const Vec3& point_mm, float before) const {
    if (!planes_[image]) return before;
    const LocalPlane& plane = *planes_[image];
    const auto distance = static_cast<float>(plane.distance(point_mm));
    if (action_ == Action::scrape && distance <= before) return before;
    if (action_ == Action::fill && distance >= before) return before;
    const double facing = dot(plane.normal, fields_[image].gradient_at(point_mm));
    return before + static_cast<float>(std::clamp(facing, 0.0, 1.0)) * (distance - before);
  }

 private:
  Action action_;
  std::vector<LocalField> fields_;
  std::vector<std::optional<LocalPlane>> planes_;
};

}  // namespace

void flatten(EditTarget& target, DabImages images, int tool_level) {
  draw_in_steps(target, images, tool_level, share_of(images.front()),
                [&](Edit& edit) { return Planes(edit.level(tool_level), images); });
}

}  // namespace argil
