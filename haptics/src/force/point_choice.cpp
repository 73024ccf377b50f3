// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/force/point_choice.h"

#include <algorithm>

#include "force/force_law.h"
#include "force/window_field.h"

namespace argil::haptics {
namespace {

/// Parts of the bound: what point_is_enough lets pass, and what LatticeForce counts for the window.
constexpr double kEnough = 0.01;
constexpr double kInterpolated = 0.015;  // of the spacing, by the stiffness
constexpr double kTurned = 0.8;          // of the window's error over the spacing

}  // namespace

bool is_centre_enough(const FieldWindowView& window, const ForceTool& tool,
                      const ForceMaterial& material, double times) noexcept {
  ForceTool larger = tool;
  larger.radii_mm = times * tool.radii_mm;
  const Vec3& r = larger.radii_mm;
  if (tool.shape != ToolShape::ellipsoid || r.x != r.y || r.y != r.z) return false;
  // The distance alone says no at most places of most tools, and costs a tenth.
  return point_is_enough(r.x, distance_at(window, tool.position_mm), material) &&
         point_is_enough(window, larger, material);
}

ForceResult point_energy_force(const FieldWindowView& window, const ForceTool& tool,
                               const ForceMaterial& material) noexcept {
  ForceResult result;
  const FieldSample sample = sample_cubic(window, tool.position_mm);
  result.outside_window = !sample.inside;
  if (!sample.inside) return result;
  const ContactLaw law(material);
  const double u = law.density(sample.phi_mm);
  result.samples = 1;
  result.energy_nmm = law.potential_nmm(u);
  result.contact_n = law.force_n(u) * sample.gradient;
  result.stiffness_n_per_mm = law.force_rate_n_per_mm(u) * dot(sample.gradient, sample.gradient);
  result.viscosity_n =
      -(material.viscosity_s_per_mm * material.viscosity_force_n * u) * tool.velocity_mm_per_s;
  const double off_mm = window.distance_error_mm;
  result.error_n = (kEnough + kTurned * off_mm / window.voxel_mm) * length(result.contact_n) +
                   (kInterpolated * window.voxel_mm + off_mm) * result.stiffness_n_per_mm;
  return result;
}

void PointChoice::tick(const FieldWindowView& window, const ForceTool& tool,
                       const ForceMaterial& material, double elapsed_s) noexcept {
  if (is_point_) {
    look_again(window, tool, material);
    return;
  }
  const bool is_wanted = is_centre_enough(window, tool, material, kMargin);
  settled_s_ = is_wanted ? settled_s_ + std::max(0.0, elapsed_s) : 0.0;
  is_point_ = 1e3 * settled_s_ >= kSettleMs;
}

void PointChoice::look_again(const FieldWindowView& window, const ForceTool& tool,
                             const ForceMaterial& material) noexcept {
  if (!is_point_) return;
  is_point_ = is_centre_enough(window, tool, material, 1.0);
  settled_s_ = 0.0;
}

}  // namespace argil::haptics
