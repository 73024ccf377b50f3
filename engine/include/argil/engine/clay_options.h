// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "argil/core/result.h"

namespace argil {

/// Half width of every level's narrow band in voxels of that level: the stored distance is exact
/// within it and clamped to it beyond.
inline constexpr int kHalfWidthVoxels = 4;

/// Node coordinates of every level stay within +-kMaxNode: +-13 m at 0.05 mm.
inline constexpr int kMaxNode = 1 << 18;

/// Finer voxels are beyond what OpenVDB can place, coarser ones beyond what a hand can feel.
inline constexpr double kLeastVoxelMm = 1e-4;
inline constexpr double kMostVoxelMm = 1e3;

/// What a clay is made with and keeps; Resample alone changes it.
struct ClayOptions {
  double voxel_mm = 0.25;  ///< h_0, the finest detail; kLeastVoxelMm to kMostVoxelMm

  /// How far the surface of a coarser level may miss the finer one before the finer is dropped, as
  /// a fraction of voxel_mm; 0.01 to 0.5. Small keeps more, large loses detail.
  double tolerance_voxels = 0.1;

  /// The radius, in mm, of the edges that tools, cuts and combinations leave where their surface
  /// meets the clay's: convex ones are rounded and concave ones filled, as by a ball that rolls
  /// along them. 0 leaves them as sharp as the voxels allow, with the steps of the voxels; more
  /// than 2 voxels makes a soft joint. At most half of a tool's radius, and 2 voxels of the
  /// coarsest level for cuts and combinations. None: as little as shows no steps, a voxel of
  /// the level that holds the edge and 1.5 of the finest. 0 to kMostEdgeRadiusMm.
  std::optional<double> edge_radius_mm = std::nullopt;
};

inline constexpr double kMostEdgeRadiusMm = 1e3;

/// What everything that makes a clay asks first: what it lets pass can be saved and read again.
///
/// Errors       bad_input naming the option, its value and its range; NaN is out of range too.
Result<void> validate_options(const ClayOptions& options);

}  // namespace argil
