// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/haptics/analysis/hold_test.h"
#include "argil/haptics/analysis/loop_stability.h"
#include "argil/haptics/scene/scene_wall.h"

namespace argil::evaluation {

/// The hands of every chart of stability, from the least to the most damped.
inline constexpr std::array kHands{haptics::Hand::push, haptics::Hand::light, haptics::Hand::arm,
                                   haptics::Hand::firm};
inline constexpr double kPressN = 3.0;
/// Of the servo, where a chart does not say another.
inline constexpr double kPeriodS = 1e-3;

/// A simulated Falcon with an even encoder of 60 um, as the runs of docs/theory.md
/// have it.
haptics::FalconModel falcon(bool is_frictionless, int delay_ticks);

/// Who holds what, through which servo.
struct HoldCase {
  haptics::Hand hand = haptics::Hand::push;
  haptics::FalconModel device;
  haptics::ServoOptions servo;
};

/// A press of 3 N into what lies below y = 0 that comes to rest at `rest_mm` (negative: below). The
/// hand waits until the servo has ramped in. Without friction the encoder's steps die down slowly,
/// so that the hold is watched later.
haptics::HoldTest hold_test(const HoldCase& held, double rest_mm);

/// Runs that test, and judges the hold.
haptics::HoldJudgement hold(haptics::ForceScene& scene, const HoldCase& held, double rest_mm,
                            haptics::ServoObserver* observer = nullptr);

/// The same at a linear wall at y = 0, coming to rest where its spring and the coupling's have
/// given. `stiffness_n_per_m` above 0, damping at least 0.
haptics::HoldJudgement hold_wall(const HoldCase& held, double stiffness_n_per_m,
                                 double damping_n_s_per_m = 0.0);
haptics::WallScene linear_wall(double stiffness_n_per_m, double damping_n_s_per_m);
/// Where the handle rests at such a wall, mm.
double wall_rest_mm(const HoldCase& held, double stiffness_n_per_m);

/// The linear loop of that hand and device, K not yet set.
haptics::LinearLoop linear_loop(const HoldCase& held);

/// (b + b_hand + c) / (T / 2 + t_d): docs/theory.md, A.
double formula_n_per_m(const HoldCase& held, double added_damping_n_s_per_m);

/// How far the coupling's spring gives under the press, once the governor has settled; 0 where
/// there is none.
double coupling_give_mm(const HoldCase& held);

/// The force that a law has felt for a while: what a filter does that is applied to the force and
/// not to the position. It answers with the force of the tick, wherever it is asked: only direct
/// coupling may ask it.
class LateScene final : public haptics::ForceScene {
 public:
  /// `gain_per_ms` as tau of eq. 6 of INRIA report 5090.
  LateScene(haptics::ForceScene& scene, double gain_per_ms, double period_s);
  void begin_tick(const haptics::HandleState& handle) noexcept override;
  haptics::SceneForce force_at(const haptics::HandleState& handle) const noexcept override;

 private:
  haptics::ForceScene& scene_;
  double gain_;
  haptics::SceneForce late_;
};

/// Runs all of them on the threads there are. Each writes only what is its own, so that the rows do
/// not depend on the order.
Result<void> run_all(const std::vector<std::function<void()>>& work, const Progress& progress,
                     const std::string& stage, double from, double to);

}  // namespace argil::evaluation
