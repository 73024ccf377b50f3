// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include "argil/engine/clay.h"
#include "argil/engine/stroke.h"

namespace argil {

/// All actions that change the surface, in the order of their numbers.
const std::vector<Action>& actions_on_levels();

/// A small ball or block of random size and detail.
Clay random_start(std::mt19937& random);

/// A stroke of one to three dabs of a random tool at a random point within `reach_mm` of the
/// origin.
Stroke random_dab(std::mt19937& random, double reach_mm);

/// A stroke of a ball through some points, a tenth of a second from each to the next.
Stroke stroke_of(Action action, double radius_mm, double strength, const std::vector<Vec3>& places);

/// What became of the symmetry of many strokes.
class SymmetryCount {
 public:
  void add(const StrokeReport& report) { ++of_[static_cast<std::size_t>(report.symmetry)]; }
  void print() const;

 private:
  std::array<int, 4> of_{};
};

/// One line that lets a failed seed be understood.
std::string describe(const Stroke& stroke);

}  // namespace argil
