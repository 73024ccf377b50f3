// SPDX-License-Identifier: GPL-3.0-or-later
// Dab by dab what grab does at once: what one dab drew out the next draws on. A dab that is long
// against the tool is moved along in pieces, all resampled at once.
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "action/action.h"
#include "brush/stroke_motion.h"

namespace argil {
namespace {

/// The push of a piece, which may also draw matter to its path or away from it.
class HookPush final : public Push {
 public:
  /// `inward`: of the distance from the path, per radius of path; 0 for none.
  explicit HookPush(double inward) : inward_(inward) {}

  Vec3 at(std::size_t, const PosedTool& tool, const Vec3& point_mm) const override {
    const double falloff = tool.falloff(point_mm);
    if (falloff <= 0.0) return {};
    const Vec3 way = way_of(tool);
    if (inward_ == 0.0) return falloff * way;
    const double far = length(way);
    if (far == 0.0) return {};
    const Vec3 from = point_mm - tool.middle_mm();
    const Vec3 beside = from - (dot(from, way) / (far * far)) * way;
    double inward = inward_ * far / tool.smallest_radius_mm();
    // The nearer to the path the less, so that a tail never becomes a thread.
    if (inward > 0.0) {
      const Vec3 radii = tool.in_radii(beside);
      inward *= dot(radii, radii);
    }
    return falloff * (way - inward * beside);
  }
  std::optional<Vec3> way(const PosedTool& tool) const override {
    return inward_ == 0.0 ? std::optional(way_of(tool)) : std::nullopt;
  }

 private:
  double inward_;
};

/// A dab in pieces. Their falloff is about where each ends, as grab's: matter in the middle stays
/// there.
std::vector<PosedTool> in_pieces(DabImages images, int pieces) {
  std::vector<PosedTool> tools;
  for (int n = 0; n < pieces; ++n) {
    for (const PosedTool& image : images) {
      Tool tool = image.tool();
      tool.action = Action::grab;
      Dab dab = image.dab();
      dab.from = between(image.dab().from, image.dab().at, 1.0 * n / pieces);
      dab.at = between(image.dab().from, image.dab().at, 1.0 * (n + 1) / pieces);
      tools.emplace_back(tool, dab);
    }
  }
  return tools;
}

}  // namespace

void actions::snake_hook(EditTarget& target, DabImages images, int tool_level) {
  const PosedTool& tool = images.front();
  const double inward = 2.0 * (0.5 - tool.tool().crease_pinch_factor);
  // Shorter where both slopes add up: else the map would not be one to one.
  const double longest = (inward == 0.0 ? 0.25 : 0.125) * tool.smallest_radius_mm();
  const double path = length(way_of(tool));
  // No lattice has a node in a smaller one but by chance.
  if (path == 0.0 || tool.smallest_radius_mm() < 0.5 * target.stack.voxel_mm(0)) return;
  const int pieces = std::max(1, static_cast<int>(std::ceil(path / longest - 1e-9)));
  move_along(target, in_pieces(images, pieces), images.size(), tool_level, HookPush(inward));
}

}  // namespace argil
