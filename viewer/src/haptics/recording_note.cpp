// SPDX-License-Identifier: GPL-3.0-or-later
#include "haptics/recording_note.h"

#include <ostream>
#include <sstream>

namespace argil::viewer {
namespace {

void add_mix(std::ostream& words, const haptics::RigOptions& options) {
  const haptics::ForceMix& mix = options.mix;
  if (mix == haptics::ForceMix() && options.mix_ramp_s == haptics::ModeBlend::kUsualRampS) return;
  words << ", mix-passive=" << mix.contact_passive << "," << mix.viscosity_passive
        << ", mix-active=" << mix.contact_active << "," << mix.viscosity_active
        << ", mix-ramp=" << options.mix_ramp_s;
}

/// Digits enough for the same bits, as everywhere in a recording.
void add_guidance(std::ostream& words, const haptics::GuidanceOptions& guidance) {
  if (guidance.kind == haptics::GuidanceKind::none) return;
  words << ", guide=" << haptics::guidance_name(guidance.kind)
        << ", guide-stiffness=" << guidance.stiffness_n_per_m
        << ", guide-force=" << guidance.most_force_n << ", path=";
  const auto digits = words.precision(17);
  const char* before = "";
  for (const Vec3& point : guidance.path_mm) {
    words << before << point.x << " " << point.y << " " << point.z;
    before = "; ";
  }
  words.precision(digits);
}

/// The clay's, which scenes of the catalogue have not got.
void add_clay(std::ostream& words, const haptics::RigOptions& options) {
  const haptics::ForceMaterial& material = options.material;
  const Vec3& radii = options.tool.radii_mm;
  const Vec3& at = options.placement.offset_mm;
  words << ", scale=" << options.placement.scale << ", middle=" << at.x << "," << at.y << ","
        << at.z << ", tool=" << radii.x << "," << radii.y << "," << radii.z
        << ", surface-force=" << material.surface_force_n << ", exponent=" << material.exponent
        << ", skin=" << material.skin_mm << ", clamp=" << material.clamp_ratio
        << ", drag=" << material.viscosity_force_n << ", drag-rate=" << material.viscosity_s_per_mm;
}

}  // namespace

std::string recording_note(const std::string& clay, const haptics::RigOptions& options) {
  std::ostringstream words;
  words << "argil view " << clay << ", " << options.scene;
  for (const auto& [setting, value] : options.scene_settings)
    words << ", " << setting << "=" << value;
  const bool is_direct = options.coupling == haptics::CouplingKind::direct;
  words << ", coupling=" << (is_direct ? "direct" : "indirect")
        << ", stiffness=" << options.coupling_stiffness_n_per_m;
  if (options.damping == haptics::DampingKind::adaptive) words << ", damping=adaptive";
  if (options.has_vibro) words << ", vibro";
  if (options.scene == "clay") add_clay(words, options);
  add_mix(words, options);
  if (options.position_filter) {
    words << ", filter=" << options.position_filter->gain
          << ", filter-lambda=" << options.position_filter->lambda_mm;
  }
  add_guidance(words, options.guidance);
  return words.str();
}

}  // namespace argil::viewer
