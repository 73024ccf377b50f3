// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "argil/haptics/force/tool_force.h"

#include "scene/distance.h"

namespace argil::evaluation {

/// The exponents of every row of the chart.
inline constexpr std::array<double, 3> kExponents{1.0, 2.0, 4.0};

struct Wrench {
  Vec3 force_n;
  Vec3 torque_nmm;
};

/// The converged force for each of kExponents.
struct Reference {
  std::array<Wrench, kExponents.size()> energy;
  std::array<Wrench, kExponents.size()> blanch;
  /// What all of the clay under the tool pushes with, whichever way: the pressures added up without
  /// their directions.
  std::array<double, kExponents.size()> push_n{};
};

/// The integral of both laws over the exact distance, by a lattice of `across` nodes along every
/// axis of an ellipsoid that is fixed to the tool.
///
/// Accuracy docs/forces.md: 0.02 % at an edge for the energy law at 48 across; `argil chart force`
///          prints what doubling changes.
/// Cost     2.2 across^3 calls of `distance`, five times that where blanch is felt.
Reference reference_force(const Distance& distance, double probe_mm, const haptics::ForceTool& tool,
                          const haptics::ForceMaterial& material, int across);

}  // namespace argil::evaluation
