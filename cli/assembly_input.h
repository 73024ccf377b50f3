// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/io/assembly.h"
#include "argil/mesh/part_gaps.h"

#include "common/outcome.h"
#include "mesh_input.h"

namespace argil::cli {

/// Of lists of parts and of pairs for a person; --json has all.
inline constexpr std::size_t kMostPartsSaid = 20;
inline constexpr std::size_t kMostPairsSaid = 10;

/// io::read_assembly; what it doubts and left out is told on stderr.
Result<io::ReadAssembly> open_assembly(const std::filesystem::path& file,
                                       const MeshFrameOptions& options);

/// The meshes of all parts where they stand, and their names.
struct StandingParts {
  std::vector<std::string> names;
  std::vector<TriangleMesh> meshes;
};
StandingParts standing_parts(const io::Assembly& assembly);

/// mesh::part_gaps; nothing, and a note on stderr, where there are more than mesh::kMostParts.
/// Errors  interrupted; memory.
Result<std::vector<mesh::PartGap>> gaps_between(const StandingParts& parts, double reach_mm,
                                                const Progress& progress);

/// {"parts":[NAME,NAME],"gap_mm","at_mm","within"}
Json gaps_json(const std::vector<mesh::PartGap>& gaps, const std::vector<std::string>& names);
/// "'Lid' and 'Body' are 0.2 mm apart at 1, 2, 3 mm"
std::string gap_text(const mesh::PartGap& gap, const std::vector<std::string>& names);

/// "3 parts: 'Foot', 'Head', 'Shade'"
std::string parts_text(const std::vector<std::string>& names);

/// A file name without an ending for each part: what file systems mind becomes '_', and
/// names that would be one, also without regard to upper and lower case, are numbered.
std::vector<std::string> file_stems(const std::vector<std::string>& names);

}  // namespace argil::cli
