// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "argil/core/pace.h"
#include "argil/core/triangle_mesh.h"
#include "argil/engine/clay.h"
#include "argil/engine/field_sampler.h"
#include "argil/engine/mesh_distance.h"
#include "argil/mesh/decimate.h"

#include "compare/block_slopes.h"
#include "compare/sampler_pool.h"

namespace argil::io {

/// Proves by a clay's field that mesh and field lie within a bound of each other.
///
/// The field to the mesh, cell by cell: a box whose corners have one sign has no point with
/// phi = 0, which is trilinear, and no point of a box lies farther than its middle and half its
/// diagonal. What that does not settle is cut in eight.
///
/// The mesh to the field, triangle by triangle, in pieces of some voxels: along a way from the
/// middle phi is no farther from its linear continuation than its slopes in the cells there are
/// from that at the middle. Where levels meet phi may jump: there its difference from the linear
/// continuation is greatest and least at corners of the parts of cells in a box around the piece,
/// since both are linear along each axis.
/// What that does not settle is cut in four.
class BlockProof final : public mesh::BoundProof {
 public:
  /// The cells are those with a part of phi = 0 that `surface`, as extracted, stands for; points
  /// nearer to `left_out` do not count. All must outlive this. Throws Interrupted.
  BlockProof(const TriangleMesh& surface, const Clay& clay, const TriangleMesh& left_out,
             double bound_mm, const Pace& pace);

  std::uint32_t cells() const override { return static_cast<std::uint32_t>(cells_.size()); }
  std::uint32_t vertex_of(std::uint32_t cell) const override {
    return surface_.triangles[cells_[cell].first][0];
  }
  bool is_near(std::uint32_t cell, mesh::NearTriangles& mesh) const override;
  void ask_triangles(std::span<const mesh::Corners> triangles,
                     std::span<std::uint8_t> is_near) const override;

 private:
  /// A cell and triangles of the surface that lie in it or beside it, `count` from `first` on.
  struct Cell {
    std::array<float, 8> corners;
    Vec3 low_mm;
    double side_mm = 0.0;
    std::uint32_t first = 0;
    std::uint32_t count = 0;
  };
  class CellQuestion;
  class CellSet;

  void find_cells(std::size_t begin, std::size_t end, CellSet& cells) const;
  bool is_left_out(const Vec3& at, const Cell& cell) const;

  const TriangleMesh& surface_;
  const Clay& clay_;
  std::optional<MeshDistance> left_out_;
  double bound_mm_;
  double voxel_mm_;
  std::vector<Cell> cells_;
  mutable SamplerPool samplers_;
  mutable BlockSlopes slopes_;
};

}  // namespace argil::io
