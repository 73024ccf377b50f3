// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "argil/haptics/scene/scene.h"

namespace argil::evaluation {

/// A scene that also tells the energy that its contact has for the hand.
class EnergyScene : public haptics::ForceScene {
 public:
  /// N mm, at a position.
  virtual double energy_at(const haptics::HandleState& handle) const noexcept = 0;
};

/// Stands before a scene and measures what the exchange of its windows gives the hand: asks for
/// force and energy at one place, that of the tool, after the end of a tick and after the begin of
/// the next.
class ExchangeMeter final : public haptics::ForceScene {
 public:
  /// From `from_s` of the servo's clock on. `tells_lateness` false: the governor does not hear how
  /// late the clay is.
  ExchangeMeter(EnergyScene& scene, double from_s, bool tells_lateness)
      : scene_(scene), from_s_(from_s), tells_lateness_(tells_lateness) {}

  void begin_tick(const haptics::HandleState& handle) noexcept override;
  haptics::SceneForce force_at(const haptics::HandleState& handle) const noexcept override;
  void end_tick(const haptics::HandleState& tool) noexcept override;
  void forget_motion() noexcept override;
  int most_queries() const noexcept override { return scene_.most_queries(); }
  haptics::WindowStamp window_stamp() const noexcept override;

  /// All rises of the energy, mJ.
  double put_in_mj() const noexcept { return put_in_mj_; }
  /// The force's change, N, in each tick that had one, `since_s` the begin of the first.
  std::vector<double> steps_since(double since_s) const;
  /// Ticks in which the tool had no window under it.
  int outside() const noexcept { return outside_; }

 private:
  struct Step {
    double time_s;
    double force_n;
  };
  EnergyScene& scene_;
  double from_s_;
  bool tells_lateness_;
  haptics::HandleState tool_;  ///< at the end of the last tick
  Vec3 force_n_;               ///< there
  double energy_mj_ = 0.0;
  bool has_tool_ = false;
  double put_in_mj_ = 0.0;
  int outside_ = 0;
  std::vector<Step> steps_;
};

}  // namespace argil::evaluation
