// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "argil/core/result.h"
#include "argil/core/vec3.h"
#include "argil/haptics/scene/scene.h"

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
  /// Of the pull, or of the push; usual 60, above 0 to 500. No more is used than rate, delay and
  /// filter allow (GuidanceState). A push stiffer than the hand (100 N/m when light) cannot be
  /// resisted.
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
  /// what flows in (Guidance); usual 25, above 0. A push fades where it is spent, some 29 mm off
  /// the path.
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
  /// Of the tool from the path, in the hand's mm; along the surface that it touches.
  double distance_mm = 0.0;
  /// Of the pull: 1 direct, 0 indirect, 1/2 no force.
  double share = 0.5;
  /// That is used: GuidanceOptions::stiffness_n_per_m, or the AidTick's where that is less.
  double stiffness_n_per_m = 0.0;
  /// Root mean square of the distance, over GuidanceOptions::settle_s.
  double error_mm = 0.0;
  /// Mean of the push that the hand held off, over the same time.
  double effort_n = 0.0;
  /// Energy given to the hand since construction, by the force that acted; below 0 when it was
  /// taken.
  double given_mj = 0.0;
  /// What the hand worked against that force; given_mj is net of it.
  double worked_mj = 0.0;
  /// What may still be given.
  double left_mj = 0.0;
};

/// The surface that a tool touches: what of a force or a way lies across it does not count.
struct SurfaceTouch {
  /// Unit length where `part` is above 0.
  Vec3 normal;
  /// How much it is touched, 0 to 1.
  double part = 0.0;

  Vec3 along(const Vec3& v) const noexcept { return v - part * dot(v, normal) * normal; }
};

/// A force on the hand along a path.
///
/// Direct, it is the pull of a spring of `stiffness_n_per_m` that saturates at `most_force_n`, from
/// the tool to the nearest point of the path, without what of it lies across a surface that is
/// touched. V(d), that spring's energy, is its potential in the air and on any surface: what is
/// left out does no work there. Indirect, it is as large and the other way; between parts of the
/// path that lie on different sides and are about equally near, the directions away from them are
/// averaged, so that it fades to nothing in the middle of a loop instead of turning round there
/// (Guidance.FadesAPushInTheMiddle). Hybrid is s times the one or the other, s = 2 share - 1, and
/// seeks
///
///   share = error / tolerance + effort / effort_n, at most 1,
///
/// error being how far off the path the hand has been lately (its performance) and effort what push
/// it has had to hold off (its demand). A hand that follows well is pushed and stays on its guard;
/// one that strays, or works too hard, is drawn back. The share changes by no more than
/// most_change_per_s.
///
/// Energy  the work of the force that really acted is added up, delay, ramps and limits included.
///         It never exceeds what the pull had stored when it began, most_given_mj, and what flows
///         in while anything is owed: 1 mW and the device's damping power at 1 N s/m, a third of a
///         Falcon's. The force is at most that of a spring of AidTick::most_stiffness_n_per_m that
///         has stored what may still be given, so that it fades no more steeply than that. What a
///         hand puts in beyond what the pull stores is kept for it up to most_given_mj. No
///         potential is assumed but for what is stored at the start (GuidanceProperty.*,
///         GuidanceOnABall.*).
///
/// Threads  Realtime: one thread; only constructing allocates.
/// Cost     10 ns for each point of the path. Of a push 50 ns more for each that is less than twice
///          as far as the nearest, 200 ns where its piece is longer than a tenth of that.
/// Source   averaging by the angle that each part of the path subtends, weighted with
///          2 - d / nearest: ours.
class Guidance {
 public:
  static constexpr int kMostDelayTicks = 16;

  /// `options` as check_guidance takes them.
  explicit Guidance(GuidanceOptions options);

  /// The force on the hand for a tick. `tool_mm` is what is to follow the path, in its frame, which
  /// is that of `tick` too; a delay beyond kMostDelayTicks counts as that.
  Vec3 tick(const Vec3& tool_mm, const AidTick& tick, const SurfaceTouch& touch = {}) noexcept;

  /// The motion since the last tick means nothing. What was given beyond what the pull stored stays
  /// owed; where the hand is next the pull has stored anew.
  void forget_motion() noexcept;

  const GuidanceOptions& options() const noexcept { return options_; }
  const GuidanceState& state() const noexcept { return state_; }

 private:
  double potential_mj(double distance_mm) const noexcept;
  double sought_share() const noexcept;
  void judge(double elapsed_s) noexcept;
  void account(const AidTick& tick) noexcept;
  void store(double stored_mj, bool begins) noexcept;

  GuidanceOptions options_;
  GuidanceState state_;
  double error_squared_mm2_ = 0.0;
  double sign_ = 0.0;       ///< s of the force that acts
  double stored_mj_ = 0.0;  ///< by a pull, at the last tick
  double owed_mj_ = 0.0;    ///< given and not flown in; below 0 what the hand may have back
  std::array<Vec3, kMostDelayTicks + 1> written_n_{};  ///< newest first
  Vec3 handle_mm_;
  bool has_handle_ = false;
};

}  // namespace argil::haptics
