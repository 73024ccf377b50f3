// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "stability/late/late_case.h"

namespace argil::evaluation {

/// What is felt of flat clay by a tool at a height over its surface, in closed form, from a table:
/// 3 us of integral would be asked for a dozen times a tick.
class HeightLaw {
 public:
  explicit HeightLaw(const LateTool& tool);

  struct Felt {
    double force_n = 0.0;
    double energy_mj = 0.0;
    double slope_n_per_mm = 0.0;   ///< how the force grows with depth
    double drag_n_s_per_mm = 0.0;  ///< of the tool's speed
  };
  Felt at(double height_mm) const noexcept;
  /// Where the force is `force_n`; from just above the clay down.
  double height_mm(double force_n) const noexcept;

  const LateTool& tool() const noexcept { return tool_; }
  /// How far below the tool's centre it cuts; a spring is cut above it, where it gives 1 N.
  double cut_mm() const noexcept {
    return tool_.is_spring() ? -1e3 / tool_.spring_n_per_m : tool_.radius_mm;
  }

 private:
  void add_ball(double height_mm);
  void add_spring(double height_mm);

  LateTool tool_;
  double least_mm_;
  double most_mm_;
  std::vector<Felt> table_;
};

}  // namespace argil::evaluation
