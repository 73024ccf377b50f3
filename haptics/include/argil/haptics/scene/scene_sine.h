// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "argil/core/vec3.h"
#include "argil/haptics/scene/scene.h"

namespace argil::haptics {

/// Along what the sinusoidal wall pushes. For all of them depth is measured straight down, z_r - z,
/// as printed.
enum class SineDirection {
  /// Equation 3.17: z. Not conservative: 60 mJ a turn in the loop of the tests.
  z_only,
  /// Equation 3.22: the unit normal. Not conservative either: 6.4 mJ in that loop.
  unit_normal,
  /// The normal (3.19) as it is: minus the gradient of k / 2 depth^2, conservative (default).
  gradient,
  /// Section 3.6.4: the unit normal of the nearest entry of a table.
  table_nearest,
  /// The same, blended from four entries and made unit length.
  table_bilinear,
  /// Section 3.6.4: the unit normal from differences of z_r, one step ahead along each axis: of
  /// first order in the step.
  differences_ahead,
  /// From half a step on either side, for one more z_r: of second order.
  differences_central,
};

/// The Falcon report gives the offset; the other numbers are ours, for waves that are plainly felt.
struct SineOptions {
  SineDirection direction = SineDirection::gradient;
  /// Height of the middle of the waves; usual -20.
  double offset_mm = -20.0;
  /// A; usual 5 (slope up to 32 degrees), 0 (flat) to 20.
  double amplitude_mm = 5.0;
  /// f_x; usual 20 (waves 50 mm long), 0 to 500.
  double frequency_x_per_m = 20.0;
  /// f_y; the same.
  double frequency_y_per_m = 20.0;
  /// k; usual 1000, >= 0. Steep slopes feel stiffer: see SineScene.
  double stiffness_n_per_m = 1000.0;
  /// c; usual 0, 0 to 20; more buzzes.
  double damping_n_s_per_m = 0.0;

  /// The tables cover the square |x|, |y| <= half width; beyond it the normal is computed. Usual
  /// 80, a device's workspace, 0.6 MB; > 0.
  double table_half_width_mm = 80.0;
  /// Between entries; usual 1 (50 a wave), > 0, at most the half width.
  double table_spacing_mm = 1.0;

  /// Of the differences; usual 0.1, 1e-9 to 100. Much below 1e-5 rounding is all that is left.
  double difference_step_mm = 0.1;
};

/// A wall below waves, z < z_r(x, y) of equation 3.16:
/// z_r = offset + A sin(2 pi f_x x) cos(2 pi f_y y).
///
/// The damper works on v_z in 3.17 and 3.22, as printed; in 3.22 and the tables it can therefore
/// give energy to a handle that moves along a flank. In `gradient` it works on the rate of depth,
/// which always takes energy. The wall never pulls. With N the normal of 3.19 the stiffness along
/// the normal is k in z_only, k |N| in 3.22, the tables and differences and k |N|^2 in `gradient`:
/// up to 1.4 k with the usual waves.
///
/// Accuracy  direction of table_nearest within 3.2 degrees, of table_bilinear 0.1, of differences
///           ahead 0.33, central 0.0002 (Section3_6_4; `argil chart normals`).
/// Threads   as ForceScene; the constructor makes the table and allocates.
/// Source    equations 3.16 to 3.22 of the Falcon report (docs/equations.md).
class SineScene final : public ForceScene {
 public:
  explicit SineScene(const SineOptions& options = {});

  SceneForce force_at(const HandleState& handle) const noexcept override;

  /// What the surface is above or below a place.
  struct Surface {
    double height_mm = 0.0;  ///< as height_mm
    Vec3 direction;          ///< as direction_at
  };
  /// Both at once, for less: their sines and cosines are the same.
  Surface surface_at(double x_mm, double y_mm) const noexcept;

  /// z_r.
  double height_mm(double x_mm, double y_mm) const noexcept;

  /// N of equation 3.19, not of unit length: z is 1.
  Vec3 normal_at(double x_mm, double y_mm) const noexcept;

  /// What the force is a multiple of: z, a unit normal or N.
  Vec3 direction_at(double x_mm, double y_mm) const noexcept;

  /// What the table takes; 0 where there is none.
  std::size_t table_bytes() const noexcept { return table_.size() * sizeof(Vec3); }

 private:
  void make_table();
  Surface height_and_normal(double x_mm, double y_mm) const noexcept;
  const Vec3& table(int column, int row) const noexcept;
  Vec3 nearest(double column, double row) const noexcept;
  Vec3 bilinear(double column, double row) const noexcept;
  Vec3 from_table(double x_mm, double y_mm) const noexcept;
  Vec3 from_differences(double x_mm, double y_mm, double here_mm) const noexcept;

  SineOptions options_;
  double wave_x_per_mm_ = 0.0;  ///< 2 pi f_x
  double wave_y_per_mm_ = 0.0;
  int table_side_ = 0;  ///< entries along a side
  std::vector<Vec3> table_;
};

}  // namespace argil::haptics
