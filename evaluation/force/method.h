// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "argil/haptics/force/tool_force.h"

namespace argil::evaluation {

/// What stands for the integral over the tool.
enum class Quadrature {
  point,    ///< none: the force at the tool's centre, on the finest level
  stencil,  ///< at points fixed to the tool, on the finest lattice
  sum,      ///< volume_force on a lattice of a given number of nodes across the tool
  lattice,  ///< LatticeForce on the lattice that choose_lattice wants
  chosen,   ///< that, or the energy law at the centre where point_is_enough: what the servo does
  fine,     ///< volume_force on the finest lattice
};

struct Method {
  std::string name;    ///< "energy_8"
  std::string series;  ///< "energy": what the chart joins by a line
  Quadrature quadrature = Quadrature::point;
  haptics::ForceLaw law = haptics::ForceLaw::energy;
  int size = 0;  ///< points of a stencil, nodes across of a sum
};

std::vector<Method> all_methods();

/// Stencils and `fine` read the finest lattice all over the tool, deeper than any window holds it:
/// the chart gives them exact distances there.
inline bool reads_finest_lattice(const Method& method) {
  return method.quadrature == Quadrature::stencil || method.quadrature == Quadrature::fine;
}

/// So slow, and so slow to read the window for, that one pose at two of the depths has to do.
inline bool is_dense(const Method& method) {
  return method.quadrature == Quadrature::sum && method.size >= 24;
}

/// Spacing of the lattice that the method reads. `size` nodes are counted across the ball of the
/// tool's volume, so that every shape gets as many.
double spacing_mm(const Method& method, const haptics::ForceTool& tool);

/// Whether the clay's thread could publish the window that the method reads: one that holds the
/// tool's kernel on the method's lattice in a slot (kWindowCapacity).
bool is_servable(const Method& method, const haptics::ForceTool& tool);

/// Whether the chart measures the error of this method with this tool: not where one window takes
/// longer than all others together.
bool is_measured(const Method& method, const haptics::ForceTool& tool);

}  // namespace argil::evaluation
