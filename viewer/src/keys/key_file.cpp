// SPDX-License-Identifier: GPL-3.0-or-later
#include "keys/key_file.h"

#include <algorithm>
#include <map>
#include <string>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include "argil/io/safe_file.h"
#include "argil/io/settings_file.h"

#include "keys/command_info.h"
#include "settings/unread_file.h"

namespace argil::viewer {
namespace {

namespace fs = std::filesystem;

constexpr const char* kKeyFile = "keys.json";
constexpr const char* kCommandSection = "commands";
constexpr const char* kToolSection = "tools";

const char* section_of(const KeyAim& aim) {
  return std::holds_alternative<Command>(aim) ? kCommandSection : kToolSection;
}

std::string quoted_json(std::string_view text) { return "\"" + std::string(text) + "\""; }

/// How many letters have to be put in, left out or changed to make one of the other.
std::size_t edits_between(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t n = 0; n <= b.size(); ++n) row[n] = n;
  for (std::size_t m = 1; m <= a.size(); ++m) {
    std::size_t diagonal = std::exchange(row[0], m);
    for (std::size_t n = 1; n <= b.size(); ++n) {
      const std::size_t changed = diagonal + (a[m - 1] == b[n - 1] ? 0 : 1);
      diagonal = std::exchange(row[n], std::min({row[n] + 1, row[n - 1] + 1, changed}));
    }
  }
  return row.back();
}

/// The one of that section whose name is nearest to what was written.
std::string_view nearest_name(const std::string& section, const std::string& written) {
  std::string_view best;
  for (const KeyAim& aim : all_key_aims()) {
    if (section != section_of(aim)) continue;
    const std::string_view name = name_of(aim);
    if (best.empty() || edits_between(written, name) < edits_between(written, best)) best = name;
  }
  return best;
}

/// Reads entry by entry; `fail` makes an error of the entry at hand.
class KeyReader {
 public:
  explicit KeyReader(fs::path file) : file_(std::move(file)) {}

  Result<void> take(const io::SettingsEntry& entry) {
    if (entry.section.empty()) return take_top(entry);
    const bool is_known = entry.section == kCommandSection || entry.section == kToolSection;
    if (!is_known) {
      return fail(entry, quoted_json(entry.section) +
                             " is no section; put keys into \"commands\" or \"tools\"");
    }
    return take_key(entry);
  }

  KeyMap keys() const {
    KeyMap keys(set_);
    for (const auto& [aim, chord] : given_) keys.give(aim, chord);
    return keys;
  }
  bool has_format() const noexcept { return has_format_; }

 private:
  Result<void> fail(const io::SettingsEntry& entry, const std::string& what) const {
    return io::settings_error(file_, entry, what);
  }

  Result<void> take_top(const io::SettingsEntry& entry) {
    if (entry.name == "argil_keys") {
      if (entry.value != decltype(entry.value)(1.0)) {
        return fail(entry, "this program knows \"argil_keys\": 1; a newer one wrote the file");
      }
      has_format_ = true;
      return {};
    }
    if (entry.name != "set") {
      return fail(entry, quoted_json(entry.name) +
                             " is unknown; at the top stand \"argil_keys\", \"set\", \"commands\" "
                             "and \"tools\"");
    }
    const auto* name = std::get_if<std::string>(&entry.value);
    const auto at = name == nullptr ? kKeySetNames.end()
                                    : std::find(kKeySetNames.begin(), kKeySetNames.end(), *name);
    if (at == kKeySetNames.end()) {
      return fail(entry, "there is no such set; write \"argil\", \"blender\" or \"zbrush\"");
    }
    set_ = static_cast<KeySet>(at - kKeySetNames.begin());
    return {};
  }

  Result<void> take_key(const io::SettingsEntry& entry) {
    const std::vector<KeyAim>& all = all_key_aims();
    const auto aim = std::find_if(all.begin(), all.end(), [&](const KeyAim& one) {
      return entry.section == section_of(one) && entry.name == name_of(one);
    });
    if (aim == all.end()) {
      return fail(entry, "no " + entry.section.substr(0, entry.section.size() - 1) + " is called " +
                             quoted_json(entry.name) + "; did you mean " +
                             quoted_json(nearest_name(entry.section, entry.name)) + "?");
    }
    if (is_fixed(*aim)) return fail(entry, "the emergency stop is always Space; leave this out");
    const auto* text = std::get_if<std::string>(&entry.value);
    if (text == nullptr) {
      return fail(entry, "a key is a text in quotes, as \"Ctrl+Shift+F5\"; \"\" for none");
    }
    if (text->empty()) {
      given_.emplace_back(*aim, std::nullopt);
      return {};
    }
    return take_chord(entry, *aim, *text);
  }

  Result<void> take_chord(const io::SettingsEntry& entry, const KeyAim& aim,
                          const std::string& text) {
    const auto chord = chord_of(text);
    if (!chord) {
      return fail(entry, quoted_json(text) +
                             " is no key; write Ctrl+, Shift+ and Alt+ as held, then one key, as "
                             "\"Ctrl+Shift+F5\" or \"Num1\"");
    }
    if (const std::string why = why_reserved(*chord); !why.empty()) {
      return fail(entry, why + "; take another key");
    }
    for (const auto& [other, taken] : given_) {
      if (taken != chord) continue;
      return fail(entry, quoted_json(text) + " is the key of " + quoted_json(name_of(other)) +
                             " already; take another, or \"\" for one of them");
    }
    given_.emplace_back(aim, chord);
    return {};
  }

  fs::path file_;
  KeySet set_ = KeySet::argil;
  bool has_format_ = false;
  std::vector<std::pair<KeyAim, std::optional<KeyChord>>> given_;
};

}  // namespace

Result<KeyMap> read_keys(const fs::path& home) {
  const fs::path file = home / kKeyFile;
  std::error_code error;
  if (!fs::exists(file, error)) return KeyMap();
  const auto entries = io::read_settings_file(file);
  if (!entries) return entries.error();
  KeyReader reader(file);
  for (const io::SettingsEntry& entry : entries.value()) {
    if (auto taken = reader.take(entry); !taken) return taken.error();
  }
  if (!reader.has_format()) {
    return Error{ErrorKind::bad_input,
                 file.string() + ":1: no file of keys; it begins with \"argil_keys\": 1"};
  }
  return reader.keys();
}

Result<void> write_keys(const fs::path& home, const KeyMap& keys) {
  std::vector<io::SettingsEntry> entries{
      {"", "argil_keys", 1.0},
      {"", "set", std::string(kKeySetNames[static_cast<std::size_t>(keys.set())])}};
  for (const KeyAim& aim : all_key_aims()) {
    if (!keys.is_own(aim)) continue;
    entries.push_back({section_of(aim), std::string(name_of(aim)), keys.text_of(aim)});
  }
  std::error_code error;
  fs::create_directories(home, error);  // what is wrong shows when the file is written
  const fs::path file = home / kKeyFile;
  if (fs::exists(file, error) && !read_keys(home)) {
    if (auto kept = set_aside(file); !kept) return kept;
  }
  return io::replace_text(file, io::settings_text(entries));
}

}  // namespace argil::viewer
