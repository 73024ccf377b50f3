// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/engine/clay.h"

namespace argil {

/// The one surface over all levels of a clay, kept block by block: a block is the cells of one leaf
/// that no finer leaf covers. Closed, two-manifold, without self-intersection, normals outward from
/// grad phi.
///
/// Threads   as Clay: the clay thread; spreads work with TBB; bits do not depend on thread count.
/// Accuracy  on a ball of 32 voxels radius at most 0.025 voxel, on average 0.005
///           (SurfaceAccuracy.*); where levels meet, that of the coarser.
/// Cost      about 0.11 us per triangle where levels do not meet, ten times that where they do;
///           memory about 50 bytes per triangle.
/// Source    docs/surface.md: "the finer side decides the face".
class Surface {
 public:
  Surface();
  Surface(Surface&&) noexcept;
  Surface& operator=(Surface&&) noexcept;
  ~Surface();

  /// Brings the surface up to date: extracts only the blocks that the edits since the last update
  /// touched (all of them on the first call or with another clay). Returns how many were extracted.
  std::int64_t update(const Clay& clay);

  std::int64_t triangle_count() const noexcept;

  /// All blocks welded to one mesh by the keys of the lattice edges the vertices lie on; the same
  /// mesh, bit for bit, whatever the history of updates.
  TriangleMesh weld() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Shorthand for a first update and a weld.
TriangleMesh extract_surface(const Clay& clay);

/// The same, asked every few milliseconds whether to go on.
/// Errors  interrupted.
Result<TriangleMesh> extract_surface(const Clay& clay, const Progress& progress);

/// The box around the surface, as that of extract_surface's vertices to the bit
/// (SurfaceBounds.AreThoseOfTheWholeSurface); empty where there is none. Extracts the blocks at
/// its ends alone, so that it can be asked after each stroke: some 20 ns for each other leaf.
Box3 surface_bounds_mm(const Clay& clay);

}  // namespace argil
