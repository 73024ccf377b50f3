// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"

#include "edits/row.h"

namespace argil::evaluation {

struct EditResult {
  std::vector<EditRow> rows;
  std::vector<std::string> skipped;  ///< what is not there, and why
};

/// All strokes of the chart, by Argil and by those rivals that are here.
///
/// Errors  interrupted; disk. Where a rival fails it is named among what was skipped.
/// Cost    a quarter of an hour and 8 GB; `quick` half a minute.
Result<EditResult> measure_edits(bool quick, const Progress& progress);

}  // namespace argil::evaluation
