// SPDX-License-Identifier: GPL-3.0-or-later
// The push of one dab; stroke_motion.cpp adds the dabs and their images up.
#include <memory>

#include "action/action.h"
#include "action/dab.h"
#include "action/drag_push.h"
#include "brush/stroke_motion.h"

namespace argil {
namespace {

/// What the turn of the tool about its z axis moves a point by: back from where it is by the whole
/// turn, so that it is exact for the middle and smooth to none at the edge. Mirrored images turn
/// the other way round. A quaternion (1, t) stands for the turn by 2 atan t: no sine, so no
/// library's bits.
Vec3 turn(const PosedTool& tool, const Vec3& point_mm) {
  const double falloff = tool.falloff(point_mm);
  if (falloff <= 0.0) return {};
  const Dab& dab = tool.dab();
  const double path = length(dab.at.position_mm - dab.from.position_mm);
  const double sign = dab.is_mirrored ? -1.0 : 1.0;
  const double angle = sign * tool.strength() * falloff * path / tool.smallest_radius_mm();
  const Vec3 axis = (-0.5 * angle) * rotate(dab.at.orientation, Vec3{0.0, 0.0, 1.0});
  const Vec3 from = point_mm - dab.at.position_mm;
  return from - rotate(normalized(Quat{1.0, axis.x, axis.y, axis.z}), from);
}

class TwistPush final : public Push {
 public:
  Vec3 at(std::size_t, const PosedTool& tool, const Vec3& point_mm) const override {
    return turn(tool, point_mm);
  }
};

}  // namespace

std::unique_ptr<const Push> twist_push() { return std::make_unique<TwistPush>(); }

void actions::twist(EditTarget& target, const Tool& tool, std::span<const Dab> path,
                    std::size_t images) {
  if (path.empty()) return;
  move_along(target, posed_along(tool, path), images,
             level_of_tool(target.stack, smallest_radius(tool)), TwistPush());
}

}  // namespace argil
