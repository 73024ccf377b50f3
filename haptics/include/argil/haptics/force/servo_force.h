// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>

#include "argil/core/window_channel.h"
#include "argil/haptics/force/energy_account.h"
#include "argil/haptics/force/held_energy.h"
#include "argil/haptics/force/lattice_force.h"
#include "argil/haptics/force/own_cuts.h"
#include "argil/haptics/force/point_choice.h"

namespace argil::haptics {

/// How the force is taken from a window.
enum class ForceMethod {
  /// LatticeForce: the sum over the tool's body.
  volume,
  /// point_force: eq. 1 and 2 at its centre. Stiffer in the hand, and without a torque.
  point,
  /// As volume, but under the energy law the potential at its centre wherever that is within 1 %
  /// (PointChoice), for an eighth of the time (default).
  automatic,
};

/// The force that the servo asks for in a tick: takes the newest window from the clay's thread,
/// sums the force on it, and goes over from one window to the next so that the exchange itself
/// gives the hand no energy.
///
/// Between exchanges what is felt is a potential that does not change, however old the window is;
/// energy enters only where a new window is higher under the tool than the old one. So for kBlendMs
/// both are felt at the pose asked for, F = (1 - a) F_old + a F_new, a rising evenly to 1, and the
/// energy that is felt at the tool's place rises by no more than the account pays (EnergyAccount).
/// What it does not pay is held back of the new window (HeldEnergy): the clay around the tool
/// hardly pushes it then, and still bears a hand that presses on. It is paid by and by, or comes at
/// once where the tool leaves the clay and it costs nothing. Clay that was removed is lower
/// everywhere and is felt whole after kBlendMs. The drag, which can only take energy, is blended
/// evenly.
///
/// Within a tick the force is minus the gradient of the felt energy
/// (WindowExchange.IsConservativeAtAnyShare), and without a window under the tool there is none
/// (WindowExchange.LeavesNoForceInTheAir). The laws and methods without an energy, blanch and the
/// point force, are blended evenly and not held back. Where the centre of a small tool is enough
/// and where it is so no longer, sum and centre are exchanged in the same way.
///
/// What the tool itself cuts away is taken out of the windows at once where that is known
/// (`own_cut_mm`): they are late, and a hand that sinks in would chatter on what it has cut
/// already.
///
/// A tool that has left its window is not known to feel less than it last did: what it gets when
/// the next window comes is counted from there. A tool of another shape or size takes effect with
/// the first window whose spacing fits it (choose_lattice); until then the old one is felt.
///
/// Threads  Realtime: for one servo thread; no allocation, lock or system call (ServoRealtime.*).
/// Cost     `at` one query of its method, two while it goes over; begin_tick as much, and when the
///          tool's size changed the making of its table (5 us; 25 with an exponent that is not
///          whole). With own cuts 3 to 10 us a tick, and up to 0.1 ms on that of a new window.
/// Source   docs/theory.md, "Late windows".
class ServoForce {
 public:
  /// How long going over to a new window takes: a step of 0.25 N is then 0.05 N a tick, and the
  /// clay is felt 2.5 ms later. The clay hears of the tool every 5 ms, so that windows come no
  /// faster.
  static constexpr double kBlendMs = 5.0;

  /// `channel` must outlive this, which is its only reader. `own_cut_mm`: radius of the ball that
  /// the tool cuts away where `cut` says so (OwnCuts); 0: none.
  ServoForce(WindowChannel& channel, const ForceMaterial& material, ForceLaw law,
             ForceMethod method = ForceMethod::automatic, const EnergyAccountOptions& account = {},
             double own_cut_mm = 0.0) noexcept;

  /// Begins a tick with the tool where it truly is: takes the newest window, and goes on going over
  /// to it by what the account pays there.
  ///
  /// Units  elapsed_s: since the last tick. contact_share: how much of the contact force reaches
  /// the
  ///        hand, > 0 (contact_share of a ForceMix). When it grows the energy that is felt does,
  ///        and is paid or held back like that of a higher window.
  void begin_tick(const ForceTool& tool, double elapsed_s = 1e-3,
                  double contact_share = 1.0) noexcept;

  /// The force at any pose in the tick that was begun; the same for the same pose. The tool's shape
  /// and radii do not count, those of begin_tick do. All of the result is of what is felt, but for
  /// the stiffness while energy is held back, which is the window's as far as the force is;
  /// `outside_window` of the newer window.
  ForceResult at(const ForceTool& pose) const noexcept;

  /// Ends a tick with the tool where it has ended up: what it cuts away there is gone from the next
  /// tick on, without waiting for the clay's thread.
  void cut(const ForceTool& tool, double elapsed_s, bool is_cutting) noexcept;

  /// One tick: begin_tick, and `at` the same pose. Before the first window that fits the tool all
  /// is zero and `outside_window` is set.
  ForceResult tick(const ForceTool& tool, double elapsed_s = 1e-3) noexcept;

  /// The tool is elsewhere by no motion of its own, or what it felt before was not given: the next
  /// window is felt whole at once. For a servo that ramps its force in after such a jump.
  void forget_motion() noexcept {
    is_anew_ = true;
    cuts_.forget_motion();
  }

  /// The newest window that was taken.
  const WindowSlot& window() const noexcept { return channel_.read_slot(new_.place); }

 private:
  /// A window that is felt and what sums it.
  struct Felt {
    std::size_t place = 0;            ///< of the channel
    std::optional<LatticeForce> sum;  ///< for `tool` on the spacing of the window
    ForceTool tool;                   ///< shape and radii
    bool is_point = false;            ///< felt at the centre, the sum is not asked
    HeldEnergy held;                  ///< of its energy
  };
  ForceResult query(const Felt& felt, const ForceTool& pose) const noexcept;
  bool is_retooled(const ForceTool& tool) const noexcept;
  bool may_choose() const noexcept;
  void choose(const ForceTool& tool, double elapsed_s) noexcept;
  void take_window(const ForceTool& tool) noexcept;
  void fit(const ForceTool& tool) noexcept;
  void exchange(const ForceTool& tool, double elapsed_s, double contact_share) noexcept;

  WindowChannel& channel_;
  ForceMaterial material_;
  ForceLaw law_;
  ForceMethod method_;
  EnergyAccount account_;
  OwnCuts cuts_;
  PointChoice choice_;
  Felt old_;               ///< meaningful while blend_ < 1
  Felt new_;               ///< the newest
  double blend_ = 1.0;     ///< of the way from old_ to new_
  double felt_nmm_ = 0.0;  ///< at the last pose of begin_tick in all windows that are felt
  double share_ = 1.0;     ///< of the contact, in the last tick
  bool is_anew_ = true;
};

}  // namespace argil::haptics
