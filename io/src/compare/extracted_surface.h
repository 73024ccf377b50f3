// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cassert>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "argil/core/pace.h"
#include "argil/core/triangle_mesh.h"
#include "argil/engine/clay.h"

#include "compare/cell_set.h"
#include "compare/left_out_parts.h"

namespace argil::io {

/// A surface as it was extracted, with what both proof and certificate ask of it: found once,
/// whoever needs it first.
///
/// Threads      any once it is prepared.
class ExtractedSurface {
 public:
  /// `left_out`: components that were taken out of `mesh`. All must outlive this.
  ExtractedSurface(const TriangleMesh& mesh, const Clay& clay, const TriangleMesh& left_out)
      : mesh_(mesh), clay_(clay), left_out_(left_out) {}

  /// Finds its cells where that was not done. Throws Interrupted.
  void prepare(const Pace& pace) {
    if (is_prepared_) return;
    cells_ = surface_cells(mesh_, clay_, pace.part(0.0, 0.9));
    if (!left_out_.triangles.empty()) {
      parts_.emplace(mesh_, left_out_, cells_, voxel_mm(), pace.part(0.9, 1.0));
    }
    is_prepared_ = true;
  }

  const TriangleMesh& mesh() const noexcept { return mesh_; }
  const Clay& clay() const noexcept { return clay_; }
  double voxel_mm() const { return clay_.options().voxel_mm; }
  const std::vector<SurfaceCell>& cells() const noexcept {
    assert(is_prepared_);
    return cells_;
  }
  /// LeftOutParts::has_all.
  bool is_left_out(std::uint32_t cell, const Vec3& low, double side) const {
    assert(is_prepared_);
    return parts_ && parts_->has_all(cell, low, side);
  }
  /// LeftOutParts::ambiguous, of left_out().
  std::span<const std::uint32_t> ambiguous() const {
    assert(is_prepared_);
    return parts_ ? parts_->ambiguous() : std::span<const std::uint32_t>{};
  }
  const TriangleMesh& left_out() const noexcept { return left_out_; }

 private:
  const TriangleMesh& mesh_;
  const Clay& clay_;
  const TriangleMesh& left_out_;
  bool is_prepared_ = false;
  std::vector<SurfaceCell> cells_;
  std::optional<LeftOutParts> parts_;
};

}  // namespace argil::io
