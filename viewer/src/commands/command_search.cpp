// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/command_search.h"

#include <algorithm>
#include <cassert>
#include <cctype>
#include <utility>

#include "commands/command.h"
#include "commands/favourite_choice.h"

namespace argil::viewer {
namespace {

// What a letter counts for, wherever it stands; and more where it follows the one before, or begins
// a word.
constexpr int kLetterScore = 2;
constexpr int kFollowsScore = 10;
constexpr int kWordScore = 8;
constexpr int kMiss = -1'000'000;

int lower_letter(char c) { return std::tolower(static_cast<unsigned char>(c)); }

bool begins_word(std::string_view text, std::size_t at) {
  return at == 0 || std::isalnum(static_cast<unsigned char>(text[at - 1])) == 0;
}

std::string without_blanks(std::string_view typed) {
  std::string letters;
  for (const char c : typed) {
    if (c != ' ') letters.push_back(c);
  }
  return letters;
}

SearchEntry search_entry(const KeyAim& aim, const KeyMap& keys) {
  const auto* command = std::get_if<Command>(&aim);
  return {aim, title_of(aim), command != nullptr ? info_of(*command).menu : "Tool",
          keys.text_of(aim)};
}

std::vector<SearchEntry> all_search_entries(const KeyMap& keys) {
  std::vector<SearchEntry> all;
  for (const KeyAim& aim : all_key_aims()) {
    if (aim != KeyAim(Command::search)) all.push_back(search_entry(aim, keys));
  }
  return all;
}

/// Its place among those that were done last; behind all of them for any other.
std::size_t search_age(const SearchEntry& entry, const SearchChoice& choice) {
  const auto at = std::find(choice.recent.begin(), choice.recent.end(), entry.aim);
  return static_cast<std::size_t>(at - choice.recent.begin());
}

void move_mark(int by, SearchChoice& choice, const KeyMap& keys) {
  const auto count = static_cast<std::ptrdiff_t>(found_entries(choice, keys).size());
  if (count == 0) return;
  const auto at = std::min(static_cast<std::ptrdiff_t>(choice.at), count - 1);
  choice.at = static_cast<std::size_t>((at + by + count) % count);
}

void type_letter(SearchChoice& choice, unsigned character) {
  constexpr std::size_t kMostLetters = 64;
  if (character < ' ' || character > '~' || choice.text.size() >= kMostLetters) return;
  choice.text.push_back(static_cast<char>(character));
  choice.at = 0;
}

}  // namespace

/// The best of all ways to find the letters, letter by letter: `ends[n]` is that of those so far
/// whose last is text[n].
int match_of(std::string_view typed, std::string_view text) {
  const std::string letters = without_blanks(typed);
  std::vector<int> ends(text.size(), kMiss);
  int best = 0;
  for (std::size_t l = 0; l < letters.size(); ++l) {
    std::vector<int> next(text.size(), kMiss);
    int before = l == 0 ? 0 : kMiss;  // the best that ends earlier than text[n - 1]
    best = kMiss;
    for (std::size_t n = 0; n < text.size(); ++n) {
      const int follows = l > 0 && n > 0 ? ends[n - 1] + kFollowsScore : kMiss;
      if (lower_letter(letters[l]) == lower_letter(text[n])) {
        next[n] =
            std::max(before, follows) + kLetterScore + (begins_word(text, n) ? kWordScore : 0);
        best = std::max(best, next[n]);
      }
      if (l > 0 && n > 0) before = std::max(before, ends[n - 1]);
    }
    ends = std::move(next);
  }
  return std::max(best, -1);
}

std::vector<SearchEntry> found_entries(const SearchChoice& choice, const KeyMap& keys) {
  struct Scored {
    SearchEntry entry;
    int score = 0;
    std::size_t age = 0;
  };
  std::vector<Scored> found;
  for (SearchEntry& entry : all_search_entries(keys)) {
    const int in_title = match_of(choice.text, entry.title);
    const int in_all = std::max(match_of(choice.text, entry.title + " " + entry.place),
                                match_of(choice.text, entry.place + " " + entry.title));
    if (in_title < 0 && in_all < 0) continue;
    const std::size_t age = search_age(entry, choice);
    // Of equal matches the one that was done lately is meant, a title rather than a menu, and a
    // short title.
    int score = 100 * std::max(in_title, in_all);
    if (in_title >= 0) score += 50 - static_cast<int>(entry.title.size());
    if (age < choice.recent.size()) score += 100;
    found.push_back({std::move(entry), score, age});
  }
  const bool is_all = without_blanks(choice.text).empty();
  std::stable_sort(found.begin(), found.end(), [is_all](const Scored& a, const Scored& b) {
    return is_all ? a.age < b.age : a.score > b.score;
  });
  std::vector<SearchEntry> entries;
  entries.reserve(found.size());
  for (Scored& each : found) entries.push_back(std::move(each.entry));
  return entries;
}

bool types_letter(const KeyChord& chord) noexcept {
  return chord.key < kKeyEscape && !chord.modifiers.ctrl && !chord.modifiers.alt;
}

bool is_possible(const SearchEntry& entry, const UiState& ui) {
  const auto* command = std::get_if<Command>(&entry.aim);
  return command == nullptr || is_possible(*command, ui);
}

void do_found(const SearchEntry& entry, UiState& ui, DocumentThread& document) {
  if (!is_possible(entry, ui)) return;
  SearchChoice& choice = ui.search;
  choice.is_open = false;
  std::erase(choice.recent, entry.aim);
  choice.recent.insert(choice.recent.begin(), entry.aim);
  if (choice.recent.size() > SearchChoice::kMostRecent) choice.recent.pop_back();
  do_named(entry.aim, ui, document);
}

bool search_takes(const InputEvent& event, UiState& ui, DocumentThread& document) {
  SearchChoice& choice = ui.search;
  if (!choice.is_open) return false;
  if (event.kind == InputEvent::Kind::text) {
    const double skips_until_s = std::exchange(choice.skips_until_s, -1.0);
    if (event.time_s > skips_until_s) type_letter(choice, event.character);
    return true;
  }
  if (event.kind != InputEvent::Kind::key_down) return false;
  const KeyChord chord{event.key, event.modifiers};
  choice.skips_until_s = -1.0;
  if (!types_letter(chord) && ui.keys.aim_of(chord) == KeyAim(Command::search)) {
    choice.is_open = false;
    return true;
  }
  switch (event.key) {
    case kKeyEscape:
      choice.is_open = false;
      return true;
    case kKeyUp:
      move_mark(-1, choice, ui.keys);
      return true;
    case kKeyDown:
      move_mark(1, choice, ui.keys);
      return true;
    case kKeyBackspace:
      if (event.modifiers.ctrl) choice.text.clear();
      if (!choice.text.empty()) choice.text.pop_back();
      choice.at = 0;
      return true;
    case kKeyEnter:
    case kKeyPadEnter: {
      const std::vector<SearchEntry> found = found_entries(choice, ui.keys);
      if (choice.at >= found.size()) return true;
      const SearchEntry& marked = found[choice.at];
      if (event.modifiers.ctrl) {
        if (!event.is_repeat) toggle_favourite(favourite_of(marked.aim), ui);
      } else {
        do_found(marked, ui, document);
      }
      return true;
    }
    default:
      // A letter is typed, and must not choose a tool; the emergency stop is heard all the same.
      return event.key != kKeySpace || ui.haptics.device == DeviceChoice::mouse;
  }
}

}  // namespace argil::viewer
