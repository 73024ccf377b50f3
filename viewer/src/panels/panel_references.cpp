// SPDX-License-Identifier: GPL-3.0-or-later
// Reference images: their list, and what an image is for that was dragged into the window.
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <imgui.h>

#include "base/text.h"
#include "commands/command.h"
#include "commands/references.h"
#include "gui/dialog.h"
#include "gui/gui.h"
#include "gui/layout.h"
#include "panels/panels.h"

namespace argil::viewer {
namespace {

constexpr float kReferencesWidth = 270.0F;  // units
constexpr float kReferenceFieldWidth = 90.0F;

std::vector<std::string> view_titles() {
  std::vector<std::string> titles;
  titles.reserve(kStraightViews);
  for (int n = 0; n < kStraightViews; ++n) {
    titles.emplace_back(title_of(static_cast<StraightView>(n)));
  }
  return titles;
}

/// One of the list, its labels told apart by its number; true when it shall go.
bool draw_reference(ReferenceImage& image, const std::string& number_text) {
  constexpr double kMostMm = 1e6;
  const auto label = [&](const char* what) { return what + ("##ref" + number_text); };
  check(label("Show").c_str(), image.is_visible);
  ImGui::SameLine();
  if (button(label("Remove").c_str())) return true;
  ImGui::SameLine();
  const std::string name = image.file.filename().string();
  ImGui::TextUnformatted(name.c_str());
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", image.file.string().c_str());
  if (!image.pixels) {
    ImGui::TextDisabled(image.is_awaited ? "it is being read..."
                                         : "it cannot be read: see the messages");
  }
  ImGui::PushItemWidth(kReferenceFieldWidth * unit());
  int view = static_cast<int>(image.view);
  if (pick_one(label("View").c_str(), view, view_titles())) {
    image.view = static_cast<StraightView>(view);
  }
  number(label("Width, mm").c_str(), image.width_mm, kLeastReferenceWidthMm, kMostMm, "%.2f");
  number(label("To the right, mm").c_str(), image.right_mm, -kMostMm, kMostMm, "%.2f");
  number(label("Up, mm").c_str(), image.up_mm, -kMostMm, kMostMm, "%.2f");
  slide(label("Opacity").c_str(), image.opacity, 0.0, 1.0, "%.2f");
  ImGui::PopItemWidth();
  check(label("Over the clay").c_str(), image.is_over);
  ImGui::Separator();
  return false;
}

/// What is being read; nobody has to wait for it.
void draw_wished(std::vector<ReferenceWish>& wishes) {
  int number = 0;
  for (ReferenceWish& wish : wishes) {
    if (button(("Stop##wish" + std::to_string(++number)).c_str())) wish.is_dropped = true;
    ImGui::SameLine();
    ImGui::TextDisabled("reading %s...", wish.file.filename().string().c_str());
  }
}

}  // namespace

void draw_references(UiState& ui) {
  if (!ui.panels.has_references) return;
  put_beside(kPiecesPanelLeft, kReferencesWidth);
  ImGui::SetNextWindowSize({kReferencesWidth * unit(), 0.0F});
  keep_on_screen(kReferencesWidth);
  ImGui::Begin("Reference images", &ui.panels.has_references, ImGuiWindowFlags_NoSavedSettings);
  if (ui.references.empty() && ui.reference_wishes.empty()) {
    ImGui::PushTextWrapPos(0.0F);
    ImGui::TextDisabled(
        "PNG or JPEG images to sculpt by: each is shown while the window looks straight in its "
        "view");
    ImGui::PopTextWrapPos();
  }
  std::optional<std::size_t> removed;
  for (std::size_t n = 0; n < ui.references.size(); ++n) {
    if (draw_reference(ui.references[n], std::to_string(n + 1))) removed = n;
  }
  if (removed) {
    ui.references.erase(std::next(ui.references.begin(), static_cast<std::ptrdiff_t>(*removed)));
  }
  draw_wished(ui.reference_wishes);
  if (button("Add an image...")) ui.file_wish = FileWish::reference;
  ImGui::End();
}

void draw_dropped_image(UiState& ui) {
  bool is_open = true;
  if (!begin_dialog("What is the image for?", open_dialog(ui) == Dialog::dropped_image, &is_open)) {
    return;
  }
  if (ui.dropped_image) {
    ImGui::TextUnformatted(in_quotes(ui.dropped_image->filename().string()).c_str());
    if (button("Emboss with it")) {
      ui.dropped_alpha = std::exchange(ui.dropped_image, std::nullopt);
    } else if (button("Sculpt by it as a reference")) {
      add_reference(*std::exchange(ui.dropped_image, std::nullopt), ui);
    } else if (button("Neither")) {
      is_open = false;
    }
  }
  if (!is_open) ui.dropped_image.reset();
  end_dialog();
}

}  // namespace argil::viewer
