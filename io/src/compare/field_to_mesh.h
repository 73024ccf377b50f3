// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "argil/engine/field_sampler.h"
#include "argil/engine/mesh_distance.h"
#include "argil/mesh/triangle_geometry.h"

#include "compare/distance_sums.h"
#include "compare/extracted_surface.h"
#include "compare/field_error.h"
#include "compare/field_zeros.h"
#include "compare/triangle_runs.h"

namespace argil::io {

/// Distance of the points with phi = 0 from a mesh.
///
/// The points are those of surface_cells(), on lines along the axes: a line passes through an area
/// A with normal n in A |n_axis| / spacing^2 points, so that each point of the lines along all
/// three stands for spacing^2 / (|n_x| + |n_y| + |n_z|), also at sharp edges, where paths from a
/// triangle along the gradient would not reach.
///
/// For the greatest distance every cell has a bound: that of the extracted vertices in it, or where
/// some are not known of phi = 0 on its edges, from the planes of the triangles nearest to them,
/// and how much phi = 0 can bulge between them by the angles between its normals, first by those
/// that its gradient can have at all, then by those at its edges. Where that exceeds the greatest
/// distance found so far the cell is split in eight, and so on. Whether a bound is kept is another
/// question: BlockProof.
class FieldToMesh {
 public:
  /// Both must outlive this.
  FieldToMesh(const TriangleMesh& mesh, ExtractedSurface& surface);

  mesh::DistanceSummary measure(const Pace& pace);

 private:
  struct Sample {
    Vec3 at;
    double distance = 0.0;
    std::uint32_t nearest = kNoTriangle;
  };
  /// Where a cell lies.
  struct Cell {
    std::uint32_t number = 0;
    Vec3 low_mm;
    double side_mm = 0.0;
    Trilinear phi;

    Vec3 at(const Vec3& fraction) const noexcept { return low_mm + side_mm * fraction; }
  };

  Cell cell(std::uint32_t number) const;
  Sample sample_at(const Vec3& at, const Cell& cell, std::uint32_t hint, double enough) const;
  bool is_left_out(const Vec3& fraction, const Cell& cell) const;
  Sample sample_at_vertex(std::uint32_t v, std::uint32_t hint, FieldSampler& field) const;
  void find_nearest(const Pace& pace);
  void measure_vertices(const Pace& pace);
  DistanceSums measure_cells(const Pace& pace);
  void add_cell(const Cell& cell, std::size_t turn, std::uint32_t& hint, DistanceSums& sums) const;
  double bound_of(const std::vector<Sample>& points) const;
  double bound_at_vertices(const Cell& cell) const;
  double greatest_in(std::uint32_t number, double found) const;
  double refined(const Cell& cell, const Vec3& low, double side, double found) const;

  const TriangleMesh& mesh_;
  ExtractedSurface& extracted_;
  const TriangleMesh& surface_;
  bool is_surface_;  ///< but for rounding: then the nearest triangle is in or beside the cell
  std::optional<TriangleRuns> runs_;     ///< where it is
  std::optional<MeshDistance> nearest_;  ///< where it is not
  double voxel_mm_;
  std::vector<Sample> at_vertex_;
  std::vector<float> bound_;  ///< of each cell, without the tight bulge
};

}  // namespace argil::io
