// SPDX-License-Identifier: GPL-3.0-or-later
// The push of one dab: as grab's, less what leads away from the form as it was when the stroke
// began. Each level set of the form slides within itself, so that the form stays and what lies on
// it moves. Blender's Slide Relax moves the vertices of a mesh within its surface; a field has
// none, and so nothing to relax.
#include <algorithm>
#include <cmath>
#include <vector>

#include "action/action.h"
#include "action/dab.h"
#include "brush/form_field.h"
#include "brush/stroke_motion.h"

namespace argil {
namespace {

class SlidePush final : public Push {
 public:
  SlidePush(const LevelStack& stack, const std::vector<PosedTool>& dabs, std::size_t images)
      : form_(stack, dabs, images) {}

  Vec3 at(std::size_t dab, const PosedTool& tool, const Vec3& point_mm) const override {
    const double falloff = tool.falloff(point_mm);
    if (falloff <= 0.0) return {};
    const FormField::Place here = form_.at(dab, point_mm);
    const double slides = falloff * near_form(here.bands);
    if (slides <= 0.0) return {};
    const Vec3 way = slides * way_of(tool);
    Vec3 push = way - part_along(here.rise, way);
    // Back onto the level set that curves away below it.
    for (int step = 0; step < 2; ++step) {
      const FormField::Place there = form_.at(dab, point_mm - push);
      const double square = dot(there.rise, there.rise);
      if (square <= kLeastRise * kLeastRise) break;
      push += ((there.bands - here.bands) * form_.band_mm() / square) * there.rise;
    }
    return shortened(push, length(way));
  }

 private:
  static constexpr double kLeastRise = 0.3;

  /// 1 near the form, 0 where its field ends.
  static double near_form(double bands) {
    const double t = std::clamp((0.85 - std::abs(bands)) / 0.35, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
  }
  static Vec3 part_along(const Vec3& rise, const Vec3& way) {
    const double square = dot(rise, rise);
    return square > 0.0 ? (dot(rise, way) / square) * rise : Vec3{};
  }
  static Vec3 shortened(const Vec3& push, double most) {
    const double far = length(push);
    return far > most ? (most / far) * push : push;
  }

  FormField form_;
};

}  // namespace

void actions::slide(EditTarget& target, const Tool& tool, std::span<const Dab> path,
                    std::size_t images) {
  if (path.empty()) return;
  const std::vector<PosedTool> dabs = posed_along(tool, path);
  const SlidePush push(target.stack, dabs, images);
  move_along(target, dabs, images, level_of_tool(target.stack, smallest_radius(tool)), push);
}

}  // namespace argil
