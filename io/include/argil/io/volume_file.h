// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/engine/clay.h"

namespace argil::io {

struct VolumeReport {
  double voxel_mm = 0.0;
  std::int64_t active_voxels = 0;
  std::int64_t leaves = 0;
  std::int64_t bytes = 0;  ///< in memory
};

/// The field as one grid that other programs read: an OpenVDB float grid "surface", class level
/// set, in mm, at the finest voxel everywhere, three voxels to each side of the surface, then
/// +-3 voxels. Where the clay has leaves of its finest level the values are theirs to the bit; else
/// what Clay::distance_at says of the point. A mask is left out. This is not a project: what coarse
/// and fine detail there was is gone.
///
/// Errors   bad_input when the clay is empty; memory, with the remedy, when the finest voxel makes
///          more leaves than ClayUse::free_bytes holds; disk; interrupted. The file appears whole
///          or stays as it was.
/// Threads  as Clay; spreads over TBB. Same voxels for any number of threads.
/// Cost     about 80 ns of CPU time for each node of a leaf looked at, about twice those written;
///          2.5 KB of memory for each leaf written.
Result<VolumeReport> export_volume(const std::filesystem::path& file, const Clay& clay,
                                   const Progress& progress = {});

}  // namespace argil::io
