// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/preset_choice.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "commands/command.h"

namespace argil::viewer {
namespace {

BrushPreset* find_preset(const std::string& name, std::vector<BrushPreset>& presets) {
  const auto at = std::find_if(presets.begin(), presets.end(),
                               [&](const BrushPreset& one) { return one.name == name; });
  return at == presets.end() ? nullptr : &*at;
}

/// From now on it has a file, also where it was built in.
void keep_preset(BrushPreset& preset, UiState& ui) {
  preset.is_built_in = false;
  ui.preset_choice.to_write.push_back(preset.name);
}

/// No other preset has it any more.
void give_preset_key(const std::string& name, std::optional<KeyChord> chord, UiState& ui) {
  for (BrushPreset& other : ui.presets) {
    if (!chord || other.key != chord || other.name == name) continue;
    other.key.reset();
    keep_preset(other, ui);
  }
  BrushPreset* preset = find_preset(name, ui.presets);
  if (preset == nullptr) return;
  preset->key = chord;
  keep_preset(*preset, ui);
}

bool is_only_modifier(int key) { return key >= 340 && key <= 347; }  // GLFW's Shift to Super

}  // namespace

const BrushPreset* preset_named(const std::string& name, const UiState& ui) {
  const auto at = std::find_if(ui.presets.begin(), ui.presets.end(),
                               [&](const BrushPreset& one) { return one.name == name; });
  return at == ui.presets.end() ? nullptr : &*at;
}

void choose_preset(const BrushPreset& preset, UiState& ui) {
  leave_measuring(ui.measures);
  apply(preset, ui.brush);
  ui.preset_choice.chosen = preset.name;
  ui.preset_choice.name = preset.name;
  ui.preset_choice.waits_for_key = false;
  ui.preset_choice.refused.clear();
}

const BrushPreset* preset_of(const KeyChord& chord, const UiState& ui) {
  if (ui.keys.aim_of(chord) || *why_reserved(chord) != '\0') return nullptr;
  const auto at = std::find_if(ui.presets.begin(), ui.presets.end(),
                               [&](const BrushPreset& one) { return one.key == chord; });
  return at == ui.presets.end() ? nullptr : &*at;
}

std::string preset_key_text(const BrushPreset& preset, const UiState& ui) {
  if (!preset.key) return {};
  const BrushPreset* owner = preset_of(*preset.key, ui);
  return owner != nullptr && owner->name == preset.name ? text_of(*preset.key) : std::string();
}

void save_preset(UiState& ui) {
  PresetChoice& choice = ui.preset_choice;
  choice.refused = why_no_preset_name(choice.name);
  if (!choice.refused.empty()) return;
  BrushPreset preset;
  preset.name = choice.name;
  preset.brush = ui.brush;
  // What is of a file elsewhere is not kept.
  preset.brush.mesh.reset();
  preset.brush.alpha.reset();
  if (preset.brush.shape == Shape::mesh) preset.brush.shape = Shape::ball;
  if (BrushPreset* former = find_preset(choice.name, ui.presets)) {
    preset.key = former->key;
    *former = std::move(preset);
  } else {
    const auto before =
        std::find_if(ui.presets.begin(), ui.presets.end(),
                     [&](const BrushPreset& one) { return one.name > choice.name; });
    ui.presets.insert(before, std::move(preset));
  }
  choice.chosen = choice.name;
  keep_preset(*find_preset(choice.name, ui.presets), ui);
}

void remove_preset(const std::string& name, UiState& ui) {
  const BrushPreset* preset = preset_named(name, ui);
  if (preset == nullptr || preset->is_built_in) return;
  const std::string gone = name;  // it may be that of the preset itself
  std::vector<BrushPreset> built_in = built_in_presets();
  if (const BrushPreset* original = find_preset(gone, built_in)) {
    *find_preset(gone, ui.presets) = *original;
  } else {
    std::erase_if(ui.presets, [&](const BrushPreset& one) { return one.name == gone; });
    ui.preset_choice.chosen.clear();
  }
  std::erase(ui.preset_choice.to_write, gone);
  ui.preset_choice.to_remove.push_back(gone);
}

bool preset_key_takes(const InputEvent& event, UiState& ui) {
  assert(event.kind == InputEvent::Kind::key_down);
  PresetChoice& choice = ui.preset_choice;
  if (!ui.panels.has_presets || !choice.waits_for_key) return false;
  if (event.is_repeat || is_only_modifier(event.key)) return true;
  choice.refused.clear();
  const KeyChord chord{event.key, event.modifiers};
  if (event.key == kKeyEscape) {
    choice.waits_for_key = false;
    return true;
  }
  if (event.key == kKeyBackspace && event.modifiers == Modifiers{}) {
    give_preset_key(choice.chosen, std::nullopt, ui);
    choice.waits_for_key = false;
    return true;
  }
  if (const std::string why = why_reserved(chord); !why.empty()) {
    choice.refused = why;
    return event.key != kKeySpace;
  }
  if (const auto owner = ui.keys.aim_of(chord)) {
    choice.refused = text_of(chord) + " is the key of \"" + title_of(*owner) +
                     "\"; press another, or change that one first (Help > Change keys)";
    return true;
  }
  if (text_of(chord).empty()) {
    choice.refused = "this key has no name to be kept by; press another";
    return true;
  }
  give_preset_key(choice.chosen, chord, ui);
  choice.waits_for_key = false;
  return true;
}

}  // namespace argil::viewer
