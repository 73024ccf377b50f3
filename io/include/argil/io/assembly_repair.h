// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/io/assembly.h"
#include "argil/io/mesh_repair.h"

namespace argil::io {

struct RepairedAssembly {
  Assembly assembly;
  std::vector<RepairReport> reports;  ///< of each object
};

/// repair_mesh of each object by itself, in its own frame; names, colors and places stay. Parts
/// that touch or overlap each other are not united.
///
/// Errors  as repair_mesh, naming the part.
/// Threads, determinism, cost   those of repair_mesh.
Result<RepairedAssembly> repair_assembly(Assembly assembly, const RepairOptions& options = {},
                                         const Progress& progress = {});

}  // namespace argil::io
