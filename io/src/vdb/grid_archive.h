// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "argil/core/result.h"

#include "vdb/vdb_tree.h"

namespace argil::io {

/// Writes a grid as openvdb::io::File does, with its offset, but tells when the disk did not take
/// it. Neither synced nor renamed: for replace_file.
Result<void> write_grid(const std::filesystem::path& file, const VdbGrid::Ptr& grid);

}  // namespace argil::io
