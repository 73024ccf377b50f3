// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>

#include "argil/engine/mesh_distance.h"
#include "argil/mesh/decimate.h"

namespace argil::io {

/// The nearest of all triangles.
class NearestTriangle final : public mesh::NearTriangles {
 public:
  explicit NearestTriangle(const TriangleMesh& mesh) : distance_(mesh.positions, mesh.triangles) {}
  double distance_mm(const Vec3& p, double /*enough_mm*/) override {
    return distance_.closest(p, std::numeric_limits<double>::infinity()).distance;
  }
  double distance_far_mm(const Vec3& p, double enough_mm) override {
    return distance_mm(p, enough_mm);
  }

 private:
  MeshDistance distance_;
};

}  // namespace argil::io
