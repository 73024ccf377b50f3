// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <span>
#include <string>

#include "argil/haptics/scene/scene_parameters.h"

#include "common/options.h"

namespace argil::cli {

/// Parameters of a scene that are not to be usual, by name.
using SceneSettings = std::map<std::string, double>;

/// --set NAME=NUMBER, as often as wanted; the scene may follow it on the command line.
CLI::Option* add_scene_settings(CLI::App& command, SceneSettings& settings);

/// What was set must be of the scene and in range, once all options are read. Throws
/// CLI::ValidationError.
void check_scene_settings(std::span<const haptics::SceneParameter> parameters,
                          const SceneSettings& settings);

/// Parameters as they are set, the others usual. The settings have been checked.
haptics::SceneValues scene_values(std::span<const haptics::SceneParameter> parameters,
                                  const SceneSettings& settings);

}  // namespace argil::cli
