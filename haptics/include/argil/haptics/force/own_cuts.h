// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>

#include "argil/core/vec3.h"
#include "argil/core/window_channel.h"

namespace argil::haptics {

/// What a ball that carves has cut away lately, so that the servo can take it out of the windows
/// that it reads before the clay's thread has answered.
///
/// A late window resists a tool that sinks in by the matter that the tool has cut since: a spring
/// that acts late, on which a hand can chatter however passive it is. So each piece of the tool's
/// way goes onto the window's nodes at once, phi = max(phi, -d) with d the distance to the piece,
/// and onto every newer window again until that has it: cut twice is cut once, so that nothing has
/// to be matched with what a window answers. Values only rise, so that the energy that is felt only
/// falls (OwnCuts.OnlyLowerTheEnergy).
///
/// What the clay does not take away after all (a mask, an interrupted stroke) comes back with the
/// windows after kKeptS, as a rise for the EnergyAccount.
///
/// At the begin of a cut its radius grows from nothing within kGrowS, or the whole dab would be
/// felt as one step.
///
/// Threads  Realtime: one thread; no allocation.
/// Cost     `stamp_newest` 3 to 10 us; `stamp_all` that for each piece near the tool, at most
///          kMostStamped.
/// Source   docs/theory.md, "Late windows".
class OwnCuts {
 public:
  static constexpr double kKeptS = 0.2;
  static constexpr double kGrowS = 0.02;
  static constexpr std::size_t kMostStamped = 12;

  /// `radius_mm`: of what is cut away, >= 0; 0: nothing is.
  explicit OwnCuts(double radius_mm) noexcept;

  /// Where the tool is after `elapsed_s` more, and whether it cuts there. It cuts in a straight
  /// line from where it was last, if it cut there.
  void move_to(const Vec3& position_mm, double elapsed_s, bool is_cutting) noexcept;

  /// The next cut begins anew, wherever it is.
  void forget_motion() noexcept { is_cutting_ = false; }

  /// Whether `stamp_newest` has anything to do.
  bool is_cutting() const noexcept { return is_cutting_; }

  /// Takes the piece that is being cut, or all that are still kept, out of the nodes of a window
  /// within `reach_mm` of the tool's place, along each axis.
  void stamp_newest(WindowSlot& window, double reach_mm) const noexcept;
  void stamp_all(WindowSlot& window, const Vec3& tool_mm, double reach_mm) const noexcept;

 private:
  /// A ball moved from one place to another.
  struct Piece {
    Vec3 from_mm;
    Vec3 to_mm;
    double radius_mm = 0.0;
    double until_s = 0.0;  ///< when it was cut last
  };
  static constexpr std::size_t kMostPieces = 32;

  const Piece& newest(std::size_t back) const noexcept;
  static double distance_to(const Piece& piece, const Vec3& place_mm) noexcept;
  static void stamp(const Piece& piece, WindowSlot& window, const Vec3& tool_mm,
                    double reach_mm) noexcept;

  double radius_mm_;
  std::array<Piece, kMostPieces> pieces_{};  ///< a ring
  std::size_t count_ = 0;                    ///< of all that were ever begun
  Vec3 last_mm_;                             ///< where the tool was
  double now_s_ = 0.0;
  double cutting_s_ = 0.0;  ///< for how long it cuts
  bool is_cutting_ = false;
};

}  // namespace argil::haptics
