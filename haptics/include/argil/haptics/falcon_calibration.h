// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "argil/core/result.h"
#include "argil/core/vec3.h"
#include "argil/haptics/falcon_kinematics.h"

namespace argil::haptics {

/// What differs from one Falcon to the next, and from one source to the next.
struct FalconCalibration {
  FalconGeometry geometry = martin_hillier_geometry();
  /// Where the device's 0 lies in the frame of falcon_kinematics.h; within reach.
  Vec3 center_mm = kFalconCenterMm;
  /// How far in front of it the grip has to be pulled, once, before it gives any force; 0 to 60.
  double pulled_out_mm = 40.0;
  /// The force that keeps a grip that was let go from sinking; each -3 to 3.
  Vec3 gravity_n;
  double mass_kg = 0.4589;         ///< as the servo takes it to be: 0.05 to 5
  double damping_n_s_per_m = 3.0;  ///< the same: 0.1 to 50; more than it has lets stiff matter buzz
};

/// "libnifalcon" or "martin-hillier" with the geometry of that name.
/// Errors  bad_input, naming both.
Result<FalconCalibration> named_falcon_calibration(std::string_view name);

/// A calibration as text: lines `key = value`, `#` begins a comment. The first key is
/// `argil_falcon_calibration = 1`, then `set = NAME`, which gives all that is not named after it.
/// Keys are the members above and those of FalconGeometry; three numbers are parted by commas.
/// docs/falcon.md has the list; the installed share/argil/falcon has both sets, whole.
///
/// Errors  bad_input: `name`, the line, and what its value must be; or constants that do not make
/// an
///         arm which reaches center_mm.
Result<FalconCalibration> parse_falcon_calibration(std::string_view text, const std::string& name);

/// Errors  as parse_falcon_calibration, and bad_input when the file cannot be read.
Result<FalconCalibration> read_falcon_calibration(const std::filesystem::path& file);

}  // namespace argil::haptics
