// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/favourites.h"

#include <algorithm>
#include <cassert>
#include <system_error>
#include <utility>
#include <vector>

#include "argil/io/safe_file.h"
#include "argil/io/settings_file.h"

#include "document/tool_info.h"
#include "keys/command_info.h"
#include "settings/unread_file.h"

namespace argil::viewer {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFavouriteFile = "favourites.json";
constexpr const char* kFavouriteFormat = "argil_favourites";
// The first word of what a place holds.
constexpr std::string_view kToolWord = "tool";
constexpr std::string_view kCommandWord = "command";
constexpr std::string_view kBrushWord = "brush";

std::string quoted_word(std::string_view text) {
  std::string quoted(1, '"');
  quoted += text;
  return quoted += '"';
}

std::string all_directions() {
  std::string list;
  for (const std::string_view direction : kFavouriteDirections) {
    if (!list.empty()) list += ", ";
    list += quoted_word(direction);
  }
  return list;
}

Favourite tool_favourite(std::string_view name) {
  const auto tools = tool_infos();
  const auto at = std::find_if(tools.begin(), tools.end(),
                               [&](const ToolInfo& info) { return info.name == name; });
  assert(at != tools.end());
  return &*at;
}

/// "tool smooth".
std::string favourite_text(const Favourite& favourite) {
  const auto joined = [](std::string_view kind, std::string_view name) {
    std::string text(kind);
    text += ' ';
    return text += name;
  };
  if (const auto* command = std::get_if<Command>(&favourite)) {
    return joined(kCommandWord, info_of(*command).name);
  }
  if (const auto* tool = std::get_if<const ToolInfo*>(&favourite)) {
    return joined(kToolWord, (*tool)->name);
  }
  return joined(kBrushWord, std::get<std::string>(favourite));
}

/// Reads entry by entry.
class FavouriteReader {
 public:
  explicit FavouriteReader(fs::path file) : file_(std::move(file)) {}

  Result<void> take(const io::SettingsEntry& entry) {
    if (!entry.section.empty()) return fail(entry, "favourites have no sections");
    if (entry.name == kFavouriteFormat) return take_format(entry);
    const auto at = std::find(kFavouriteDirections.begin(), kFavouriteDirections.end(), entry.name);
    if (at == kFavouriteDirections.end()) {
      return fail(entry, quoted_word(entry.name) + " is no place of the ring; these are " +
                             all_directions());
    }
    auto favourite = read_one(entry);
    if (!favourite) return favourite.error();
    favourites_[static_cast<std::size_t>(at - kFavouriteDirections.begin())] =
        std::move(favourite).value();
    return {};
  }

  bool has_format() const noexcept { return has_format_; }
  Favourites take_favourites() { return std::move(favourites_); }

 private:
  Error fail(const io::SettingsEntry& entry, const std::string& what) const {
    return io::settings_error(file_, entry, what);
  }

  Result<void> take_format(const io::SettingsEntry& entry) {
    if (entry.value != decltype(entry.value)(1.0)) {
      return fail(entry, "this program knows \"argil_favourites\": 1; a newer one wrote the file");
    }
    has_format_ = true;
    return {};
  }

  Result<Favourite> read_one(const io::SettingsEntry& entry) const {
    const auto* text = std::get_if<std::string>(&entry.value);
    const std::size_t blank = text == nullptr ? std::string::npos : text->find(' ');
    if (blank == std::string::npos || blank + 1 == text->size()) {
      return fail(entry, quoted_word(entry.name) +
                             " must be a text as \"tool smooth\", \"command undo\" or \"brush "
                             "Fine line\"; leave the line out for nothing there");
    }
    const std::string_view kind = std::string_view(*text).substr(0, blank);
    const std::string_view name = std::string_view(*text).substr(blank + 1);
    if (kind == kBrushWord) return Favourite(std::string(name));
    if (kind != kToolWord && kind != kCommandWord) {
      return fail(entry, quoted_word(kind) +
                             " is nothing that a place can hold; write \"tool\", \"command\" or "
                             "\"brush\" before a name");
    }
    for (const KeyAim& aim : all_key_aims()) {
      const bool is_command = std::holds_alternative<Command>(aim);
      if (is_command != (kind == kCommandWord) || name_of(aim) != name) continue;
      Favourite favourite = favourite_of(aim);
      const std::string why = why_no_favourite(favourite);
      if (!why.empty()) return fail(entry, why + "; leave the line out");
      return favourite;
    }
    return fail(entry, "no " + std::string(kind) + " is called " + quoted_word(name) +
                           "; docs/keys.md lists the names");
  }

  fs::path file_;
  Favourites favourites_;
  bool has_format_ = false;
};

}  // namespace

/// What a sculptor changes between all the time, opposites across from each other; one brush with a
/// name and one command show that there are such.
Favourites usual_favourites() {
  return {tool_favourite("inflate"), tool_favourite("clay_strips"),
          tool_favourite("crease"),  Favourite(std::string("Fine line")),
          tool_favourite("smooth"),  tool_favourite("mask"),
          tool_favourite("grab"),    Favourite(Command::symmetry_x)};
}

const char* why_no_favourite(const Favourite& favourite) noexcept {
  return favourite == Favourite(Command::favourites) ? "the ring cannot open itself" : "";
}

std::string favourite_title(const Favourite& favourite) {
  if (const auto* command = std::get_if<Command>(&favourite)) return info_of(*command).title;
  if (const auto* tool = std::get_if<const ToolInfo*>(&favourite)) return (*tool)->title;
  return std::get<std::string>(favourite);
}

Favourite favourite_of(const KeyAim& aim) {
  const auto* command = std::get_if<Command>(&aim);
  if (command != nullptr) return *command;
  return std::get<const ToolInfo*>(aim);
}

Result<Favourites> read_favourites(const fs::path& home) {
  const fs::path file = home / kFavouriteFile;
  std::error_code error;
  if (!fs::exists(file, error)) return usual_favourites();
  const auto entries = io::read_settings_file(file);
  if (!entries) return entries.error();
  FavouriteReader reader(file);
  for (const io::SettingsEntry& entry : entries.value()) {
    if (auto taken = reader.take(entry); !taken) return taken.error();
  }
  if (!reader.has_format()) {
    return Error{ErrorKind::bad_input,
                 file.string() + ":1: no favourites; the file begins with \"argil_favourites\": 1"};
  }
  return reader.take_favourites();
}

Result<void> write_favourites(const fs::path& home, const Favourites& favourites) {
  std::vector<io::SettingsEntry> entries{{"", kFavouriteFormat, 1.0}};
  for (std::size_t place = 0; place < kFavouritePlaces; ++place) {
    if (!favourites[place]) continue;
    entries.push_back(
        {"", std::string(kFavouriteDirections[place]), favourite_text(*favourites[place])});
  }
  std::error_code error;
  fs::create_directories(home, error);  // what is wrong shows when the file is written
  const fs::path file = home / kFavouriteFile;
  if (fs::exists(file, error) && !read_favourites(home)) {
    if (auto kept = set_aside(file); !kept) return kept;
  }
  return io::replace_text(file, io::settings_text(entries));
}

}  // namespace argil::viewer
