// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "argil/engine/field_sampler.h"
#include "argil/engine/mesh_distance.h"
#include "argil/mesh/triangle_geometry.h"

#include "compare/distance_sums.h"
#include "compare/field_error.h"
#include "compare/field_zeros.h"
#include "compare/surface_cells.h"
#include "compare/triangle_runs.h"

namespace argil::io {

/// Distance of the points with phi = 0 from a mesh.
///
/// The points are those of the cells that the extracted surface stands for, on lines along the
/// axes: a line passes through an area A with normal n in A |n_axis| / spacing^2 points, so that
/// each point of the lines along all three stands for spacing^2 / (|n_x| + |n_y| + |n_z|), also at
/// sharp edges, where paths from a triangle along the gradient would not reach.
///
/// For the greatest distance every cell has a bound: that of the extracted vertices in it from the
/// planes of the triangles nearest to them, and how much phi = 0 can bulge between them by the
/// angles between its normals, first by those that its gradient can have at all, then by those at
/// its edges. Where that exceeds the greatest distance found so far the cell is split in eight, and
/// so on. Whether a bound is kept is another question: BlockProof.
class FieldToMesh {
 public:
  FieldToMesh(const TriangleMesh& mesh, const TriangleMesh& surface, const Clay& clay,
              const TriangleMesh& left_out);

  mesh::DistanceSummary measure(const Pace& pace);

 private:
  struct Sample {
    Vec3 at;
    double distance = 0.0;
    std::uint32_t nearest = kNoTriangle;
  };
  /// A cell and the triangles of the surface that lie in it, `first` to before `last`.
  struct Cell : PlacedCell {
    std::size_t first = 0;
    std::size_t last = 0;
  };

  Cell cell_of(std::size_t t, FieldSampler& field) const;
  template <class Use>
  void for_each_cell(std::size_t begin, std::size_t end, const Use& use) const;
  Sample sample_at(const Vec3& at, const Cell& cell, std::uint32_t hint, double enough) const;
  bool is_left_out(const Vec3& at, const Cell& cell) const;
  Sample sample_at_vertex(std::uint32_t v, std::uint32_t hint, FieldSampler& field) const;
  void measure_vertices(const Pace& pace);
  DistanceSums measure_cells(const Pace& pace);
  void add_cell(const Cell& cell, std::size_t number, std::uint32_t& hint,
                DistanceSums& sums) const;
  double bound_of(const std::vector<Sample>& points) const;
  double bound_at_vertices(const Cell& cell) const;
  double greatest_in(std::uint32_t first, double found, FieldSampler& field) const;
  double refined(const Cell& cell, const Trilinear& phi, const Vec3& low, double side,
                 double found) const;

  const TriangleMesh& mesh_;
  const TriangleMesh& surface_;
  const Clay& clay_;
  std::optional<MeshDistance> left_out_;
  Box3 left_out_box_;
  bool is_surface_;  ///< but for rounding: then the nearest triangle is in or beside the cell
  std::optional<TriangleRuns> runs_;     ///< where it is
  std::optional<MeshDistance> nearest_;  ///< where it is not
  double voxel_mm_;
  std::vector<Sample> at_vertex_;
  std::vector<float> bound_;  ///< of the cell whose first triangle this is, without the tight bulge
};

}  // namespace argil::io
