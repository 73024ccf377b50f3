// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <deque>
#include <optional>

#include "argil/haptics/force/energy_account.h"
#include "argil/haptics/force/force_mix.h"
#include "argil/haptics/force/held_energy.h"

#include "stability/late/exchange_meter.h"
#include "stability/late/height_law.h"

namespace argil::evaluation {

/// Clay as a height: flat, worked by the tool that is felt, and felt late through windows. An
/// exchange of its own, written for comparison with ServoForce, which can also do nothing about it.
///
/// Working changes the whole plane: carving lowers it to below the tool, adding raises it to above
/// the tool with one dab, which is more than a ball of clay does, and smoothing fills a hollow. The
/// clay hears of the tool every tick. A window reaches 4 mm to either side along x, or as far as
/// the tool goes at its speed (LateRemedy::reaching).
class LatePlane final : public EnergyScene {
 public:
  /// `law` must outlive it. `surface_mm`: where the clay is before it is worked.
  LatePlane(const HeightLaw& law, const LateCase& what, double surface_mm);

  void begin_tick(const haptics::HandleState& handle) noexcept override;
  haptics::SceneForce force_at(const haptics::HandleState& handle) const noexcept override;
  void end_tick(const haptics::HandleState& tool) noexcept override;
  int most_queries() const noexcept override { return 12; }
  haptics::WindowStamp window_stamp() const noexcept override;
  double energy_at(const haptics::HandleState& handle) const noexcept override;

 private:
  struct Window {
    double surface_mm = 0.0;
    double middle_mm = 0.0;  ///< along x
    double half_mm = 0.0;
    haptics::HeldEnergy held;
  };
  struct Coming {
    double time_s;
    Window window;
  };
  bool is_outside(const Window& window, const haptics::HandleState& place) const noexcept;
  HeightLaw::Felt felt_of(const Window& window, const haptics::HandleState& place) const noexcept;
  double share() const noexcept;
  void exchange(double elapsed_s) noexcept;
  void hold_back(const Window& old, double left, double step, double before_mj) noexcept;
  void work(const haptics::HandleState& tool) noexcept;
  void answer(const haptics::HandleState& tool);

  const HeightLaw& law_;
  LateCase what_;
  haptics::ForceMix mix_;
  haptics::ModeBlend mode_;
  haptics::EnergyAccount account_;
  double surface_mm_;             ///< of the clay
  double rim_mm_;                 ///< of the hollow that smoothing fills
  std::optional<double> cut_mm_;  ///< how deep the servo knows to have cut
  double cutting_s_ = 0.0;
  double fastest_mm_per_s_ = 0.0;  ///< along x
  double next_s_ = 0.0;            ///< window
  std::deque<Coming> coming_;
  std::optional<Window> old_;  ///< felt too, while going over
  std::optional<Window> new_;
  double blend_ = 1.0;         ///< of the way from old to new
  double felt_mj_ = 0.0;       ///< at the tool's place, without the share
  double share_ = 1.0;         ///< of the contact, in the last tick
  haptics::HandleState tool_;  ///< at the end of the last tick
  bool has_tool_ = false;
};

}  // namespace argil::evaluation
