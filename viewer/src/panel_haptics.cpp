// SPDX-License-Identifier: GPL-3.0-or-later
// The device: which, how it feels, and what it does.
#include <algorithm>
#include <cstdio>
#include <vector>

#include <imgui.h>

#include "argil/haptics/safety_gate.h"
#include "argil/haptics/scene_catalogue.h"

#include "haptic_desk.h"
#include "panels.h"

namespace argil::viewer {
namespace {

void draw_plot(const char* label, const std::deque<haptics::RigPoint>& points, const char* unit,
               double (*value_of)(const haptics::RigPoint&)) {
  std::vector<float> values;
  values.reserve(points.size());
  for (const auto& point : points) values.push_back(static_cast<float>(value_of(point)));
  const float most = values.empty() ? 0.0F : *std::max_element(values.begin(), values.end());
  char text[48];
  std::snprintf(text, sizeof text, "%.3g %s",
                values.empty() ? 0.0 : static_cast<double>(values.back()), unit);
  ImGui::PlotLines(label, values.data(), static_cast<int>(values.size()), 0, text, 0.0F,
                   std::max(1.05F * most, 1e-3F), {190.0F, 44.0F});
}

void draw_device(UiState& ui) {
  HapticChoice& choice = ui.haptics;
  int device = static_cast<int>(choice.device);
  std::vector<std::string> devices{"Mouse alone", "Simulated Falcon"};
  if (!choice.replay_file.empty()) devices.emplace_back("Recording");
  if (pick_one("Device", device, devices)) choice.device = static_cast<DeviceChoice>(device);
  int hand = static_cast<int>(choice.hand) - static_cast<int>(haptics::Hand::light);
  if (pick_one("Hand", hand, {"Light", "Arm", "Firm"})) {
    choice.hand = static_cast<haptics::Hand>(hand + static_cast<int>(haptics::Hand::light));
  }
  std::vector<std::string> scenes{"clay"};
  int scene = 0;
  for (const haptics::SceneEntry& entry : haptics::scene_catalogue()) {
    if (choice.scene == entry.name) scene = static_cast<int>(scenes.size());
    scenes.emplace_back(entry.name);
  }
  if (pick_one("Scene", scene, scenes)) choice.scene = scenes[static_cast<std::size_t>(scene)];
}

void draw_feel(HapticChoice& choice) {
  check("Direct coupling", choice.is_direct);
  slide("Coupling", choice.stiffness_n_per_m, 50.0, 3000.0, "%.0f N/m");
  slide("Surface force", choice.material.surface_force_n, 0.0, 8.0, "%.1f N");
  slide("Skin", choice.material.skin_mm, 0.5, 50.0, "%.1f mm", true);
  slide("Viscosity", choice.material.viscosity_force_n, 0.0, 8.0, "%.1f N");
  slide("Scale", choice.scale, 0.0, 20.0, "%.2f");
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("mm of clay for each of the device; 0: fits");
  slide("Press", choice.press_mm, 0.0, 10.0, "%.1f mm");
}

void draw_state(UiState& ui, HapticDesk& desk) {
  haptics::HapticRig& rig = desk.rig();
  const haptics::RigSnapshot& seen = rig.look();
  ImGui::PushStyleColor(ImGuiCol_Button, rig.is_halted() ? ImVec4{0.25F, 0.55F, 0.25F, 1.0F}
                                                         : ImVec4{0.75F, 0.10F, 0.08F, 1.0F});
  if (button(rig.is_halted() ? "Give force again (Space)" : "STOP the force (Space)", 250.0)) {
    desk.toggle_halt();
  }
  ImGui::PopStyleColor();
  if (button(rig.is_recording() ? "End the recording" : "Record")) {
    const auto done = desk.toggle_recording();
    if (!done) {
      ui.notices.push_back({Notice::Kind::error, done.error().message});
    } else if (!done.value().empty()) {
      ui.notices.push_back({Notice::Kind::done, "recorded in " + done.value().string()});
    }
  }
  draw_plot("Force", rig.points(), "N", [](const auto& p) { return length(p.force_n); });
  draw_plot("Place", rig.points(), "mm", [](const auto& p) { return length(p.position_mm); });
  draw_plot("Rate", rig.points(), "Hz", [](const auto& p) { return p.rate_hz; });
  ImGui::Text("Governor: at most %.0f N/m", seen.tick.most_stiffness_n_per_m);
  ImGui::Text("Late %d, left out %d ticks; p99 %.0f us", static_cast<int>(seen.late_ticks),
              static_cast<int>(seen.skipped_ticks), seen.lateness.quantile_us(0.99));
  if (rig.is_replay_over()) {
    ImGui::TextUnformatted("The recording has ended.");
    return;
  }
  for (unsigned bit = 0; bit < 32; ++bit) {
    const std::uint32_t fault = seen.tick.faults & (1U << bit);
    if (fault == 0) continue;
    ImGui::PushTextWrapPos(0.0F);
    ImGui::TextColored({1.0F, 0.75F, 0.4F, 1.0F}, "%s", haptics::fault_text(fault));
    ImGui::PopTextWrapPos();
  }
}

}  // namespace

void draw_haptics(UiState& ui, HapticDesk& desk) {
  if (!ui.panels.has_haptics) return;
  ImGui::SetNextWindowPos({kBesideTools, ImGui::GetFrameHeight() + 12.0F}, ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize({300.0F, 0.0F});
  ImGui::Begin("Device", &ui.panels.has_haptics, ImGuiWindowFlags_NoSavedSettings);
  ImGui::PushItemWidth(150.0F);
  draw_device(ui);
  const bool has_feel = ImGui::CollapsingHeader("Feel");
  note_widget("Feel");
  if (has_feel) draw_feel(ui.haptics);
  ImGui::PopItemWidth();
  if (desk.is_running()) draw_state(ui, desk);
  ImGui::End();
}

}  // namespace argil::viewer
