// SPDX-License-Identifier: GPL-3.0-or-later
#include "gui/input_queue.h"

#include <cassert>
#include <utility>

#include "gui/dear_imgui.h"

namespace argil::viewer {
namespace {

constexpr int kMostKeys = 512;

bool is_key(const InputEvent& event) {
  return event.kind == InputEvent::Kind::key_down || event.kind == InputEvent::Kind::key_up;
}

/// Whether the panels read the key itself: of a letter they read the text that comes with it.
bool is_named(const InputEvent& event) {
  return event.key >= kKeyEscape || event.modifiers.ctrl || event.modifiers.alt;
}

bool has_same_modifiers(const InputEvent& event, const ImGuiIO& io) {
  return event.modifiers == Modifiers{io.KeyShift, io.KeyCtrl, io.KeyAlt};
}

}  // namespace

void name_keys(ImGuiIO& io) {
  for (const auto& [key, number] : {std::pair{ImGuiKey_Tab, kKeyTab},
                                    {ImGuiKey_LeftArrow, kKeyLeft},
                                    {ImGuiKey_RightArrow, kKeyRight},
                                    {ImGuiKey_UpArrow, kKeyUp},
                                    {ImGuiKey_DownArrow, kKeyDown},
                                    {ImGuiKey_Home, kKeyHome},
                                    {ImGuiKey_End, kKeyEnd},
                                    {ImGuiKey_Delete, kKeyDelete},
                                    {ImGuiKey_Backspace, kKeyBackspace},
                                    {ImGuiKey_Enter, kKeyEnter},
                                    {ImGuiKey_Escape, kKeyEscape},
                                    {kImGuiKeypadEnter, kKeyPadEnter}}) {
    io.KeyMap[key] = number;
  }
  for (const auto& [key, letter] : {std::pair<int, int>{ImGuiKey_A, 'A'},
                                    {ImGuiKey_C, 'C'},
                                    {ImGuiKey_V, 'V'},
                                    {ImGuiKey_X, 'X'},
                                    {ImGuiKey_Y, 'Y'},
                                    {ImGuiKey_Z, 'Z'}}) {
    io.KeyMap[key] = letter;
  }
}

bool InputQueue::fits(const InputEvent& event, const ImGuiIO& io, const Taken& taken) {
  const bool has_key = taken.keys.any();
  if (has_key && !has_same_modifiers(event, io)) return false;
  switch (event.kind) {
    case InputEvent::Kind::move:
      return taken.buttons.none() && !taken.has_scrolled && !has_key && !taken.has_text;
    case InputEvent::Kind::press:
    case InputEvent::Kind::release:
      return !taken.buttons.test(static_cast<std::size_t>(event.button)) && !taken.has_scrolled;
    case InputEvent::Kind::scroll:
      return taken.buttons.none() && !taken.has_moved;
    case InputEvent::Kind::key_down:
    case InputEvent::Kind::key_up:
      if (event.key < 0 || event.key >= kMostKeys) return true;  // nothing is told of it
      return taken.buttons.none() && !taken.keys.test(static_cast<std::size_t>(event.key)) &&
             !(is_named(event) && taken.has_text);
    case InputEvent::Kind::text:
      return taken.buttons.none() && !taken.has_moved && !taken.has_scrolled &&
             !taken.has_named_key;
    default:
      return true;
  }
}

void InputQueue::take(const InputEvent& event, ImGuiIO& io, Taken& taken) {
  io.KeyCtrl = event.modifiers.ctrl;
  io.KeyShift = event.modifiers.shift;
  io.KeyAlt = event.modifiers.alt;
  const bool is_press = event.kind == InputEvent::Kind::press;
  if (event.kind == InputEvent::Kind::move || is_press || event.kind == InputEvent::Kind::release) {
    const ImVec2 at{static_cast<float>(event.x), static_cast<float>(event.y)};
    taken.has_moved = taken.has_moved || event.kind == InputEvent::Kind::move;
    io.MousePos = at;
  }
  if (is_press || event.kind == InputEvent::Kind::release) {
    const auto button = static_cast<std::size_t>(event.button);
    assert(button < taken.buttons.size());
    if (io.MouseDown[button] != is_press) taken.buttons.set(button);
    io.MouseDown[button] = is_press;
  } else if (event.kind == InputEvent::Kind::scroll) {
    io.MouseWheel += static_cast<float>(event.steps);
    taken.has_scrolled = true;
  } else if (event.kind == InputEvent::Kind::text) {
    io.AddInputCharacter(event.character);
    taken.has_text = true;
  } else if (is_key(event) && event.key >= 0 && event.key < kMostKeys) {
    const bool is_down = event.kind == InputEvent::Kind::key_down;
    if (io.KeysDown[event.key] != is_down) {
      taken.keys.set(static_cast<std::size_t>(event.key));
      taken.has_named_key = taken.has_named_key || is_named(event);
    }
    io.KeysDown[event.key] = is_down;
  }
}

void InputQueue::apply(ImGuiIO& io) {
  Taken taken;
  while (!waiting_.empty() && fits(waiting_.front(), io, taken)) {
    take(waiting_.front(), io, taken);
    waiting_.pop_front();
  }
}

}  // namespace argil::viewer
