// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <openvdb/MetaMap.h>

#include "argil/core/result.h"
#include "argil/engine/sculpture.h"

namespace argil::io {

// What a project says of itself before its grids (docs/files.md).

/// One clay of a file.
struct PieceHeader {
  PieceLook look;
  ClayOptions options;
  int levels = 0;
  bool has_mask = false;

  std::string level_name(int level) const;
  std::string mask_name() const;
  /// Nodes of the mask are farther apart than those of the finest level.
  double mask_voxel_mm() const;

  std::string grid_front = {};  ///< that the names of its grids begin with
};

struct ProjectHeader {
  std::vector<PieceHeader> pieces;
  std::size_t active = 0;
  std::string hash;  ///< of the sculpture
};

/// That of a sculpture with its hash. A plain one has a file as if there were no pieces.
ProjectHeader header_of(const Sculpture& sculpture, std::uint64_t hash);
/// That of a clay alone.
ProjectHeader header_of(const Clay& clay, std::uint64_t hash);

openvdb::MetaMap project_metadata(const ProjectHeader& header);

/// Errors  bad_input naming the file and what it says that cannot be.
Result<ProjectHeader> read_project_header(const std::filesystem::path& file,
                                          const openvdb::MetaMap& meta);

/// The hash that a project says it has, of which nothing is checked; empty where it says none, or
/// is not to be had.
std::string stated_hash(const std::filesystem::path& file);

/// bad_input: the file and what is wrong with it.
Error refused_project(const std::filesystem::path& file, const std::string& what);

}  // namespace argil::io
