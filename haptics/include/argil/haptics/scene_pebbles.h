// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "argil/haptics/scene.h"

namespace argil::haptics {

/// Equal balls; what they are made of is felt with the same spring and damper.
struct PebblesOptions {
  std::vector<Vec3> centers_mm;       ///< any number, anywhere
  double radius_mm = 4.0;             ///< > 0
  double stiffness_n_per_m = 1000.0;  ///< >= 0
  double damping_n_s_per_m = 5.0;     ///< on the velocity along the centre line; >= 0
};

/// `count_x` times `count_y` centres, `spacing_mm` apart, about x = y = 0 at height z.
std::vector<Vec3> pebble_grid(int count_x, int count_y, double spacing_mm, double z_mm);

/// Eq. 3.15 and 3.18: a rough wall of balls, each pushing along the line from its centre. Where
/// balls overlap their forces add up. The balls are hashed by cells of their diameter, so that a
/// query looks at those of eight cells, whatever their number.
///
/// Cost     constructing is linear in the balls; force_at 0.3 us for 25 as for 250 000.
class PebblesScene final : public ForceScene {
 public:
  explicit PebblesScene(const PebblesOptions& options);
  SceneForce force_at(const HandleState& place) const noexcept override;

  /// How many balls force_at looks at here.
  int candidates(const Vec3& place_mm) const noexcept;

 private:
  template <class Visit>
  void visit_near(const Vec3& place_mm, const Visit& visit) const noexcept;

  struct Cell {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
  };
  PebblesOptions options_;  ///< centers_mm sorted by cell
  std::unordered_map<std::uint64_t, Cell> cells_;
};

}  // namespace argil::haptics
