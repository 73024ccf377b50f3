// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/measure/rim.h"

#include <cassert>
#include <cmath>
#include <utility>

namespace argil::test {

Clay rim_ball(std::optional<double> edge_radius_mm) {
  ClayOptions options{.voxel_mm = kRimVoxel};
  options.edge_radius_mm = edge_radius_mm;
  return Clay::ball(kRimBall, options).value();
}

const std::vector<Vec3>& rim_directions() {
  static const std::vector<Vec3> all{
      {0.31, -0.87, 0.38}, {0.1, -0.99, 0.05}, {0.577, -0.577, 0.577}};
  return all;
}

std::vector<RimCase> nine_rims(double tool_mm) {
  std::vector<RimCase> cases;
  for (const auto& [is_carved, off] : {std::pair{true, 0.0}, {false, 0.0}, {true, 0.6}}) {
    for (const Vec3& way : rim_directions()) {
      cases.push_back({kRimBall, normalized(way) * (kRimBall + off * tool_mm), tool_mm, is_carved});
    }
  }
  return cases;
}

Stroke dab_of(const RimCase& rim) {
  Stroke stroke;
  stroke.tool.action = rim.is_carved ? Action::carve : Action::add;
  stroke.tool.radii_mm = {rim.tool_mm, rim.tool_mm, rim.tool_mm};
  stroke.tool.strength = 1.0;
  stroke.samples.resize(1);
  stroke.samples[0].position_mm = rim.tool_at_mm;
  return stroke;
}

double rms_between(const RimMeasure& a, const RimMeasure& b) {
  assert(a.beyond.size() == b.beyond.size());
  double sum = 0.0;
  for (std::size_t n = 0; n < a.beyond.size(); ++n) {
    sum += (a.beyond[n] - b.beyond[n]) * (a.beyond[n] - b.beyond[n]);
  }
  return std::sqrt(sum / static_cast<double>(a.beyond.size()));
}

}  // namespace argil::test
