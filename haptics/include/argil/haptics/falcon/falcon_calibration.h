// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "argil/core/result.h"
#include "argil/core/vec3.h"
#include "argil/haptics/falcon/falcon_kinematics.h"

namespace argil::haptics {

/// What differs from one Falcon to the next, and from one source of its constants to the next.
struct FalconCalibration {
  FalconGeometry geometry = martin_hillier_geometry();
  /// Where the device's 0 lies in the frame of falcon_kinematics.h; within reach.
  Vec3 center_mm = kFalconCenterMm;
  /// How far in front of it the grip has to be pulled, once, before it gives any force; usual 40,
  /// 0 to 60.
  double pulled_out_mm = 40.0;
  /// The force that keeps a grip that was let go from sinking; usual 0, each -3 to 3.
  Vec3 gravity_n;
  /// As the servo takes it to be; usual 0.4589, 0.05 to 5.
  double mass_kg = 0.4589;
  /// As the servo takes it to be; usual 3, 0.1 to 50. More than the device has lets stiff matter
  /// buzz.
  double damping_n_s_per_m = 3.0;
};

/// The calibration whose geometry has this name: "libnifalcon" or "martin-hillier".
///
/// Errors  bad_input, naming both.
Result<FalconCalibration> named_falcon_calibration(std::string_view name);

/// Reads a calibration from text: lines `key = value`, `#` begins a comment. The first key is
/// `argil_falcon_calibration = 1`, the second `set = NAME`, which gives all that is not named after
/// it. Keys are the members above and those of FalconGeometry; three numbers are separated by
/// commas. docs/falcon.md has the list; the installed share/argil/falcon has both sets in full.
///
/// Errors  bad_input naming `name`, the line, and what its value must be; or where the constants do
///         not make an arm that reaches center_mm.
Result<FalconCalibration> parse_falcon_calibration(std::string_view text, const std::string& name);

/// The same from a file.
///
/// Errors  as parse_falcon_calibration, and bad_input when the file cannot be read.
Result<FalconCalibration> read_falcon_calibration(const std::filesystem::path& file);

}  // namespace argil::haptics
