// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include <openvdb/MetaMap.h>
#include <openvdb/Types.h>

#include "argil/core/result.h"
#include "argil/engine/operation.h"
#include "argil/engine/storage.h"

namespace argil::io {

/// A grid of floats: what stands before its nodes, and who shows them.
struct GridToWrite {
  std::string name;
  openvdb::GridClass grid_class = openvdb::GRID_UNKNOWN;
  double voxel_mm = 1.0;
  float background = 0.0F;
  std::function<void(LevelVisitor&)> show;
  Placement placement = {};  ///< of unit length
};

/// Writes a file as OpenVDB 10 does (format 224; active values, Blosc), but tells when the disk did
/// not take it, compresses each leaf once and on all threads, and takes it from where it lies: of
/// the values no more than a batch of leaves is kept, of the rest 200 bytes a leaf. `identity`
/// takes the place of the random UUID, so that the same clay gives the same bytes. Neither sealed,
/// synced nor renamed.
///
/// Errors  disk; interrupted, when interrupted() says so (safe_file.h).
/// Cost    docs/files.md.
Result<void> write_vdb(const std::filesystem::path& file, const openvdb::MetaMap& meta,
                       std::uint64_t identity, std::span<const GridToWrite> grids);

}  // namespace argil::io
