// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "argil/core/vec3.h"

namespace argil::test {

/// A signed distance in mm, negative inside.
using SceneDistance = std::function<double(const Vec3&)>;

/// The exact distance to z = sin(2 pi x / waves) sin(2 pi y / waves), matter below: closest points
/// found by Newton steps, tabled over one period and over asinh(z), interpolated to 0.01.
class RoughPlane {
 public:
  explicit RoughPlane(double waves);
  double operator()(const Vec3& p) const noexcept;

 private:
  double closest(const std::vector<double>& heights, const Vec3& p) const noexcept;
  double polished(const Vec3& p, double u, double v) const noexcept;

  double waves_;
  std::vector<float> values_;
};

/// A body around the origin whose feature has the size of the tool.
struct ForceScene {
  std::string name;
  SceneDistance distance;  ///< exact around the feature, inside and outside
  double half_mm = 0.0;    ///< the body lies within +-half_mm
  /// Where a tool's centre goes: `height_mm` above the surface, at u, v from -1 to 1 along it.
  std::function<Vec3(double height_mm, double u, double v)> place;
};

/// plane, ball (3 R), torus (6 R, 3 R), edge of 90 degrees, rough (waves of 1 x 8 voxels), slot
/// (two walls 1 R apart, 4 R deep), sheet (1 R thick), none aligned with the lattice.
ForceScene force_scene(const std::string& name, double radius_mm, double voxel_mm);

}  // namespace argil::test
