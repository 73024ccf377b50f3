// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include <imgui.h>

/// Dear ImGui 1.86 (Debian 12) and 1.90 (Debian 13): what differs between them is here and nowhere
/// else.
namespace argil::viewer {

#if IMGUI_VERSION_NUM >= 18700
inline constexpr auto kImGuiKeypadEnter = ImGuiKey_KeypadEnter;
#else
inline constexpr auto kImGuiKeypadEnter = ImGuiKey_KeyPadEnter;
#endif

/// A texture by its number, as Dear ImGui's back end for OpenGL takes it.
inline ImTextureID texture_id(std::uintptr_t number) {
  return reinterpret_cast<ImTextureID>(number);  // NOLINT(performance-no-int-to-ptr): see above
}

}  // namespace argil::viewer
