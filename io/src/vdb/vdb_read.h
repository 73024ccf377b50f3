// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <openvdb/MetaMap.h>
#include <openvdb/math/Transform.h>

#include "argil/core/result.h"
#include "argil/engine/storage.h"

namespace argil::io {

/// What stands before the nodes of a grid.
struct GridHead {
  std::string name;
  openvdb::math::Transform::Ptr transform;  ///< of cubic voxels, be they turned or moved
  float background = 0.0F;                  ///< finite
};

/// Says, by the description of the file and the head of a grid, who takes its nodes; null for
/// nobody: they are looked at all the same.
using SinkFor = std::function<LevelSink*(const openvdb::MetaMap& meta, const GridHead& head)>;

struct NamedGrid {
  std::string name;
  bool is_read = false;  ///< false for a grid of another type, or with other than cubic voxels
};

/// What a VDB file says of itself, and the grids that it holds.
struct VdbContent {
  openvdb::MetaMap meta;  ///< of type int32, int64, float, double and string
  std::vector<NamedGrid> grids;
};

/// Reads a file as OpenVDB 10 writes it (format 224), with grids of floats in trees 5-4-3. Every
/// number is looked at before it is used, so that nothing a file may hold harms the program:
/// OpenVDB itself trusts what it reads, and writes where it says. Values that are not finite are
/// refused. What a sink was handed before an error means nothing.
///
/// Errors  bad_input, without the file's name: what is wrong, and at which byte; interrupted, when
///         interrupted() says so (safe_file.h).
/// Threads  decompresses on all.
/// Memory   leaves are decompressed to where the sink keeps them.
/// Cost     docs/files.md.
Result<VdbContent> read_vdb(std::span<const std::byte> bytes, const SinkFor& sink_for);

}  // namespace argil::io
