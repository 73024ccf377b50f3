// SPDX-License-Identifier: GPL-3.0-or-later
// What the window finds when it opens, and keeps for the next one.
#include <filesystem>
#include <system_error>
#include <utility>

#include "app/app.h"
#include "base/text.h"
#include "commands/favourites.h"
#include "commands/preset_choice.h"
#include "document/document.h"
#include "keys/key_file.h"
#include "settings/settings.h"

namespace argil::viewer {

/// A file that cannot be read is told of, and all is as without it.
void App::read_habits() {
  if (auto keys = read_keys(home_)) {
    ui_.keys = std::move(keys).value();
  } else {
    ui_.notices.push_back({Notice::Kind::warning, keys.error().message});
  }
  kept_keys_ = ui_.keys;
  if (auto favourites = read_favourites(home_)) {
    ui_.favourites = std::move(favourites).value();
  } else {
    ui_.notices.push_back({Notice::Kind::warning, favourites.error().message});
  }
  kept_favourites_ = ui_.favourites;
  PresetList list = read_presets(home_);
  ui_.presets = std::move(list.presets);
  for (const Error& problem : list.problems) {
    ui_.notices.push_back({Notice::Kind::warning, problem.message});
  }
}

/// Each is a file of its own, so that it can be copied from and to other homes.
void App::keep_presets() {
  PresetChoice& choice = ui_.preset_choice;
  for (const std::string& name : std::exchange(choice.to_remove, {})) {
    std::error_code error;
    std::filesystem::remove(preset_file(home_, name), error);
    if (error) {
      tell({Notice::Kind::warning, "cannot remove the file of the brush " + in_quotes(name) + ": " +
                                       error.message() + "; it is back at the next start"});
    }
  }
  for (const std::string& name : std::exchange(choice.to_write, {})) {
    const BrushPreset* preset = preset_named(name, ui_);
    if (preset == nullptr) continue;
    if (auto kept = write_preset(home_, *preset); !kept) {
      tell({Notice::Kind::warning, kept.error().message});
    }
  }
}

/// One that was dropped on the window.
void App::take_preset(const std::filesystem::path& file) {
  const auto taken = import_preset(home_, file);
  if (!taken) return tell(notice_of(taken.error()));
  ui_.presets = read_presets(home_).presets;
  ui_.panels.has_presets = true;
  choose_preset(taken.value(), ui_);
  tell({Notice::Kind::done, "took over the brush " + in_quotes(taken.value().name)});
}

void App::keep_settings() {
  keep_keys();
  keep_presets();
  keep_favourites();
  if (ui_.settings == kept_settings_) return;
  const Settings former = std::exchange(kept_settings_, ui_.settings);
  if (auto kept = write_changes(home_, former, ui_.settings); !kept) {
    tell({Notice::Kind::warning, kept.error().message});
  }
}

void App::keep_favourites() {
  if (ui_.favourites == kept_favourites_) return;
  kept_favourites_ = ui_.favourites;
  if (auto kept = write_favourites(home_, ui_.favourites); !kept) {
    tell({Notice::Kind::warning, kept.error().message});
  }
}

void App::keep_keys() {
  if (ui_.keys == kept_keys_) return;
  kept_keys_ = ui_.keys;
  if (auto kept = write_keys(home_, ui_.keys); !kept) {
    tell({Notice::Kind::warning, kept.error().message});
  }
}

}  // namespace argil::viewer
