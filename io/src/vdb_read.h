// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "argil/core/result.h"

#include "vdb.h"

namespace argil::io {

struct NamedGrid {
  std::string name;
  VdbGrid::Ptr grid;  ///< null for a grid of another type, or with other than cubic voxels
};

/// What a VDB file says and holds.
struct VdbContent {
  openvdb::MetaMap meta;  ///< of type int32, int64, float, double and string
  std::vector<NamedGrid> grids;
};

/// Reads a file as OpenVDB 10 writes it (format 224), with grids of floats in trees 5-4-3. Every
/// number is looked at before it is used, so that nothing a file may hold harms the program:
/// OpenVDB itself trusts what it reads, and writes where it says.
///
/// Errors  bad_input, without the file's name: what is wrong, and at which byte.
/// Threads  decompresses on all.
/// Cost     docs/files.md.
Result<VdbContent> read_vdb(std::span<const std::byte> bytes);

}  // namespace argil::io
