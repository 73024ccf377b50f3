// SPDX-License-Identifier: GPL-3.0-or-later
// The push of one dab; stroke_motion.cpp adds the dabs and their images up.
//
// F. de Goes, D. L. James, "Regularized Kelvinlets: Sculpting Brushes based on Fundamental
// Solutions of Elasticity", ACM Trans. Graph. 36 (2017): the displacement of an infinite elastic
// body under a load F spread about one place, which falls off as 1/r and so never ends. With psi =
// 1/sqrt(r^2 + e^2) it is, but for a factor, curl(psi F x r) + k grad(psi F.r) with k = (1 - 2v) /
// (2 - 2v), v Poisson's ratio. Ours takes psi (1 - r^2)^3 for psi, r in radii: it ends at the
// radius, smoothly, and the curl keeps volume as before. What it pulls forward in the middle comes
// back beside.
#include <algorithm>
#include <cmath>

#include "action/action.h"
#include "action/dab.h"
#include "brush/stroke_motion.h"

namespace argil {
namespace {

/// How far matter moves along, in radii of the tool: an elastic body gives way far around.
constexpr double kElasticReach = 3.0;
/// The e of the load, as a fraction of that.
constexpr double kLoadRadius = 1.0 / 3.0;

/// The displacement at a point, both in radii, by a load that moves the middle by `way`.
Vec3 kelvinlet(const Vec3& from, const Vec3& way, double compression) {
  const double square = dot(from, from);
  if (square >= 1.0) return {};
  const double rest = 1.0 - square;
  const double s2 = square + kLoadRadius * kLoadRadius;
  const double s = std::sqrt(s2);
  const double psi = rest * rest * rest / s;
  const double slope = -(6.0 * rest * rest + psi * s / s2) / s;  // of psi, over r
  const double along = (2.0 + compression) * psi + square * slope;
  const double radial = (compression - 1.0) * slope * dot(from, way);
  return (kLoadRadius / (2.0 + compression)) * (along * way + radial * from);
}

class ElasticPush final : public Push {
 public:
  /// Traced back along the flow while the load goes back along the path: steps as long as a dab in
  /// a field that is read once would not keep volume.
  Vec3 at(std::size_t, const PosedTool& tool, const Vec3& point_mm) const override {
    if (tool.smallest_radius_mm() <= 0.0) return {};
    const Dab& dab = tool.dab();
    const Vec3 way = way_of(tool);
    const Vec3 path = dab.at.position_mm - dab.from.position_mm;
    const auto flow = [&](const Vec3& at, double back) {
      return push(tool, at - (dab.at.position_mm - back * path), way);
    };
    const Vec3 a = flow(point_mm, 0.0);
    const Vec3 b = flow(point_mm - 0.5 * a, 0.5);
    const Vec3 c = flow(point_mm - 0.5 * b, 0.5);
    const Vec3 d = flow(point_mm - c, 1.0);
    return (a + 2.0 * b + 2.0 * c + d) / 6.0;
  }

 private:
  /// An ellipsoid is a ball in space that is stretched: that keeps volume too.
  static Vec3 push(const PosedTool& tool, const Vec3& from_mm, const Vec3& way_mm) {
    const double poisson = 0.5 * tool.tool().volume_preservation;
    const double compression = (1.0 - 2.0 * poisson) / (2.0 - 2.0 * poisson);
    const Vec3 moved = kelvinlet(tool.in_radii(from_mm), tool.in_radii(way_mm), compression);
    return tool.from_radii(moved);
  }
};

}  // namespace

void actions::elastic(EditTarget& target, const Tool& tool, std::span<const Dab> path,
                      std::size_t images) {
  if (path.empty()) return;
  Tool wide = tool;
  wide.radii_mm *= kElasticReach;
  move_along(target, posed_along(wide, path), images,
             level_of_tool(target.stack, smallest_radius(tool)), ElasticPush());
}

}  // namespace argil
