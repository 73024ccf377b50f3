// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"

#include "operations/body.h"
#include "operations/method.h"
#include "operations/row.h"

namespace argil::evaluation {

struct OperationsOptions {
  /// Vertices of the bodies, in millions.
  std::vector<double> million{0.1, 0.5};
  int most_runs = 3;  ///< of each time; fewer where they take long
};

struct OperationsResult {
  std::vector<OperationRow> rows;
  std::vector<std::string> skipped;  ///< what is not there, failed or would take too long
};

/// Every task by every method on a wavy ball and a block, and what makes meshes of their clay.
/// Errors  interrupted; disk.
Result<OperationsResult> measure_operations(const OperationsOptions& options,
                                            const Progress& progress);

/// Runs `once` up to `most` times, or until 5 seconds of CPU are over, and tells the row.
Result<void> time_runs(int most, const std::function<Result<RunTime>()>& once, OperationRow& row);

/// Says that something of a row's was left out, and why.
void skip_row(const OperationRow& row, const std::string& why, OperationsResult& result);

/// Fewer triangles and files of Argil's clay of a body, against that clay.
Result<void> measure_meshes_of_clay(const WorkedBody& body, int most_runs,
                                    OperationsResult& result);

}  // namespace argil::evaluation
