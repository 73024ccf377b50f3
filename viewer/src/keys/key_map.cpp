// SPDX-License-Identifier: GPL-3.0-or-later
#include "keys/key_map.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <variant>

#include "document/tool_info.h"
#include "keys/clutch_key.h"
#include "keys/command_info.h"

namespace argil::viewer {
namespace {

/// Of a tool in the sets of other programs: what their brush of that kind has, else Argil's own
/// letter where that does nothing else in the set. In Argil's own set a tool has the letter of its
/// row (argil/engine/action_rows.h).
struct ToolKeys {
  std::string_view name;
  const char* blender = "";
  const char* zbrush = "";
};
constexpr ToolKeys kToolKeys[] = {{"add", "A", "A"},
                                  {"carve", "J", "Shift+A"},
                                  {"smooth", "Shift+S", "Shift+S"},
                                  {"inflate", "X", "D"},
                                  {"flatten", "Shift+T", "L"},
                                  {"scrape", "R", "R"},
                                  {"fill", "B", "Shift+R"},
                                  {"pinch", "P", "Shift+P"},
                                  {"crease", "Shift+C", "E"},
                                  {"grab", "G", "G"},
                                  {"twist", "Shift+R", "T"},
                                  {"mask", "M", "M"},
                                  {"layer", "L", "H"},
                                  {"ridge", "E", "I"},
                                  {"clay", "C", "C"},
                                  {"clay_strips", "U", "Shift+C"},
                                  {"elastic", "", ""},
                                  {"snake_hook", "K", "O"},
                                  {"slide", "", ""},
                                  {"trim", "Y", "Y"},
                                  {"noise", "N", "Shift+N"},
                                  {"emboss", "", ""},
                                  {"stamp", "O", "K"}};

std::size_t slot_of(const KeyAim& aim) {
  const std::vector<KeyAim>& all = all_key_aims();
  const auto at = std::find(all.begin(), all.end(), aim);
  assert(at != all.end());
  return static_cast<std::size_t>(at - all.begin());
}

std::string tool_key_text(KeySet set, const ToolInfo& tool) {
  if (set == KeySet::argil) {
    return tool.key == kNoKey ? std::string() : std::string(1, tool.key);
  }
  const auto* found =
      std::find_if(std::begin(kToolKeys), std::end(kToolKeys),
                   [&](const ToolKeys& keys) { return keys.name == std::string_view(tool.name); });
  assert(found != std::end(kToolKeys));  // KeySets.HaveARowForEveryTool
  return set == KeySet::blender ? found->blender : found->zbrush;
}

}  // namespace

const std::vector<KeyAim>& all_key_aims() {
  static const std::vector<KeyAim> all = [] {
    std::vector<KeyAim> aims;
    aims.reserve(command_infos().size());
    for (const CommandInfo& info : command_infos()) aims.emplace_back(info.command);
    for (const ToolInfo& info : tool_infos()) aims.emplace_back(&info);
    return aims;
  }();
  return all;
}

std::string_view name_of(const KeyAim& aim) {
  const auto* command = std::get_if<Command>(&aim);
  return command != nullptr ? info_of(*command).name : std::get<const ToolInfo*>(aim)->name;
}

const char* title_of(const KeyAim& aim) {
  const auto* command = std::get_if<Command>(&aim);
  return command != nullptr ? info_of(*command).title : std::get<const ToolInfo*>(aim)->title;
}

std::optional<KeyChord> built_in_chord(KeySet set, const KeyAim& aim) {
  const auto* command = std::get_if<Command>(&aim);
  if (command != nullptr) return chord_of(info_of(*command).chords[static_cast<std::size_t>(set)]);
  return chord_of(tool_key_text(set, *std::get<const ToolInfo*>(aim)));
}

bool is_fixed(const KeyAim& aim) noexcept { return aim == KeyAim(Command::emergency_stop); }

const char* why_reserved(const KeyChord& chord) noexcept {
  if (chord.key == kKeySpace) return "Space always stops the force of a device";
  if (chord.key == kKeyEscape) return "Esc always takes back or closes";
  if (chord.key == kClutchKey && chord.modifiers == Modifiers{}) {
    return "V, held, is always the clutch of a device";
  }
  return "";
}

KeyMap::KeyMap(KeySet set) : set_(set), slots_(all_key_aims().size()) { settle(); }

void KeyMap::choose(KeySet set) {
  set_ = set;
  settle();
}

/// What was chosen first; the set's keys where they are left.
void KeyMap::settle() {
  const std::vector<KeyAim>& aims = all_key_aims();
  for (std::size_t n = 0; n < slots_.size(); ++n) {
    Slot& slot = slots_[n];
    slot.chord = slot.is_own ? slot.own : built_in_chord(set_, aims[n]);
    if (slot.is_own || !slot.chord) continue;
    const bool is_taken = std::any_of(slots_.begin(), slots_.end(), [&](const Slot& other) {
      return other.is_own && other.own == slot.chord;
    });
    if (is_taken) slot.chord.reset();
  }
  for (Slot& slot : slots_) slot.text = slot.chord ? viewer::text_of(*slot.chord) : std::string();
}

std::optional<KeyChord> KeyMap::chord_of(const KeyAim& aim) const {
  return slots_[slot_of(aim)].chord;
}

const std::string& KeyMap::text_of(const KeyAim& aim) const { return slots_[slot_of(aim)].text; }

std::optional<KeyAim> KeyMap::aim_of(const KeyChord& chord) const {
  const auto at = std::find_if(slots_.begin(), slots_.end(),
                               [&](const Slot& slot) { return slot.chord == chord; });
  if (at == slots_.end()) return std::nullopt;
  return all_key_aims()[static_cast<std::size_t>(at - slots_.begin())];
}

void KeyMap::give(const KeyAim& aim, std::optional<KeyChord> chord) {
  assert(!chord || *why_reserved(*chord) == '\0');
  if (is_fixed(aim)) return;
  const auto put = [&](std::size_t n, std::optional<KeyChord> own) {
    // What is as the set has it is no choice, and goes on to follow the set.
    const bool is_own = own != built_in_chord(set_, all_key_aims()[n]);
    slots_[n] = {is_own, is_own ? own : std::nullopt, {}, {}};
  };
  for (std::size_t n = 0; n < slots_.size(); ++n) {
    if (chord && slots_[n].is_own && slots_[n].own == chord) put(n, std::nullopt);
  }
  put(slot_of(aim), chord);
  settle();
}

void KeyMap::reset(const KeyAim& aim) {
  slots_[slot_of(aim)] = {};
  settle();
}

void KeyMap::reset() {
  for (Slot& slot : slots_) slot = {};
  settle();
}

bool KeyMap::is_own(const KeyAim& aim) const { return slots_[slot_of(aim)].is_own; }

std::size_t KeyMap::own_count() const noexcept {
  return static_cast<std::size_t>(
      std::count_if(slots_.begin(), slots_.end(), [](const Slot& slot) { return slot.is_own; }));
}

}  // namespace argil::viewer
