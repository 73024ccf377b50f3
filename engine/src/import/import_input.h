// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/engine/clay_options.h"

namespace argil {

/// Of a leaf at an import's peak: values, mask, tree, lists. Measured on the shared models
/// (docs/import.md).
inline constexpr std::uint64_t kBytesPerLeaf = 2400;

/// A mesh made ready for import: checked, welded, without triangles of no area, moved so that the
/// centre of its bounds is the origin (floats of the ray tree are finest there).
struct ImportInput {
  std::vector<Vec3> positions;      ///< mm, relative to `center`
  std::vector<Triangle> triangles;  ///< never of zero area
  std::vector<Triangle> flat;  ///< of zero area: rounded, they close what their neighbours open
  Vec3 center;                 ///< mm
  double voxel_mm = 0.0;
  double area_mm2 = 0.0;
  Box3 bounds;          ///< relative to `center`
  bool closed = false;  ///< every edge is run along as often one way as the other
};

/// Errors  bad_input naming the fault: no triangles, an index or a coordinate that is none, an
///         extent that voxels of this size cannot hold, options out of range.
Result<ImportInput> prepare_import(const TriangleMesh& mesh_mm, const ClayOptions& options);

/// What importing at this voxel size is estimated to need at its peak, surface extraction included.
std::uint64_t estimated_bytes(const ImportInput& input, double voxel_mm);

/// Success when the estimate fits `limit_bytes` (0: nine tenths of available_bytes), else
/// ErrorKind::memory naming need, limit and the voxel size that fits.
Result<void> check_memory(const ImportInput& input, std::uint64_t limit_bytes);

}  // namespace argil
