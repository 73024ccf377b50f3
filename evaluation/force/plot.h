// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "chart/sheet.h"
#include "force/row.h"

namespace argil::evaluation {

/// How fast the machine can read at all: no method is faster than reading its nodes.
struct ReadRates {
  double small_bytes_per_us = 0.0;  ///< from a block of 64 KiB
  double large_bytes_per_us = 0.0;  ///< from a block of 1 MiB
};

/// Accuracy, ripple, the whole way from hand to force and time against the radius, from the pooled
/// rows.
std::vector<Script> force_scripts(const std::vector<ForceRow>& by_scene,
                                  const std::vector<ForceRow>& by_radius, const ReadRates& rates,
                                  const std::string& machine);

}  // namespace argil::evaluation
