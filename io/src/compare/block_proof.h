// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "argil/core/pace.h"
#include "argil/engine/field_sampler.h"
#include "argil/mesh/decimate.h"

#include "compare/cell_sheets.h"
#include "compare/extracted_surface.h"
#include "compare/sampler_pool.h"

namespace argil::io {

/// Proves by a clay's field that mesh and field lie within a bound of each other.
///
/// The field to the mesh, cell by cell: a box whose corners have one sign has no point with
/// phi = 0, which is trilinear, and no point of a box lies farther than its middle and half its
/// diagonal. What that does not settle is cut in eight.
///
/// The mesh to the field, triangle by triangle: TriangleQuestion.
class BlockProof final : public mesh::BoundProof {
 public:
  /// What of phi = 0 is provably of components that were left out of the surface does not count
  /// (LeftOutParts). The surface must outlive this. Throws Interrupted.
  BlockProof(ExtractedSurface& surface, double bound_mm, const Pace& pace);

  std::uint32_t cells() const override {
    return static_cast<std::uint32_t>(surface_.cells().size());
  }
  std::uint32_t vertex_of(std::uint32_t cell) const override {
    return surface_.mesh().triangles[surface_.cells()[cell].first][0];
  }
  std::span<const std::uint32_t> other_vertices_of(std::uint32_t cell) const override {
    return sheets_->others_in(cell);
  }
  bool is_near(std::uint32_t cell, mesh::NearTriangles& mesh) const override;
  bool is_near_at_once(std::uint32_t cell, mesh::NearTriangles& mesh) const override;
  void ask_triangles(std::span<const mesh::Corners> triangles,
                     std::span<std::uint8_t> is_near) const override;

 private:
  class CellQuestion;

  const ExtractedSurface& surface_;
  std::optional<CellSheets> sheets_;  ///< always there
  double bound_mm_;
  double voxel_mm_;
  mutable SamplerPool samplers_;
};

}  // namespace argil::io
