// SPDX-License-Identifier: GPL-3.0-or-later
// What the window has to say: over the picture while it is new, in a panel afterwards.
#include <algorithm>
#include <cstdio>
#include <ctime>

#include <imgui_internal.h>  // the order of windows

#include "gui/gui.h"
#include "gui/layout.h"
#include "panels/panels.h"

namespace argil::viewer {
namespace {

ImVec4 color_of(Notice::Kind kind) {
  switch (kind) {
    case Notice::Kind::error:
      return imgui_color(shown_colors().error);
    case Notice::Kind::warning:
      return imgui_color(shown_colors().warning);
    case Notice::Kind::done:
      break;
  }
  return imgui_color(shown_colors().done);
}

/// One message over the picture, its lower edge at `bottom`; true when it is dismissed.
bool draw_toast(const Message& message, std::size_t index, float& bottom) {
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const bool is_error = message.notice.kind == Notice::Kind::error;
  char name[32];
  std::snprintf(name, sizeof name, "##toast%d", static_cast<int>(index));
  ImGui::SetNextWindowPos({0.5F * screen.x, bottom}, ImGuiCond_Always, {0.5F, 1.0F});
  ImGui::Begin(name, nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize |
                   ImGuiWindowFlags_NoFocusOnAppearing |
                   // Clicks go through a message that cannot be dismissed.
                   (is_error ? 0 : ImGuiWindowFlags_NoInputs));
  // A panel that is worked in is before all that were not; only a dialog is before a message.
  if (ImGui::GetTopMostPopupModal() == nullptr) {
    ImGui::BringWindowToDisplayFront(ImGui::GetCurrentWindow());
  }
  ImGui::PushTextWrapPos(0.55F * screen.x);
  ImGui::PushStyleColor(ImGuiCol_Text, color_of(message.notice.kind));
  ImGui::TextUnformatted(message.notice.text.c_str());
  ImGui::PopStyleColor();
  ImGui::PopTextWrapPos();
  const bool is_dismissed = is_error && button("Dismiss");
  bottom -= ImGui::GetWindowHeight() + 4.0F;
  ImGui::End();
  return is_dismissed;
}

}  // namespace

void draw_toasts(MessageLog& log) {
  // From the bottom up, the oldest lowest, so that none moves when another comes.
  float bottom = ImGui::GetIO().DisplaySize.y - 2.0F * ImGui::GetFrameHeight() - 4.0F;
  for (std::size_t n = 0; n < log.messages().size(); ++n) {
    if (log.messages()[n].is_shown && draw_toast(log.messages()[n], n, bottom)) log.dismiss(n);
  }
}

void draw_messages(UiState& ui, MessageLog& log) {
  if (!ui.panels.has_messages) return;
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({kBesideTools * unit(), 0.55F * screen.y}, ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize({std::min(560.0F * unit(), 0.5F * screen.x), 0.3F * screen.y},
                           ImGuiCond_FirstUseEver);
  ImGui::Begin("Messages", &ui.panels.has_messages, ImGuiWindowFlags_NoSavedSettings);
  if (log.messages().empty()) ImGui::TextDisabled("none yet");
  if (!log.messages().empty() && button("Forget them")) log.clear();
  ImGui::BeginChild("list");
  ImGui::PushTextWrapPos(0.0F);
  // The newest first.
  for (auto message = log.messages().rbegin(); message != log.messages().rend(); ++message) {
    ImGui::TextDisabled("%s", message->clock.c_str());
    ImGui::SameLine();
    ImGui::PushStyleColor(ImGuiCol_Text, color_of(message->notice.kind));
    ImGui::TextUnformatted(message->notice.text.c_str());
    ImGui::PopStyleColor();
  }
  ImGui::PopTextWrapPos();
  ImGui::EndChild();
  ImGui::End();
}

}  // namespace argil::viewer
