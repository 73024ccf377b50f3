// SPDX-License-Identifier: GPL-3.0-or-later
// The still: how large, and how far it is.
#include <algorithm>
#include <cstdio>
#include <utility>

#include <imgui.h>

#include "commands/command.h"
#include "gui/dialog.h"
#include "gui/gui.h"
#include "gui/layout.h"
#include "panels/panels.h"

namespace argil::viewer {
namespace {

void pick_pixels(const char* label, int& pixels) {
  // number() edits doubles, which hold every count of pixels exactly.
  double value = pixels;
  number(label, value, 0.0, StillOptions::kMostPixels, "%.0f");
  pixels = static_cast<int>(value);
}

bool is_sound(const StillOptions& options) {
  const auto fits = [](int pixels) { return pixels >= StillOptions::kLeastPixels; };
  return fits(options.width) && fits(options.height);
}

void draw_still_choice(StillChoice& still) {
  ImGui::TextDisabled("The clay as the window shows it, without");
  ImGui::TextDisabled("marks; each side 16 to 16384 pixels.");
  ImGui::PushItemWidth(110.0F * unit());
  pick_pixels("Width, pixels", still.options.width);
  pick_pixels("Height, pixels", still.options.height);
  slide("Samples across each", still.options.samples, 1, StillOptions::kMostSamples);
  ImGui::PopItemWidth();
  ImGui::BeginDisabled(!is_sound(still.options));
  if (button("Save the still")) still.done = 0.0;
  ImGui::EndDisabled();
  ImGui::SameLine();
  if (button("Close##still")) still.is_open = false;
}

}  // namespace

void draw_still(UiState& ui) {
  StillChoice& still = ui.still;
  const bool is_asked = open_dialog(ui) == Dialog::still;
  bool is_open = true;
  const DialogLayout layout{true, 290.0F, 0.0F};
  if (!begin_dialog("Still picture", is_asked, &is_open, layout)) return;
  if (!still.done) {
    draw_still_choice(still);
  } else {
    char words[32];
    std::snprintf(words, sizeof words, "%.0f %%", 100.0 * *still.done);
    ImGui::ProgressBar(static_cast<float>(*still.done), {-1.0F, 0.0F}, words);
    if (button("Stop")) still.done.reset();
  }
  if (!is_open) {
    still.done.reset();
    still.is_open = false;
  }
  end_dialog();
}

}  // namespace argil::viewer
