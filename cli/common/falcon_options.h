// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "argil/haptics/falcon/falcon_device.h"

#include "common/command.h"

namespace argil::cli {

/// What the command line says of a Falcon.
struct FalconChoice {
  std::string firmware;
  std::string serial;
  std::string calibration = "martin-hillier";  ///< or libnifalcon, or a file
  bool flushes_at_packet_end = false;

  bool operator==(const FalconChoice&) const = default;
};

void add_falcon_options(CLI::App& command, FalconChoice& choice);

/// What a device is opened with. Errors  bad_input of the calibration.
Result<haptics::FalconOptions> falcon_options(const FalconChoice& choice);

/// Waits until its firmware answers: unhomed or active. Errors  device; interrupted.
Result<void> wait_for_firmware(haptics::FalconDevice& falcon, const Progress& progress);

/// Guides a person on stderr, unless `quiet`, until it is homed and was pulled out.
/// Errors  device, also when that took longer than `seconds`; interrupted.
Result<void> guide_home(haptics::FalconDevice& falcon, double seconds, bool quiet,
                        const Progress& progress);

/// Opens the one meant and guides a person, for a minute at most, until it gives forces.
/// Errors  as these three and FalconDevice::open.
Result<std::unique_ptr<haptics::Device>> open_homed_falcon(const FalconChoice& choice, bool quiet,
                                                           const Progress& progress);

}  // namespace argil::cli
