// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/engine/field_sampler.h"
#include "argil/mesh/triangle_geometry.h"

#include "compare/distance_sums.h"
#include "compare/field_error.h"

namespace argil::io {

/// |phi| over the mesh.
///
/// First the middles of parts 0.4 voxels long, and the vertices. phi is nearly linear over
/// a part: where |phi| plus all that it varies by between those points exceeds the greatest found
/// so far, the triangle is split in four, and so on down to an eighth of a voxel. Whether a bound
/// is kept is another question: BlockProof.
class MeshToField {
 public:
  /// `least_splits` of each side, other than those of the fit: where that looked, the error is
  /// small.
  MeshToField(const TriangleMesh& mesh, const Clay& clay, int least_splits)
      : mesh_(mesh), clay_(clay), least_splits_(least_splits) {}

  mesh::DistanceSummary measure(const Pace& pace);

 private:
  struct Range {
    double low = 0.0;
    double high = 0.0;
    void include(double d) noexcept {
      low = std::min(low, d);
      high = std::max(high, d);
    }
    double worst() const noexcept { return std::max(-low, high); }
    double bound() const noexcept { return worst() + (high - low); }
  };

  void measure_vertices(const Pace& pace);
  DistanceSums measure_triangles(const Pace& pace);
  /// The finest at its corners.
  double voxel_of(std::size_t t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    return static_cast<double>(
        std::min({voxel_at_vertex_[a], voxel_at_vertex_[b], voxel_at_vertex_[c]}));
  }
  double refined(const mesh::Corners& c, const std::array<double, 3>& phi, double found,
                 double voxel_mm, FieldSampler& field) const;

  const TriangleMesh& mesh_;
  const Clay& clay_;
  int least_splits_;
  std::vector<double> at_vertex_;
  std::vector<float> voxel_at_vertex_;
  std::vector<float> bound_;
};

}  // namespace argil::io
