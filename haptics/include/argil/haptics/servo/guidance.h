// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "argil/core/result.h"
#include "argil/core/vec3.h"
#include "argil/haptics/servo/passivity.h"

namespace argil::haptics {

/// How a path is felt.
///
/// Source  section 4.3 of the Falcon report (docs/equations.md), after L. Profumo, L. Pollini,
///         D. A. Abbink, "Direct and indirect haptic aiding for curve negotiation", IEEE SMC 2013.
enum class GuidanceKind {
  none,
  /// Direct haptic assistance (DHA): pulls to the path; a hand that yields follows it.
  direct,
  /// Indirect haptic assistance (IHA): pushes off the path; a hand that resists is on its guard,
  /// and follows it.
  indirect,
  /// Between the two, by how well the hand follows and how hard it has to work (Guidance).
  hybrid,
};
/// "none", "direct", "indirect", "hybrid".
const char* guidance_name(GuidanceKind kind) noexcept;

/// A path and how it is felt. Forces, and lengths but for the path's own, are the hand's.
struct GuidanceOptions {
  static constexpr std::size_t kMostPoints = 1000;

  GuidanceKind kind = GuidanceKind::none;
  /// Straight from point to point; at least one, up to kMostPoints; in the frame of what is felt.
  std::vector<Vec3> path_mm;
  /// mm of that frame for each mm of the hand; usual 1, > 0.
  double scale = 1.0;
  /// Of the pull, or of the push; usual 60, above 0 to 500. A push stiffer than the hand (100 N/m
  /// when light) cannot be resisted.
  double stiffness_n_per_m = 60.0;
  /// Where it saturates, so that a hand can always override it; usual 1.5, above 0 to 8.
  double most_force_n = 1.5;

  // Of hybrid.

  /// Off the path by so much (root mean square), the hand is given all of the pull; usual 5, above
  /// 0. Less is seldom indirect.
  double tolerance_mm = 5.0;
  /// Having held off a push of so much (mean), it is given all of the pull too; usual 0.5, above 0.
  double effort_n = 0.5;
  /// Time constant of both means; usual 0.5, above 0. Less follows each twitch.
  double settle_s = 0.5;
  /// How fast the share of the pull may change; usual 0.5, above 0. Faster is felt as a tug.
  double most_change_per_s = 0.5;

  /// What guidance may give the hand in all, besides what its pull had stored when it began and
  /// what flows in (Guidance); usual 25, above 0. A push fades where it is spent, 26 to
  /// 29 mm off the path.
  double most_given_mj = 25.0;

  friend bool operator==(const GuidanceOptions&, const GuidanceOptions&) = default;
};

/// Success, or bad_input naming option, value and range.
Result<void> check_guidance(const GuidanceOptions& options);

/// The point of a path, straight between its points, that is nearest to a position; the position
/// itself when the path is empty.
///
/// Threads  Realtime; pure.
/// Cost     10 ns for each point of the path.
Vec3 nearest_on_path(const std::vector<Vec3>& path_mm, const Vec3& place_mm) noexcept;

/// How guidance stands after a tick.
struct GuidanceState {
  /// On the hand.
  Vec3 force_n;
  /// Of the tool from the path, in the hand's mm.
  double distance_mm = 0.0;
  /// Of the pull: 1 direct, 0 indirect, 1/2 no force.
  double share = 0.5;
  /// Root mean square of the distance, over GuidanceOptions::settle_s.
  double error_mm = 0.0;
  /// Mean of the push that the hand held off, over the same time.
  double effort_n = 0.0;
  /// Energy given to the hand so far, by the force that acted; below 0 when it was taken.
  double given_mj = 0.0;
  /// What may still be given.
  double left_mj = 0.0;
};

/// A force on the hand along a path.
///
/// d is the distance of the tool from the path, V(d) the energy of a spring of `stiffness_n_per_m`
/// that saturates at `most_force_n`. The force is that of the potential s V, s = 2 share - 1: 1
/// direct, -1 indirect. Hybrid seeks
///
///   share = error / tolerance + effort / effort_n, at most 1,
///
/// error being how far off the path the hand has been lately (its performance) and effort what push
/// it has had to hold off (its demand). A hand that follows well is pushed and stays on its guard;
/// one that strays, or works too hard, is drawn back. The share changes by no more than
/// most_change_per_s.
///
/// Energy  s V with a constant s is conservative whatever the path: no loop of the hand gains by
/// it.
///         What a change of s, the sampling and the delay give besides is counted by a passivity
///         observer: the energy given, plus what the pull has stored, less what it had stored at
///         the start. It may exceed most_given_mj by no more than what flows in, 1 mW and the
///         device's damping power at 1 N s/m, a third of a Falcon's. The nearer it comes, the
///         weaker the force, and a pull grows only as far as that is paid for (Guidance.*).
///
/// A push changes direction where two parts of the path are equally near, such as in the middle of
/// a loop.
///
/// Threads  Realtime: one thread; only constructing allocates.
/// Cost     10 ns for each point of the path.
class Guidance {
 public:
  /// `options` as check_guidance takes them. `delay_ticks`: as PassivityController's.
  explicit Guidance(GuidanceOptions options, int delay_ticks = 1);

  /// The force on the hand for a tick of `elapsed_s` (> 0).
  ///
  /// Units  tool_mm: what is to follow the path, in its frame. handle_mm: of the hand, whose motion
  ///        the force works on, in the same frame. given_part: how much of the last force was
  ///        really given, 0 to 1: ramps take the rest.
  Vec3 tick(const Vec3& tool_mm, const Vec3& handle_mm, double elapsed_s,
            double given_part) noexcept;

  /// The motion since the last tick means nothing: what was given and stored is forgotten, error,
  /// effort and share are not.
  void forget_motion() noexcept;

  const GuidanceOptions& options() const noexcept { return options_; }
  const GuidanceState& state() const noexcept { return state_; }

 private:
  double potential_mj(double distance_mm) const noexcept;
  double sought_share() const noexcept;
  void judge(double elapsed_s) noexcept;
  void account(const Vec3& handle_mm, double elapsed_s, double given_part) noexcept;
  double allowed_sign(double wanted) const noexcept;

  GuidanceOptions options_;
  PassivityController observer_;
  GuidanceState state_;
  double error_squared_mm2_ = 0.0;
  double sign_ = 0.0;       ///< s of the potential that acts
  double stored_mj_ = 0.0;  ///< by a pull, at the last tick
  double owed_mj_ = 0.0;    ///< given or stored, and not yet flown in; >= 0
  Vec3 handle_mm_;
  bool has_handle_ = false;
};

}  // namespace argil::haptics
