// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/engine/clay.h"
#include "argil/engine/operation.h"

#include "edit/history.h"
#include "operation/solid.h"

namespace argil {

/// One combination with a solid.
struct CombineStep {
  CombineKind kind = CombineKind::unite;
  std::unique_ptr<Solid> solid;
};

/// What an operation is going to do, found while the clay is as it was: replace all levels, or
/// combine with solids one after the other.
struct PreparedOperation {
  std::optional<FormerLevels> levels;
  std::vector<CombineStep> steps;
  std::string if_empty;      ///< what to say when a step leaves nothing
  std::vector<Clay> others;  ///< that solids of `steps` refer to
};

// Each checks the numbers of one operation and prepares it.
Result<PreparedOperation> prepare(const Clay& clay, const Offset& offset, const Progress& progress);
Result<PreparedOperation> prepare(const Clay& clay, const Hollow& hollow, const Progress& progress);
Result<PreparedOperation> prepare(const Clay& clay, const Cut& cut, const Progress& progress);
Result<PreparedOperation> prepare(const Clay& clay, const Combine& with, const Progress& progress);
Result<PreparedOperation> prepare(const Clay& clay, const Resample& to, const Progress& progress);

Error bad_operation(std::string message);
Error operation_interrupted();
/// Up to six significant digits.
std::string digits(double value);
/// "(x, y, z)"
std::string digits(const Vec3& v);

/// The longest side of the clay in mm.
double longest_side_mm(const Clay& clay);

}  // namespace argil
