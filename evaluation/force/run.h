// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"

#include "force/row.h"
#include "force/station.h"

namespace argil::evaluation {

struct ForceRun {
  bool quick = false;      ///< a few scenes and radii, for tests
  unsigned long seed = 1;  ///< of positions, orientations and paths
};

struct ForceRunResult {
  std::vector<ForceRow> rows;
  std::vector<std::string> skipped;  ///< scenes that could not be had, and why
  ReferenceChange reference_change;
};

/// Measures every method on every scene with every tool.
/// Errors  as making clay and reading windows; interrupted.
Result<ForceRunResult> run_force_chart(const ForceRun& run, const Progress& progress);

}  // namespace argil::evaluation
