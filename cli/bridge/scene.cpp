// SPDX-License-Identifier: GPL-3.0-or-later
// A scene of the Falcon report at the bridge: felt itself, in the device's frame.
#include "bridge/scene.h"

#include <cassert>

#include "argil/haptics/rig/rig.h"
#include "argil/haptics/scene/scene_catalogue.h"
#include "argil/haptics/simulation/sim_falcon.h"

#include "common/hand_option.h"
#include "play/scene_play.h"

namespace argil::cli::bridge {
namespace {

const haptics::SceneEntry& entry_of(const BridgeOptions& options) {
  const haptics::SceneEntry* entry = haptics::find_scene(options.scene);
  assert(entry != nullptr);
  return *entry;
}

haptics::SceneValues values_of(const BridgeOptions& options) {
  return scene_values(entry_of(options).parameters, options.settings);
}

}  // namespace

Result<void> check_own_force(const BridgeOptions& options) {
  haptics::RigOptions rig;
  rig.coupling_stiffness_n_per_m = options.spring.stiffness_n_per_m;
  rig.position_filter = options.feel.filter();
  if (options.scene.empty()) {
    rig.tool = options.clay.tool;
    rig.material = options.clay.material;
    rig.mix = options.feel.mix;
    rig.mix_ramp_s = options.feel.mix_ramp_s;
    rig.placement.scale = options.scale;
  } else {
    rig.scene = options.scene;
    rig.scene_settings = options.settings;
  }
  return haptics::check_rig(rig);
}

std::unique_ptr<haptics::ForceScene> make_scene(const BridgeOptions& options) {
  return options.scene.empty() ? nullptr : entry_of(options).make(values_of(options));
}

std::vector<haptics::HandKey> scene_motion(const BridgeOptions& options) {
  assert(options.hand < kHands.size());
  const haptics::DeviceTraits traits = haptics::traits_of(haptics::FalconModel(), kTickS);
  ScenePlayer player;
  player.hand = kHands[options.hand];
  player.spring_n_per_m = governed_spring_n_per_m(options.spring.stiffness_n_per_m,
                                                  traits.damping_n_s_per_m, kTickS, traits.delay_s);
  return after_wait(play_scene(entry_of(options), values_of(options), player).plan,
                    haptics::ServoOptions().safety.ramp_in_s);
}

Json scene_json(const BridgeOptions& options) {
  if (options.scene.empty()) return {};
  const haptics::SceneValues values = values_of(options);
  Json settings = Json::object();
  for (const haptics::SceneParameter& parameter : values.parameters()) {
    settings[parameter.name] = values[parameter.name];
  }
  return {{"name", options.scene}, {"settings", std::move(settings)}};
}

}  // namespace argil::cli::bridge
