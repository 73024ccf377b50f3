// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/field_window.h"
#include "argil/haptics/force/tool_force.h"

namespace argil::haptics {

/// The energy law at the tool's centre alone: minus the gradient of Phi(u) there, phi tricubic
/// between the nodes, so that the force is continuous and does no work on a closed path
/// (PointEnergyForce.IsMinusTheGradientOfItsEnergy). No torque. `outside_window` where a node of
/// the 4^3 around the centre is missing; all is zero then.
///
/// Accuracy where point_is_enough says so, 1 % of what LatticeForce sums; `error_n` bounds that
///          (PointEnergyForce.IsTheSumWhereItIsEnough).
/// Threads  Realtime.
/// Cost     64 nodes of the window, whatever the tool.
ForceResult point_energy_force(const FieldWindowView& window, const ForceTool& tool,
                               const ForceMaterial& material) noexcept;

/// Whether the centre of a tool is enough for force and torque on the clay of a window that holds
/// its support: point_is_enough, of a tool `times` as large. Never of what is no ball: others are
/// also turned, by up to 3 % of the force times their radius.
///
/// Threads  Realtime.
bool is_centre_enough(const FieldWindowView& window, const ForceTool& tool,
                      const ForceMaterial& material, double times = 1.0) noexcept;

/// Whether a tool is felt at its centre or summed over its body, from tick to tick: no more is
/// modelled than a place needs.
///
/// The centre is chosen once it has been enough for kSettleMs, and for a tool kMargin times as
/// large as well; the sum as soon as the centre is not enough. So a tool that lingers at the border
/// between the two does not go to and fro (PointChoice.DoesNotChatterAtTheBorder).
///
/// Threads  Realtime.
/// Cost     at most an eighth of a sum with AVX2, the force at the centre included; less where the
///          distance of the centre already says no.
class PointChoice {
 public:
  static constexpr double kMargin = 1.2;
  static constexpr double kSettleMs = 20.0;

  /// Begins with the sum.
  bool is_point() const noexcept { return is_point_; }

  /// After `elapsed_s` more, with the tool there.
  void tick(const FieldWindowView& window, const ForceTool& tool, const ForceMaterial& material,
            double elapsed_s) noexcept;

  /// The same where no time passed: another window was taken.
  void look_again(const FieldWindowView& window, const ForceTool& tool,
                  const ForceMaterial& material) noexcept;

 private:
  bool is_point_ = false;
  double settled_s_ = 0.0;  ///< since when the centre has been enough
};

}  // namespace argil::haptics
