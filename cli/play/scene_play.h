// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "argil/core/vec3.h"
#include "argil/haptics/scene/scene_catalogue.h"
#include "argil/haptics/simulation/hand_model.h"

namespace argil::cli {

/// How a run is drawn.
enum class Figure {
  force_over_position,  ///< force against the position along `axis`, and that over time
  position_over_time,   ///< the position over time alone
  trajectory,           ///< the path of the handle over the object
};

/// What a hand does in a scene, and what is worth drawing of it. Frame: the device's, mm.
struct ScenePlay {
  std::vector<haptics::HandKey> plan;
  Figure figure = Figure::trajectory;
  std::size_t axis = 1;         ///< of force_over_position: 0 x, 1 y, 2 z
  Vec3 surface_mm;              ///< a point of the surface where the plan ends ...
  Vec3 inward{0.0, -1.0, 0.0};  ///< ... and the direction in: what depth is counted from
  std::string object;           ///< gnuplot's commands for the object, a splot last; "" none
  bool is_y_up = false;         ///< it is drawn with y upwards: its columns are z, x, y
};

/// Who plays, and what a scene is felt through: a hand, which is a spring itself, has to aim
/// farther than it gets.
struct ScenePlayer {
  haptics::Hand hand = haptics::Hand::arm;
  /// Between handle and proxy; infinite where there is none, a direct coupling. > 0.
  double spring_n_per_m = std::numeric_limits<double>::infinity();
};

/// The spring of an indirect coupling as the governor leaves it, N/m: at most `asked_n_per_m`.
///
/// Units  period_s: T, > 0. delay_s: >= 0.
double governed_spring_n_per_m(double asked_n_per_m, double device_damping_n_s_per_m,
                               double period_s, double delay_s) noexcept;

/// What a hand does in a scene of the catalogue, whose surface it finds wherever `values` put it.
ScenePlay play_scene(const haptics::SceneEntry& entry, const haptics::SceneValues& values,
                     const ScenePlayer& player);

inline constexpr double kSlideS = 2.0;

/// Comes to the first point from 5 mm off, presses 3 N, and slides along the others in `slide_s`.
struct Touch {
  Vec3 place_mm;
  Vec3 inward;  ///< unit length
};
std::vector<haptics::HandKey> slide_plan(const std::vector<Touch>& touches,
                                         double slide_s = kSlideS);

/// The same plan `wait_s` later: until then the hand stays where the plan begins, off the surface,
/// so that nothing is touched before the servo has ramped in. At least one key.
std::vector<haptics::HandKey> after_wait(std::vector<haptics::HandKey> plan, double wait_s);

}  // namespace argil::cli
