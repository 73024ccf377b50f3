// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "argil/core/result.h"

#include "vdb/vdb_tree.h"

namespace argil::io {

/// Writes as openvdb::io::File does, with grid offsets, but tells when the disk did not take it.
/// Neither synced nor renamed: for replace_file.
Result<void> write_vdb(const std::filesystem::path& file, const openvdb::GridCPtrVec& grids,
                       const openvdb::MetaMap& meta);

}  // namespace argil::io
