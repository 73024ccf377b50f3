// SPDX-License-Identifier: GPL-3.0-or-later
// Flat clay in closed form: the law of a point, or of a ball by the volume force.
#include "stability/clay.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "argil/haptics/force/closed_force.h"

namespace argil::evaluation {

haptics::ForceMaterial material_of(double exponent, double slope_n_per_m) {
  assert(exponent >= 1.0 && slope_n_per_m > 0.0);
  haptics::ForceMaterial material;
  material.exponent = exponent;
  // f = f0 (1 - d/s)^e has the slope e f0 / s at the surface; 1e3 from metres to mm.
  material.skin_mm = 1e3 * exponent * material.surface_force_n / slope_n_per_m;
  return material;
}

ClayPlane::ClayPlane(double radius_mm, const haptics::ForceMaterial& material)
    : material_(material), radius_mm_(radius_mm) {
  tool_.radii_mm = {radius_mm, radius_mm, radius_mm};
}

haptics::SceneForce ClayPlane::force_at(const haptics::HandleState& handle) const noexcept {
  haptics::SceneForce felt;
  felt.force_n.y = force_n(handle.position_mm.y);
  return felt;
}

double ClayPlane::force_n(double height_mm) const noexcept {
  if (radius_mm_ > 0.0) {
    haptics::ForceTool tool = tool_;
    tool.position_mm.y = height_mm;
    return haptics::plane_force({0.0, 1.0, 0.0}, 0.0, tool, material_).contact_n.y;
  }
  const double density = std::max(0.0, 1.0 - height_mm / material_.skin_mm);
  return material_.surface_force_n *
         std::min(std::pow(density, material_.exponent), material_.clamp_ratio);
}

double ClayPlane::slope_n_per_m(double height_mm) const noexcept {
  // A thousandth of the shorter of the two lengths on which the force changes.
  const double step_mm = 1e-3 * std::min(material_.skin_mm, std::max(radius_mm_, 1.0));
  return 1e3 * (force_n(height_mm - step_mm) - force_n(height_mm + step_mm)) / (2.0 * step_mm);
}

double ClayPlane::height_mm(double force) const noexcept {
  assert(force > 0.0 && force < material_.surface_force_n * material_.clamp_ratio);
  const double reach_mm = haptics::kKernelSupport * radius_mm_ + material_.skin_mm;
  double low = -reach_mm;
  double high = reach_mm;
  // Bisection to the last bit of a double.
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (force_n(middle) > force ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace argil::evaluation
