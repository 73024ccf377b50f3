// SPDX-License-Identifier: GPL-3.0-or-later
// The files that were open last, each with its picture.
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>

#include <imgui.h>

#include "commands/command.h"
#include "gui/dialog.h"
#include "gui/gui.h"
#include "gui/layout.h"
#include "panels/file_picture.h"
#include "panels/panels.h"

namespace argil::viewer {
namespace {

namespace fs = std::filesystem;

// Units.
constexpr float kRecentWidth = 600.0F;
constexpr float kRecentRow = 84.0F;
constexpr float kRecentPicture = 104.0F;
constexpr float kForgetWidth = 26.0F;
constexpr float kRowsWithoutScrolling = 5.0F;

/// What the third line says of a file.
std::string state_of_recent(const ShownFile* known, bool is_open) {
  if (is_open) return "open in this window";
  if (known == nullptr) return "";
  return known->look.is_there ? words_of_look(known->look) : "is not there any more";
}

/// The colours of the name and of what stands below it.
struct RecentInks {
  ImU32 name = 0;
  ImU32 rest = 0;
};
RecentInks inks_of_recent(bool is_gone, bool is_lit) {
  const ImU32 weak = ImGui::GetColorU32(ImGuiCol_TextDisabled);
  const ImU32 strong = ImGui::GetColorU32(ImGuiCol_Text);
  // Weak letters cannot be read on a row that is lit.
  return {is_gone ? weak : strong, is_lit ? strong : weak};
}

/// Name, folder and state. True where the name or the folder does not fit.
bool write_recent(const fs::path& file, const std::string& state, const RecentInks& inks,
                  float width, const ImVec2& low) {
  const float line = ImGui::GetTextLineHeightWithSpacing();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const std::string name = file.filename().string();
  const std::string folder = file.parent_path().string();
  const std::string shown_name = fitted(name, width);
  const std::string shown_folder = fitted_end(folder, width);
  list.AddText(low, inks.name, shown_name.c_str());
  list.AddText({low.x, low.y + line}, inks.rest, shown_folder.c_str());
  list.AddText({low.x, low.y + 2.0F * line}, inks.rest, fitted(state, width).c_str());
  return shown_name != name || shown_folder != folder;
}

/// What is drawn over the item made last, as large as it.
void draw_recent_row(const fs::path& file, const ShownFile* known, bool is_open, bool is_possible) {
  const float u = unit();
  const float margin = 3.0F * u;
  const ImVec2 low = ImGui::GetItemRectMin();
  const ImVec2 high = ImGui::GetItemRectMax();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const bool is_hovered = ImGui::IsItemHovered();
  if (is_possible && is_hovered) {
    list.AddRectFilled(low, high, ImGui::GetColorU32(ImGuiCol_HeaderHovered), margin);
  }
  const ImVec2 end{low.x + margin + kRecentPicture * u, high.y - margin};
  draw_picture_in(known != nullptr ? known->picture : ShownPicture(), list,
                  {low.x + margin, low.y + margin}, end, known != nullptr ? "no picture" : "");
  const ImVec2 text{end.x + 10.0F * u, low.y + 8.0F * u};
  const RecentInks inks = inks_of_recent(!is_possible && !is_open, is_possible && is_hovered);
  const bool is_cut =
      write_recent(file, state_of_recent(known, is_open), inks, high.x - margin - text.x, text);
  if (is_cut && is_hovered) ImGui::SetTooltip("%s", file.string().c_str());
}

/// True when it is clicked. What is gone, or open in this window already, is not to be opened.
bool choose_recent(const fs::path& file, bool is_open, const UiState& ui) {
  const ShownFile* known = known_file(ui, file);
  const bool is_gone = known != nullptr && !known->look.is_there;
  const bool is_possible = !is_gone && !is_open;
  const float width = ImGui::GetContentRegionAvail().x - kForgetWidth * unit();
  const bool is_clicked = tile(file.string().c_str(), static_cast<double>(width),
                               static_cast<double>(kRecentRow * unit()));
  if (ImGui::IsItemVisible()) draw_recent_row(file, known, is_open, is_possible);
  return is_clicked && is_possible;
}

}  // namespace

void draw_recent(UiState& ui, DocumentThread& document) {
  const bool is_asked = open_dialog(ui) == Dialog::recent;
  const float rows = std::clamp(static_cast<float>(ui.recent.size()), 1.0F, kRowsWithoutScrolling);
  // Within the least room that a window has for panels (scale_of_panels).
  const DialogLayout layout{false, kRecentWidth, 0.0F};
  if (!begin_dialog("Recent files", is_asked, &ui.panels.is_recent_open, layout)) return;
  const float most = std::max(kRecentRow, 0.9F * ImGui::GetIO().DisplaySize.y / unit() - 100.0F);
  const float row = kRecentRow + ImGui::GetStyle().ItemSpacing.y / unit();
  ImGui::BeginChild("##recent", {0.0F, std::min(rows * row, most) * unit()});
  if (ui.recent.empty()) ImGui::TextDisabled("No project was opened or saved yet.");
  std::error_code error;
  const fs::path open =
      ui.clay.has_clay && !ui.clay.is_untitled ? fs::absolute(ui.clay.file, error) : fs::path();
  std::optional<fs::path> chosen;
  for (const fs::path& file : ui.recent) {
    if (choose_recent(file, file == open, ui)) chosen = file;
    ImGui::SameLine(0.0F, 2.0F * unit());
    if (button(("x##forget " + file.string()).c_str())) ui.forgotten_recent = file;
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Off this list; the file stays.");
  }
  ImGui::EndChild();
  if (button("Another...")) {
    ui.panels.is_recent_open = false;
    ui.file_wish = FileWish::open;
  }
  ImGui::SameLine();
  if (button("Close")) ui.panels.is_recent_open = false;
  end_dialog();
  if (!chosen) return;
  ui.panels.is_recent_open = false;
  open_file(*chosen, ui, document);
}

}  // namespace argil::viewer
