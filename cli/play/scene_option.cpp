// SPDX-License-Identifier: GPL-3.0-or-later
#include "play/scene_option.h"

#include <cassert>
#include <vector>

namespace argil::cli {
namespace {

/// `k=800`
void read_setting(const std::string& text, SceneSettings& settings) {
  const std::size_t equals = text.find('=');
  double value = 0.0;
  if (equals == 0 || equals == std::string::npos ||
      !CLI::detail::lexical_cast(text.substr(equals + 1), value)) {
    throw CLI::ValidationError("--set is '" + text + "'; must be NAME=NUMBER, such as k=800");
  }
  settings[text.substr(0, equals)] = value;
}

}  // namespace

CLI::Option* add_scene_settings(CLI::App& command, SceneSettings& settings) {
  return command
      .add_option_function<std::vector<std::string>>(
          "--set",
          [&settings](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) read_setting(text, settings);
          },
          "a number of the scene; again for another one")
      ->type_name("NAME=NUMBER")
      ->allow_extra_args(false)
      ->take_all();
}

void check_scene_settings(std::span<const haptics::SceneParameter> parameters,
                          const SceneSettings& settings) {
  if (const auto good = haptics::SceneValues(parameters).set_all(settings); !good) {
    throw CLI::ValidationError("--set: " + good.error().message + " ('argil lab --list')");
  }
}

haptics::SceneValues scene_values(std::span<const haptics::SceneParameter> parameters,
                                  const SceneSettings& settings) {
  haptics::SceneValues values(parameters);
  const bool is_set = values.set_all(settings).ok();
  assert(is_set);
  static_cast<void>(is_set);
  return values;
}

}  // namespace argil::cli
