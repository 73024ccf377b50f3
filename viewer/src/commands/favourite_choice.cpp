// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/favourite_choice.h"

#include <algorithm>
#include <cassert>
#include <string>
#include <utility>
#include <variant>

#include "base/text.h"
#include "commands/command.h"
#include "commands/preset_choice.h"

namespace argil::viewer {

std::optional<std::size_t> place_of(const Favourite& favourite, const UiState& ui) {
  const auto at = std::find(ui.favourites.begin(), ui.favourites.end(), favourite);
  if (at == ui.favourites.end()) return std::nullopt;
  return static_cast<std::size_t>(at - ui.favourites.begin());
}

void toggle_favourite(const Favourite& favourite, UiState& ui) {
  const std::string name = in_quotes(favourite_title(favourite));
  const auto say = [&](Notice::Kind kind, const std::string& what) {
    ui.notices.push_back({kind, name + what});
  };
  if (const std::string why = why_no_favourite(favourite); !why.empty()) {
    return say(Notice::Kind::warning, std::string(": ").append(why));
  }
  if (const auto place = place_of(favourite, ui)) {
    ui.favourites[*place].reset();
    return say(Notice::Kind::done, " is no favourite any more");
  }
  const auto free = std::find(ui.favourites.begin(), ui.favourites.end(), std::nullopt);
  if (free == ui.favourites.end()) {
    ui.panels.has_favourites = true;
    return say(Notice::Kind::warning,
               " finds no place: the ring of favourites is full; remove one of them first");
  }
  *free = favourite;
  const auto place = static_cast<std::size_t>(free - ui.favourites.begin());
  say(Notice::Kind::done,
      std::string(" is a favourite now, in the ring: ").append(kFavouriteDirectionTitles[place]));
}

bool can_do(const std::optional<Favourite>& favourite, const UiState& ui) {
  if (!favourite) return false;
  if (const auto* command = std::get_if<Command>(&*favourite)) return is_possible(*command, ui);
  const auto* brush = std::get_if<std::string>(&*favourite);
  return brush == nullptr || preset_named(*brush, ui) != nullptr;
}

void do_favourite(std::size_t place, UiState& ui, DocumentThread& document) {
  assert(place < kFavouritePlaces);
  if (!ui.favourites[place]) return;
  const Favourite favourite = *ui.favourites[place];  // what it does may change the ring
  const auto* brush = std::get_if<std::string>(&favourite);
  if (brush == nullptr) {
    const auto* command = std::get_if<Command>(&favourite);
    const KeyAim aim =
        command != nullptr ? KeyAim(*command) : KeyAim(std::get<const ToolInfo*>(favourite));
    return do_named(aim, ui, document);
  }
  const BrushPreset* preset = preset_named(*brush, ui);
  if (preset != nullptr) return choose_preset(*preset, ui);
  ui.notices.push_back(
      {Notice::Kind::warning,
       "the brush " + in_quotes(*brush) +
           " is gone; save one under that name, or take it out of the favourites"});
}

}  // namespace argil::viewer
