// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <vector>

#include "argil/core/winding_number.h"

namespace argil::test {

/// The winding number of a soup by trees, to 1e-3 where it is open: with cones over its boundary it
/// is closed and has a whole one, which a coarse tree tells; what the cones contribute is summed
/// finely.
class SolidWinding {
 public:
  explicit SolidWinding(const TriangleMesh& mesh)
      : soup_(mesh.positions, mesh.triangles), cones_(cones_of(mesh)) {}

  double at(const Vec3& point) const noexcept {
    const double cones = cones_.at(point);
    return std::round(soup_.at(point) + cones) - cones;
  }

 private:
  static WindingNumber cones_of(const TriangleMesh& mesh) {
    constexpr double kFarRadii = 6.0;
    std::vector<Vec3> positions = mesh.positions;
    const std::vector<Triangle> cones = boundary_cones(positions, mesh.triangles);
    return {positions, cones, kFarRadii};
  }

  WindingNumber soup_;
  WindingNumber cones_;
};

}  // namespace argil::test
