// SPDX-License-Identifier: GPL-3.0-or-later
// Planes as those of fill, raised above the surface so that each dab lays something on. They are
// fitted once for all steps of a dab: else each step would raise them further.
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "action/action.h"
#include "action/dab.h"
#include "brush/displace.h"
#include "brush/plane_law.h"

namespace argil {
namespace {

/// How far the planes lie above the surface, in smallest radii: a pass of either lays on about a
/// quarter. All of a square tip pulls, so it takes less at a time.
constexpr double kClayRaise = 0.0625;
constexpr double kStripRaise = 0.03125;
/// A square tip falls off over so much along the stroke: steeper ends of dabs would show as steps.
constexpr double kLeastAlong = 0.5;

/// A square tip: its half sides are the radii x along the stroke and y across it, and z how far it
/// reaches from the plane. Level within the square less what its sides take, over which it falls
/// off as (1 - q^2)^2.
class SquareTip {
 public:
  /// `normal`: of the surface, unit. A dab without a path lies along the tool's own x axis.
  SquareTip(const PosedTool& tool, const Vec3& normal)
      : middle_(tool.middle_mm()),
        radii_(tool.radii_mm()),
        across_(tool.tool().tip_roundness),
        along_(std::max(kLeastAlong, across_)) {
    const Dab& dab = tool.dab();
    const auto in_plane = [&](const Vec3& v) { return v - dot(normal, v) * normal; };
    Vec3 along = in_plane(dab.at.position_mm - dab.from.position_mm);
    const double least = 1e-6 * tool.smallest_radius_mm();
    for (const Vec3& axis : {Vec3{1.0, 0.0, 0.0}, Vec3{0.0, 1.0, 0.0}}) {
      if (length(along) > least) break;
      along = tool.smallest_radius_mm() * in_plane(rotate(dab.at.orientation, axis));
    }
    axes_[0] = normalized(along);
    axes_[1] = cross(normal, axes_[0]);
    axes_[2] = normal;
  }

  double pull(const Vec3& point_mm) const {
    const Vec3 from = point_mm - middle_;
    Vec3 own;
    for (std::size_t a = 0; a < 3; ++a) own[a] = std::abs(dot(axes_[a], from)) / radii_[a];
    own.x = std::max(0.0, own.x - (1.0 - along_)) / along_;
    own.y = std::max(0.0, own.y - (1.0 - across_)) / across_;
    const double rest = std::max(0.0, 1.0 - dot(own, own));
    return rest * rest;
  }

 private:
  Vec3 middle_;
  Vec3 radii_;
  double across_;  ///< how wide its sides are, in half sides
  double along_;
  Vec3 axes_[3];
};

class StripLaw final : public PlaneLaw {
 public:
  StripLaw(const std::shared_ptr<const FacedPlanes>& planes, DabImages images,
           const PlaneRule& rule, DisplaceStep step)
      : PlaneLaw(planes, rule, step) {
    for (std::size_t i = 0; i < images.size(); ++i) {
      const std::optional<FacedPlane>& faced = (*planes)[i];
      tips_.emplace_back();
      if (faced) tips_.back().emplace(images[i], faced->plane.normal);
    }
  }

  void pull(std::size_t image, const PosedTool&, PullLaw, LeafFeet& feet) const override {
    const std::optional<SquareTip>& tip = tips_[image];
    set_pulls(feet, [&](const Vec3& foot_mm) { return tip ? tip->pull(foot_mm) : 0.0; });
  }

 private:
  std::vector<std::optional<SquareTip>> tips_;
};

/// Fills up to planes `raise` radii above the surface, or with a negative strength digs to some as
/// far below. `law_of(planes, rule, step)` makes the law of each step.
template <class LawOf>
void lay_on(EditTarget& target, DabImages images, int level, double raise, const LawOf& law_of) {
  const PosedTool& tool = images.front();
  const bool digs = tool.strength() < 0.0;
  // So much for each quarter radius of path, or dabs that lie closer would lay on more.
  const double above = raise * tool.dab().quarters + tool.tool().plane_offset;
  const PlaneRule rule{digs ? PlaneRule::Side::above : PlaneRule::Side::below,
                       digs ? -above : above, fraction_of(tool)};
  std::shared_ptr<const FacedPlanes> planes;
  displace_in_steps(target, images, level,
                    [&](Edit& edit, DisplaceStep step) -> std::unique_ptr<MoveLaw> {
                      if (planes == nullptr) {
                        planes = std::make_shared<const FacedPlanes>(
                            fit_planes(edit.level(level), images, rule.raise));
                      }
                      return law_of(planes, rule, step);
                    });
}

}  // namespace

void actions::clay(EditTarget& target, DabImages images, int tool_level) {
  lay_on(target, images, tool_level, kClayRaise,
         [](const auto& planes, const auto& rule, DisplaceStep step) {
           return std::make_unique<PlaneLaw>(planes, rule, step);
         });
}

void actions::clay_strips(EditTarget& target, DabImages images, int tool_level) {
  const PosedTool& tool = images.front();
  // Eight voxels or more over three times the width of the sides.
  constexpr double kSides = 3.0;
  const double detail_mm =
      std::min(1.0, kSides * tool.tool().tip_roundness) * tool.smallest_radius_mm();
  const int level = std::min(tool_level, level_of_tool(target.stack, detail_mm));
  lay_on(target, images, level, kStripRaise,
         [&](const auto& planes, const auto& rule, DisplaceStep step) {
           return std::make_unique<StripLaw>(planes, images, rule, step);
         });
}

}  // namespace argil
