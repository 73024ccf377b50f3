// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "argil/core/result.h"
#include "argil/haptics/scene/scene.h"
#include "argil/haptics/simulation/hand_model.h"

#include "bridge/bridge.h"

namespace argil::cli::bridge {

/// Whether clay or a scene may be felt as the options say: what a rig may do with them holds at the
/// bridge too.
/// Errors  bad_input naming the option, its value and its range.
Result<void> check_own_force(const BridgeOptions& options);

/// The scene that --scene names; null without.
std::unique_ptr<haptics::ForceScene> make_scene(const BridgeOptions& options);

/// What the lab's hand does in that scene.
std::vector<haptics::HandKey> scene_motion(const BridgeOptions& options);

/// Its name and all its parameters; null without a scene.
Json scene_json(const BridgeOptions& options);

}  // namespace argil::cli::bridge
