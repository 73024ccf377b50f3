// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "document/tool_info.h"
#include "input/key_name.h"
#include "keys/command_info.h"
#include "keys/key_set.h"

namespace argil::viewer {

/// What a key does, and the search finds: a command, or a tool to be chosen.
using KeyAim = std::variant<Command, const ToolInfo*>;

/// Which key does which command and chooses which tool: those of a set, and before them what the
/// user chose. Each has one key at most, and no key does two things.
class KeyMap {
 public:
  explicit KeyMap(KeySet set = KeySet::argil);

  KeySet set() const noexcept { return set_; }
  /// What was chosen stays; of the new set the keys are left out that were given to something else.
  void choose(KeySet set);

  /// Nothing for what has no key; a text is "Ctrl+Shift+Z", or "".
  std::optional<KeyChord> chord_of(const KeyAim& aim) const;
  const std::string& text_of(const KeyAim& aim) const;
  std::optional<KeyAim> aim_of(const KeyChord& chord) const;

  /// Gives a key, one that may be given (why_reserved), which then does nothing else; or takes the
  /// key away. An aim whose key is fixed keeps it (is_fixed).
  void give(const KeyAim& aim, std::optional<KeyChord> chord);
  /// As the set has it, unless what was chosen for something else has that key; one, and all.
  void reset(const KeyAim& aim);
  void reset();
  /// Whether it was chosen, be it that there is no key.
  bool is_own(const KeyAim& aim) const;
  std::size_t own_count() const noexcept;

  friend bool operator==(const KeyMap&, const KeyMap&) = default;

 private:
  struct Slot {
    bool is_own = false;
    std::optional<KeyChord> own;
    std::optional<KeyChord> chord;  ///< that works
    std::string text;               ///< its name
    friend bool operator==(const Slot&, const Slot&) = default;
  };
  void settle();

  KeySet set_;
  std::vector<Slot> slots_;  ///< of all_key_aims()
};

/// All that can have a key, commands before tools.
const std::vector<KeyAim>& all_key_aims();
/// As files name it, and as panels do.
std::string_view name_of(const KeyAim& aim);
const char* title_of(const KeyAim& aim);

/// The key that a set has for it; nothing for none.
std::optional<KeyChord> built_in_chord(KeySet set, const KeyAim& aim);

/// Whether its key is the same in all sets and cannot be changed: that of the emergency stop.
bool is_fixed(const KeyAim& aim) noexcept;

/// Why a key cannot be given to anything, as a sentence; "" where it can.
const char* why_reserved(const KeyChord& chord) noexcept;

}  // namespace argil::viewer
