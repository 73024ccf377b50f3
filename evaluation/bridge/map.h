// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/haptics/analysis/hold_judgement.h"
#include "argil/haptics/bridge/bridge_law.h"

#include "chart/sheet.h"

namespace argil::evaluation {

/// A press of 3 N through a bridge to a simulator of that rate and delay.
struct BridgeMapRow {
  haptics::BridgeLaw law = haptics::BridgeLaw::plane;
  double rate_hz = 60.0;
  double delay_ms = 0.0;  ///< of the simulator, beyond the tick that a datagram takes
  double stiffness_n_per_m = 1500.0;
  haptics::HoldJudgement found;
};

/// Every law, rate, delay and stiffness of the map.
Result<std::vector<BridgeMapRow>> measure_bridge_map(bool quick, const Progress& progress);

std::string bridge_map_csv(const std::vector<BridgeMapRow>& rows);
Script bridge_map_script(const std::vector<BridgeMapRow>& rows);

}  // namespace argil::evaluation
