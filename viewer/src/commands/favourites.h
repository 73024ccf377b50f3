// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "argil/core/result.h"

#include "keys/key_map.h"

namespace argil::viewer {

/// What a place of the ring does: a command, a tool to be chosen, or a brush by its name.
using Favourite = std::variant<Command, const ToolInfo*, std::string>;

/// Places of the ring, clockwise from the top. A place stays where it is when others change, since
/// it is a direction that a hand remembers.
inline constexpr std::size_t kFavouritePlaces = 8;
inline constexpr std::array<std::string_view, kFavouritePlaces> kFavouriteDirections{
    "up", "up_right", "right", "down_right", "down", "down_left", "left", "up_left"};
inline constexpr std::array<const char*, kFavouritePlaces> kFavouriteDirectionTitles{
    "up", "up right", "right", "down right", "down", "down left", "left", "up left"};
using Favourites = std::array<std::optional<Favourite>, kFavouritePlaces>;

/// Those of who has chosen none.
Favourites usual_favourites();

/// Why it can have no place, as a sentence; "" where it can: the ring would only open again.
const char* why_no_favourite(const Favourite& favourite) noexcept;

/// As panels name it.
std::string favourite_title(const Favourite& favourite);

Favourite favourite_of(const KeyAim& aim);

/// Reads HOME/favourites.json; the usual ones where there is none.
///
///   {
///     "argil_favourites": 1,
///     "up": "tool smooth",             a tool by its name in files of keys, stamp among them
///     "right": "brush Fine line",      a brush by its name; it need not be there now
///     "down": "command mask_clear"     a command by its name of command_rows.h
///   }
///
/// What is not named has nothing.
/// Errors  as io::read_settings_file; bad_input "FILE:LINE: ..." with the remedy for an unknown
///         format, place, kind, tool or command, and for what cannot be one. Nothing of such a file
///         is taken.
Result<Favourites> read_favourites(const std::filesystem::path& home);

/// Writes it. A file there that cannot be read is kept aside (unread_file.h).
/// Errors  as io::replace_file and set_aside().
Result<void> write_favourites(const std::filesystem::path& home, const Favourites& favourites);

}  // namespace argil::viewer
