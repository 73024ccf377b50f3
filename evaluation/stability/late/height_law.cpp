// SPDX-License-Identifier: GPL-3.0-or-later
#include "stability/late/height_law.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "argil/haptics/force/closed_force.h"

namespace argil::evaluation {
namespace {

constexpr double kTableStepMm = 0.005;

/// The mean density under the kernel, whose slice at height z weighs (1 - z^2)^5.
double density_of(double height_mm, double reach_mm, double skin_mm) {
  constexpr int kSlices = 20;
  double sum = 0.0;
  double all = 0.0;
  for (int i = -kSlices; i <= kSlices; ++i) {
    const double z = static_cast<double>(i) / kSlices;
    const double weight = std::pow(1.0 - z * z, 5.0);
    all += weight;
    sum += weight * std::max(0.0, 1.0 - (height_mm + z * reach_mm) / skin_mm);
  }
  return sum / all;
}

}  // namespace

HeightLaw::HeightLaw(const LateTool& tool)
    : tool_(tool),
      least_mm_(tool.is_spring() ? -60.0 : -4.0 * tool.radius_mm - 30.0),
      most_mm_(tool.is_spring() ? 1.0
                                : haptics::kKernelSupport * tool.radius_mm + tool.skin_mm + 1.0) {
  double height = least_mm_;
  while (height <= most_mm_) {
    tool.is_spring() ? add_spring(height) : add_ball(height);
    height += kTableStepMm;
  }
  for (std::size_t i = 0; i < table_.size(); ++i) {
    const std::size_t before = i > 0 ? i - 1 : i;
    const std::size_t after = std::min(i + 1, table_.size() - 1);
    table_[i].slope_n_per_mm = (table_[before].force_n - table_[after].force_n) /
                               (kTableStepMm * static_cast<double>(after - before));
  }
}

void HeightLaw::add_ball(double height_mm) {
  const haptics::ForceMaterial material = material_of(tool_);
  haptics::ForceTool tool;
  tool.radii_mm = {tool_.radius_mm, tool_.radius_mm, tool_.radius_mm};
  tool.position_mm.y = height_mm;
  const haptics::ForceResult felt = haptics::plane_force({0.0, 1.0, 0.0}, 0.0, tool, material);
  const double density =
      density_of(height_mm, haptics::kKernelSupport * tool_.radius_mm, tool_.skin_mm);
  table_.push_back({felt.contact_n.y, felt.energy_nmm, 0.0,
                    material.viscosity_force_n * material.viscosity_s_per_mm * density});
}

void HeightLaw::add_spring(double height_mm) {
  const double depth_mm = std::max(0.0, -height_mm);
  const double n_per_mm = 1e-3 * tool_.spring_n_per_m;
  table_.push_back({n_per_mm * depth_mm, 0.5 * n_per_mm * depth_mm * depth_mm, 0.0, 0.0});
}

HeightLaw::Felt HeightLaw::at(double height_mm) const noexcept {
  const double last = static_cast<double>(table_.size()) - 1.001;
  const double place = std::clamp((height_mm - least_mm_) / kTableStepMm, 0.0, last);
  const auto i = static_cast<std::size_t>(place);
  const double part = place - static_cast<double>(i);
  const auto between = [&](double Felt::*value) {
    return std::lerp(table_[i].*value, table_[i + 1].*value, part);
  };
  return {between(&Felt::force_n), between(&Felt::energy_mj), between(&Felt::slope_n_per_mm),
          between(&Felt::drag_n_s_per_mm)};
}

double HeightLaw::height_mm(double force_n) const noexcept {
  assert(force_n > 0.0);
  double low = least_mm_;
  double high = most_mm_;
  for (int halving = 0; halving < 50; ++halving) {
    const double middle = 0.5 * (low + high);
    (at(middle).force_n > force_n ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace argil::evaluation
