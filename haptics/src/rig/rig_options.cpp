// SPDX-License-Identifier: GPL-3.0-or-later
// What of a rig's options can be used.
#include <cmath>
#include <initializer_list>
#include <sstream>
#include <string>

#include "argil/haptics/rig/rig.h"
#include "argil/haptics/scene/scene_catalogue.h"
#include "argil/haptics/servo/governor.h"
#include "argil/haptics/simulation/sim_falcon.h"

#include "math/units.h"

namespace argil::haptics {
namespace {

constexpr double kMostStiffnessNPerM = 3000.0;

struct Ranged {
  const char* name;
  double value;
  double least;
  double most;
  const char* unit;
};

Error bad_input(const std::string& message) { return {ErrorKind::bad_input, message}; }

Result<void> check(std::initializer_list<Ranged> all) {
  for (const Ranged& one : all) {
    if (one.value >= one.least && one.value <= one.most) continue;  // a NaN is outside
    std::ostringstream text;
    text << one.name << " is " << one.value << one.unit << "; must be " << one.least << " to "
         << one.most << one.unit;
    return bad_input(text.str());
  }
  return {};
}

Result<void> check_falcon_period(double period_s) {
  if (period_s <= kFalconMostPeriodS) return {};
  std::ostringstream text;
  text << "period is " << kMmPerM * period_s << " ms; must be at most "
       << kMmPerM * kFalconMostPeriodS
       << " ms with a real Falcon, whose watchdog lets go of a force that is not repeated";
  return bad_input(text.str());
}

Result<void> check_simulated_hand(const RigOptions& options) {
  if (options.hand != Hand::light && options.hand != Hand::arm && options.hand != Hand::firm) {
    return bad_input("the hand must be light, arm or firm");
  }
  const Box3 reach = FalconModel().reach_mm;
  return check({{"start x", options.start_mm.x, reach.min.x, reach.max.x, " mm"},
                {"start y", options.start_mm.y, reach.min.y, reach.max.y, " mm"},
                {"start z", options.start_mm.z, reach.min.z, reach.max.z, " mm"}});
}

Result<void> check_device(const RigOptions& options) {
  if (auto good = check({{"period", kMmPerM * options.period_s, 0.25, 20.0, " ms"},
                         {"coupling stiffness", options.coupling_stiffness_n_per_m, 50.0,
                          kMostStiffnessNPerM, " N/m"}});
      !good) {
    return good;
  }
  if (options.position_filter) {
    if (auto good = validate(*options.position_filter); !good) {
      return bad_input("position filter: " + good.error().message);
    }
  }
  switch (options.device) {  // without a default, so that the compiler asks for a new one
    case RigDevice::replay:
      if (options.replay_file.empty()) return bad_input("a replay needs the file of a recording");
      return {};
    case RigDevice::falcon:
      if (auto good = check_falcon_period(options.period_s); !good) return good;
      return check_falcon(options.falcon);
    case RigDevice::sim:
      return check_simulated_hand(options);
  }
  return bad_input("the device must be sim, replay or falcon");
}

Result<void> check_tool(const ForceTool& tool) {
  constexpr double kLeastMm = 0.2;
  constexpr double kMostMm = 50.0;
  const Vec3& radii = tool.radii_mm;
  if (auto good = check({{"tool radius x", radii.x, kLeastMm, kMostMm, " mm"},
                         {"tool radius y", radii.y, kLeastMm, kMostMm, " mm"},
                         {"tool radius z", radii.z, kLeastMm, kMostMm, " mm"}});
      !good) {
    return good;
  }
  const Quat& q = tool.orientation;
  const double size = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
  if (!(std::abs(size - 1.0) < 1e-6))
    return bad_input("the tool's orientation is not of unit length");
  if (tool.shape == ToolShape::capsule && (radii.x != radii.y || radii.z < radii.x)) {
    return bad_input("a capsule's radii x and y must be equal, and z at least as much");
  }
  return {};
}

/// What the servo may count on, before the device is opened.
DeviceTraits expected_traits(const RigOptions& options) {
  DeviceTraits traits = traits_of(FalconModel(), options.period_s);
  switch (options.device) {
    case RigDevice::sim:
    case RigDevice::replay:
      break;
    case RigDevice::falcon:
      traits.damping_n_s_per_m = options.falcon.calibration.damping_n_s_per_m;
      traits.delay_s = kFalconUsualDelayS;
      break;
  }
  if (options.position_filter) {
    traits.delay_s += filter_lag_s(*options.position_filter, options.period_s);
  }
  return traits;
}

/// Nothing bounds what the direct coupling feels, so the matter itself has to be soft enough.
Result<void> check_direct(const RigOptions& options, double felt) {
  const double limit = most_direct_stiffness_n_per_m(options);
  const bool is_clay = options.scene == "clay";
  if (felt <= limit) return {};
  std::ostringstream text;
  text << (is_clay ? "the material" : "the scene '" + options.scene + "'") << " is felt as up to "
       << std::lround(felt) << " N/m, and a direct coupling is steady to " << std::lround(limit)
       << " N/m; couple indirectly" << (options.position_filter ? ", filter no positions" : "")
       << (is_clay ? ", or take a thicker skin or a smaller scale" : "");
  return bad_input(text.str());
}

Result<void> check_clay(const RigOptions& options) {
  const ForceMaterial& material = options.material;
  if (auto good = check_tool(options.tool); !good) return good;
  if (auto good =
          check({{"surface force", material.surface_force_n, 0.0, 8.0, " N"},
                 {"exponent", material.exponent, 1.0, 8.0, ""},
                 {"skin", material.skin_mm, 0.5, 50.0, " mm"},
                 {"clamp ratio", material.clamp_ratio, 1.01, 20.0, ""},
                 {"viscosity force", material.viscosity_force_n, 0.0, 8.0, " N"},
                 {"viscosity rate", material.viscosity_s_per_mm, 0.0, 1.0, " s/mm"},
                 {"mix ramp", options.mix_ramp_s, 0.0, ModeBlend::kMostRampS, " s"},
                 {"own cut", options.own_cut_mm, 0.0, 50.0, " mm"},
                 {"scale", options.placement.scale, 0.05, 20.0, " mm of clay for each mm"}});
      !good) {
    return good;
  }
  if (auto good = validate(options.mix); !good) return good;
  if (auto good = SceneValues().set_all(options.scene_settings); !good) return good;
  if (!is_finite(options.placement.offset_mm)) return bad_input("the clay's place is not a number");
  if (options.coupling != CouplingKind::direct) return {};
  // Touching, the contact counts for more than while working.
  return check_direct(options, options.placement.scale * options.mix.contact_passive *
                                   most_stiffness_n_per_m(options.material));
}

}  // namespace

double most_direct_stiffness_n_per_m(const RigOptions& options) noexcept {
  const DeviceTraits traits = expected_traits(options);
  return stiffness_limit_n_per_m(traits.damping_n_s_per_m, options.period_s, traits.delay_s);
}

double most_stiffness_n_per_m(const ForceMaterial& material) noexcept {
  // d/dx of f u^e with du/dx = 1 / skin, at u^e = clamp
  const double e = material.exponent;
  return kMmPerM * material.surface_force_n * e / material.skin_mm *
         std::pow(material.clamp_ratio, (e - 1.0) / e);
}

Result<void> check_rig(const RigOptions& options) {
  if (auto good = check_device(options); !good) return good;
  if (auto good = check_guidance(options.guidance); !good) return good;
  if (options.scene == "clay") return check_clay(options);
  const SceneEntry* scene = find_scene(options.scene);
  if (scene == nullptr) {
    std::string known = "clay";
    for (const SceneEntry& entry : scene_catalogue()) known.append(", ").append(entry.name);
    return bad_input("the scene is '" + options.scene + "'; must be one of " + known);
  }
  SceneValues values(scene->parameters);
  if (auto good = values.set_all(options.scene_settings); !good) return good;
  const Placement& placement = options.placement;
  if (placement.scale != 1.0 || placement.offset_mm != Vec3{} || placement.is_z_up) {
    return bad_input("the scene '" + options.scene +
                     "' lies in the device's frame; scale 1, no offset and no turn only");
  }
  // On a simulated Falcon a scene that vibrates does no harm, and is worth a look.
  const bool is_risky =
      options.device == RigDevice::falcon && options.coupling == CouplingKind::direct;
  return is_risky ? check_direct(options, scene->most_stiffness_n_per_m(values)) : Result<void>();
}

}  // namespace argil::haptics
