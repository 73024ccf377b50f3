// SPDX-License-Identifier: GPL-3.0-or-later
// What the window finds when it opens, and keeps for the next one.
#include <utility>

#include "app/app.h"
#include "commands/key_file.h"
#include "document/document.h"
#include "document/settings.h"

namespace argil::viewer {

/// A file that cannot be read is told of, and all is as without it.
void App::read_habits() {
  if (auto keys = read_keys(home_)) {
    ui_.keys = std::move(keys).value();
  } else {
    ui_.notices.push_back({Notice::Kind::warning, keys.error().message});
  }
  kept_keys_ = ui_.keys;
}

void App::keep_settings() {
  keep_keys();
  if (ui_.settings == kept_settings_) return;
  const Settings former = std::exchange(kept_settings_, ui_.settings);
  if (auto kept = write_changes(home_, former, ui_.settings); !kept) {
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
