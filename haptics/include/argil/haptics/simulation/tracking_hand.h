// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "argil/core/vec3.h"
#include "argil/haptics/servo/servo.h"
#include "argil/haptics/simulation/hand_model.h"

namespace argil::haptics {

struct TrackingHandOptions {
  /// Sees where the tool is and corrects; a blindfolded hand does not.
  bool is_sighted = true;
  /// From what is seen or felt to the answer; usual 0.2, 0 to kMostReactionS.
  double reaction_s = 0.2;
  /// How fast a seen error is corrected, per second; usual 2, 0 to 5. With the reaction time more
  /// than 1 / reaction_s overshoots.
  double gain_per_s = 2.0;
  /// Root mean square, along each axis, of how far the hand strays by itself; usual 3, >= 0.
  double stray_mm = 3.0;
  /// Presses its button when the force changes suddenly by so much; usual 0: never; >= 0.
  double notices_n = 0.0;
  /// Of how it strays; the same seed strays the same way.
  std::uint64_t seed = 1;
};

/// A hand that means to follow a plan, strays from it as hands do, sees where the tool is and
/// corrects by what it saw a reaction time ago: the crossover model of a person who steers, with a
/// remnant of slow sines. It yields to forces as its HandModel does; it knows nothing of guidance
/// and grows no more alert by being pushed.
///
/// Determinism  same plan, options and ticks: same bits.
/// Threads      Realtime: `at` and `see` are for the servo's thread; constructing allocates.
/// Source       D. T. McRuer, H. R. Jex, "A review of quasi-linear pilot models", IEEE Trans. Human
///              Factors in Electronics 8(3) (1967). Ours integrates with one gain in all axes.
class TrackingHand final : public HandSource {
 public:
  static constexpr double kMostReactionS = 0.5;

  /// `plan`: as HandPlan takes it.
  TrackingHand(std::vector<HandKey> plan, const TrackingHandOptions& options);

  HandIntent at(double time_s) noexcept override;
  Vec3 start_mm() const noexcept override { return plan_.start_mm(); }

  /// What came of it: once after each tick, of a servo of 1 kHz or slower.
  void see(const ServoTick& tick) noexcept;

 private:
  struct Sine {
    double rad_per_s = 0.0;
    double phase = 0.0;
  };
  Vec3 strayed_mm(double time_s) const noexcept;
  void correct(const ServoTick& tick, double elapsed_s) noexcept;
  void feel(const ServoTick& tick, double elapsed_s) noexcept;

  HandPlan plan_;
  TrackingHandOptions options_;
  std::array<std::array<Sine, 3>, 3> sines_{};  ///< three for each axis
  /// Of tool positions by tick, and when they were: a reaction time of them is looked back.
  std::array<Vec3, 512> error_mm_{};
  std::array<double, 512> error_s_{};
  std::size_t seen_ = 0;    ///< errors written
  std::size_t looked_ = 0;  ///< errors answered
  Vec3 correction_mm_;
  double last_s_ = 0.0;
  Vec3 usual_n_;  ///< of the force, lately
  double felt_s_ = 0.0;
  bool has_felt_ = false;
};

}  // namespace argil::haptics
