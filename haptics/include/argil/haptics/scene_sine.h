// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "argil/haptics/scene.h"

namespace argil::haptics {

/// Where the wall's push points.
enum class SineNormal {
  z_only,    ///< eq. 3.17: along z. Sliding round a loop gains or costs 60 mJ
  unit,      ///< eq. 3.22: along the unit normal. Not conservative either, 6 mJ
  gradient,  ///< along the gradient of k/2 depth^2, the normal of eq. 3.19 as it is: conservative
  table_nearest,   ///< section 3.6.4: the unit normal of the nearest node of a table
  table_bilinear,  ///< the same, between the four nodes around
};

struct SineOptions {
  SineNormal normal = SineNormal::unit;
  double offset_mm = -20.0;           ///< middle height of the wall
  double amplitude_mm = 5.0;          ///< A; with f = 20 /m slopes up to 32 degrees
  double frequency_x_per_m = 20.0;    ///< f_x
  double frequency_y_per_m = 20.0;    ///< f_y
  double stiffness_n_per_m = 1000.0;  ///< k; >= 0
  double damping_n_s_per_m = 5.0;     ///< c, on v_z as eq. 3.17 and 3.22 have it; >= 0
  double table_step_mm = 1.0;         ///< of the tables: 50 nodes a wavelength; > 0
};

/// Eq. 3.16 to 3.22: the solid below z = offset + A sin(2 pi f_x x) cos(2 pi f_y y).
///
/// Memory   the table holds one period in x and y.
class SineScene final : public ForceScene {
 public:
  explicit SineScene(const SineOptions& options);
  SceneForce force_at(const HandleState& place) const noexcept override;

  double height_mm(double x_mm, double y_mm) const noexcept;   ///< z_r, eq. 3.16
  Vec3 slope_normal(double x_mm, double y_mm) const noexcept;  ///< N of eq. 3.19, z = 1
  Vec3 table_normal(double x_mm, double y_mm, bool bilinear) const noexcept;  ///< unit length

 private:
  Vec3 push_direction(double x_mm, double y_mm) const noexcept;
  const Vec3& node(long i, long j) const noexcept;

  SineOptions options_;
  double omega_x_per_mm_;
  double omega_y_per_mm_;
  double period_x_mm_;
  double period_y_mm_;
  long count_x_ = 0;  ///< nodes a period
  long count_y_ = 0;
  std::vector<Vec3> table_;
};

}  // namespace argil::haptics
