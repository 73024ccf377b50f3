// SPDX-License-Identifier: GPL-3.0-or-later
// The scenes of the lab: those of haptics' catalogue, and the clay.
#include <cassert>
#include <utility>

#include "argil/haptics/scene/scene_catalogue.h"

#include "lab/lab.h"

namespace argil::cli::lab {
namespace {

ScenePlayer player_of(const LabOptions& options) {
  assert(options.hand < kHands.size() && options.rate_hz > 0.0);
  ScenePlayer player;
  player.hand = kHands[options.hand];
  if (options.coupling == 0) return player;
  player.spring_n_per_m = options.coupling_stiffness_n_per_m;
  if (!options.has_governor) return player;
  const haptics::FalconModel device =
      options.is_frictionless ? haptics::frictionless_falcon() : haptics::FalconModel();
  const double period_s = 1.0 / options.rate_hz;
  player.spring_n_per_m =
      governed_spring_n_per_m(options.coupling_stiffness_n_per_m, device.damping_n_s_per_m,
                              period_s, options.delay_ticks * period_s);
  return player;
}

std::vector<LabSceneKind> all_kinds() {
  std::vector<LabSceneKind> kinds;
  for (const haptics::SceneEntry& entry : haptics::scene_catalogue()) {
    kinds.push_back({entry.name, entry.about, entry.parameters,
                     [&entry](const LabOptions& options, const Progress&) -> Result<LabScene> {
                       haptics::SceneValues values(entry.parameters);
                       if (auto good = values.set_all(options.settings); !good) return good.error();
                       LabScene lab;
                       static_cast<ScenePlay&>(lab) = play_scene(entry, values, player_of(options));
                       lab.scene = entry.make(values);
                       return lab;
                     }});
  }
  kinds.push_back({"clay",
                   "a project, or a slab of clay: pressed, slid over, and worked with --active",
                   clay_parameters(), make_clay});
  return kinds;
}

}  // namespace

Box3 reach_along_axes(const std::vector<haptics::ServoTick>& ticks) {
  constexpr double kBesideMm = 2.0;
  Box3 reach;
  for (const haptics::ServoTick& tick : ticks) {
    if (!tick.is_ready) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Vec3 on;
      on[axis] = tick.position_mm[axis];
      const Vec3 beside = tick.position_mm - on;
      if (dot(beside, beside) <= kBesideMm * kBesideMm) reach.include(on);
    }
  }
  return reach;
}

const std::vector<LabSceneKind>& scene_kinds() {
  static const std::vector<LabSceneKind> kinds = all_kinds();
  return kinds;
}

}  // namespace argil::cli::lab
