// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/force/servo_force.h"

#include <algorithm>
#include <cassert>

namespace argil::haptics {
namespace {

bool same_shape(const ForceTool& a, const ForceTool& b) noexcept {
  return a.shape == b.shape && a.radii_mm == b.radii_mm;
}

}  // namespace

ServoForce::ServoForce(WindowChannel& channel, const ForceMaterial& material, ForceLaw law,
                       ForceMethod method) noexcept
    : channel_(channel), material_(material), law_(law), method_(method) {}

ServoForce::Wrench ServoForce::wrench_of(const ForceResult& result) noexcept {
  return {result.contact_n, result.viscosity_n, result.contact_nmm, result.viscosity_nmm};
}

ServoForce::Wrench ServoForce::sum(const Wrench& a, const Wrench& b, double factor) noexcept {
  return {a.contact_n + factor * b.contact_n, a.viscosity_n + factor * b.viscosity_n,
          a.contact_nmm + factor * b.contact_nmm, a.viscosity_nmm + factor * b.viscosity_nmm};
}

/// Where the tool is, with the shape that is felt.
ForceResult ServoForce::felt_on_window(const ForceTool& tool) const noexcept {
  ForceResult result;
  result.outside_window = true;
  if (!force_) return result;
  if (method_ == ForceMethod::point) {
    return point_force(channel_.read_slot().view(), tool, material_);
  }
  return force_->evaluate(channel_.read_slot().view(), tool);
}

/// Makes `force_` fit the window just read: for the new tool when the window is meant for it, else
/// for the one that is felt. A window for neither is not summed: how many nodes of it would lie
/// under the tool would have no bound.
void ServoForce::take_window(const ForceTool& tool) noexcept {
  const double voxel = channel_.read_slot().voxel_mm;
  const bool fits_new = voxel == choose_lattice(tool).voxel_mm;
  if (!fits_new && (!force_ || voxel != force_->voxel_mm())) return;
  const ForceTool& felt = fits_new ? tool : felt_tool_;
  if (force_ && force_->voxel_mm() == voxel && same_shape(felt, felt_tool_)) return;
  assert(voxel > 0.0);
  felt_tool_ = felt;
  force_.emplace(felt_tool_, material_, law_, voxel);
}

/// Takes the new window; what it changes at this pose is the step to fade out.
void ServoForce::set_up_fade(const ForceTool& tool) noexcept {
  // Where the old window still holds the tool, the old force at this very pose is known, and only
  // the change itself is faded; else the force that was felt last stands in.
  const bool had_force = force_.has_value();
  const double left = fade_left_ms_ / kFadeMs;
  const ForceResult old = felt_on_window(tool);
  const Wrench before =
      old.outside_window ? wrench_of(at(last_tool_)) : sum(wrench_of(old), step_, left);
  channel_.fetch();
  take_window(tool);
  step_ = sum(before, wrench_of(felt_on_window(tool)), -1.0);
  fade_left_ms_ = had_force ? kFadeMs : 0.0;
}

void ServoForce::begin_tick(const ForceTool& tool, double elapsed_s) noexcept {
  const bool retooled =
      force_ && !same_shape(tool, felt_tool_) && window().voxel_mm == choose_lattice(tool).voxel_mm;
  if (channel_.has_fresh() || retooled) set_up_fade(tool);
  assert(fade_left_ms_ >= 0.0 && fade_left_ms_ <= kFadeMs);
  is_fading_ = fade_left_ms_ > 0.0;
  fade_left_ms_ = std::max(0.0, fade_left_ms_ - 1e3 * std::max(0.0, elapsed_s));
  last_tool_ = tool;
}

ForceResult ServoForce::at(const ForceTool& pose) const noexcept {
  ForceResult result = felt_on_window(pose);
  if (!is_fading_) return result;
  const Wrench faded = sum(wrench_of(result), step_, fade_left_ms_ / kFadeMs);
  result.contact_n = faded.contact_n;
  result.viscosity_n = faded.viscosity_n;
  result.contact_nmm = faded.contact_nmm;
  result.viscosity_nmm = faded.viscosity_nmm;
  return result;
}

ForceResult ServoForce::tick(const ForceTool& tool, double elapsed_s) noexcept {
  begin_tick(tool, elapsed_s);
  return at(tool);
}

}  // namespace argil::haptics
