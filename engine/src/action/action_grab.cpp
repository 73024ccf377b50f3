// SPDX-License-Identifier: GPL-3.0-or-later
// The push of one dab; stroke_motion.cpp adds the dabs and their images up.
#include <memory>
#include <optional>

#include "action/action.h"
#include "action/dab.h"
#include "action/drag_push.h"
#include "brush/stroke_motion.h"

namespace argil {
namespace {

/// Matter under the tool follows its path, what is farther from its middle less.
class GrabPush final : public Push {
 public:
  Vec3 at(std::size_t, const PosedTool& tool, const Vec3& point_mm) const override {
    const double falloff = tool.falloff(point_mm);
    if (falloff <= 0.0) return {};
    return falloff * way_of(tool);
  }
  std::optional<Vec3> way(const PosedTool& tool) const override { return way_of(tool); }
};

}  // namespace

std::unique_ptr<const Push> grab_push() { return std::make_unique<GrabPush>(); }

void actions::grab(EditTarget& target, const Tool& tool, std::span<const Dab> path,
                   std::size_t images) {
  if (path.empty()) return;
  move_along(target, posed_along(tool, path), images,
             level_of_tool(target.stack, smallest_radius(tool)), GrabPush());
}

}  // namespace argil
