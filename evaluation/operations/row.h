// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "argil/core/triangle_mesh.h"

namespace argil::evaluation {

/// How far a result is from what was asked, in finest voxels of the body before. Ranks and rms are
/// over its area.
struct OperationError {
  std::optional<double> p50;  ///< none of decimation and export
  std::optional<double> p99;
  double rms = 0.0;
  double max = 0.0;
  /// How far the farthest of half a million vertices of the body is from the result, where it
  /// should lie on it.
  std::optional<double> missed;
  /// Of a union, the greatest within two voxels of the seam; what stands above is from beyond.
  std::optional<double> seam;
};

/// One operation on one body by one method.
struct OperationRow {
  std::string operation;
  std::string body;
  std::string method;
  double million = 0.0;       ///< vertices of the body (WorkedBody)
  std::int64_t vertices = 0;  ///< of the result
  double cpu_s = 0.0;         ///< of all threads, median of the runs
  double least_cpu_s = 0.0;
  double most_cpu_s = 0.0;
  double wall_s = 0.0;  ///< median
  int runs = 0;
  OperationError error;
  std::uint64_t hash = 0;  ///< of the result
};

/// Fills in what a row tells of a result.
void describe_result(const TriangleMesh& result, OperationRow& row);

std::string operations_csv(const std::vector<OperationRow>& rows);

}  // namespace argil::evaluation
