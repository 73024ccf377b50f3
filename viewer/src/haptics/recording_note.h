// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "argil/haptics/rig/rig.h"

namespace argil::viewer {

/// What a recording was made of, on one line, so that it can be set up again: the clay's name, and
/// `name=value` of what the rig was started with. What is usual of mix, filter, damping, vibration
/// and guidance is left out; a path is written point by point, "path=x y z; x y z", in mm of the
/// clay.
std::string recording_note(const std::string& clay, const haptics::RigOptions& options);

}  // namespace argil::viewer
