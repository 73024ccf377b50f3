// SPDX-License-Identifier: GPL-3.0-or-later
// The device: which, how it feels, and what it does.
#include <algorithm>
#include <cassert>
#include <cstdio>
#include <vector>

#include <imgui.h>

#include "argil/haptics/scene/scene_catalogue.h"
#include "argil/haptics/servo/safety_gate.h"

#include "commands/command.h"
#include "gui/gui.h"
#include "gui/layout.h"
#include "haptics/haptic_control.h"
#include "haptics/haptic_words.h"
#include "panels/panels.h"

namespace argil::viewer {
namespace {

/// A tooltip for the widget just made.
void tell(const char* text) {
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", text);
}

/// Of a button as wide as the panel.
double whole_width() { return 270.0 * static_cast<double>(unit()); }

/// The last seconds of a value, the newest as a number over it.
void draw_plot(const char* label, const std::deque<haptics::RigPoint>& points,
               const char* unit_name, double (*value_of)(const haptics::RigPoint&)) {
  assert(value_of != nullptr);
  std::vector<float> values;
  values.reserve(points.size());
  for (const auto& point : points) values.push_back(static_cast<float>(value_of(point)));
  const float most = values.empty() ? 0.0F : *std::max_element(values.begin(), values.end());
  char text[48];
  std::snprintf(text, sizeof text, "%.4g %s",
                values.empty() ? 0.0 : static_cast<double>(values.back()), unit_name);
  ImGui::PlotLines(label, values.data(), static_cast<int>(values.size()), 0, text, 0.0F,
                   std::max(1.05F * most, 1e-3F), {190.0F * unit(), 44.0F * unit()});
}

/// Who holds the simulated Falcon.
void draw_hand_choice(HapticChoice& choice) {
  int hand = static_cast<int>(choice.hand) - static_cast<int>(haptics::Hand::light);
  if (pick_one("Hand", hand, {"Light", "Arm", "Firm"})) {
    choice.hand = static_cast<haptics::Hand>(hand + static_cast<int>(haptics::Hand::light));
  }
}

/// How far a real one has come, what to do next, and how to leave a fault.
void draw_falcon(haptics::HapticRig& rig) {
  const haptics::FalconStatus* status = rig.falcon();
  if (status == nullptr) return;
  ImGui::PushTextWrapPos(0.0F);
  const bool has_fault = status->state == haptics::FalconState::fault;
  const ThemeColors& colors = shown_colors();
  colored_text(has_fault ? colors.error : colors.told, falcon_words(*status));
  ImGui::PopTextWrapPos();
  if (has_fault && button("Home it again", whole_width())) rig.home_falcon();
}

/// The numbers of a scene of the Falcon report. A slider is felt where it is let go.
void draw_parameters(const haptics::SceneEntry& scene, HapticChoice& choice) {
  for (const haptics::SceneParameter& parameter : scene.parameters) {
    const auto set = choice.scene_settings.find(parameter.name);
    double value = set == choice.scene_settings.end() ? parameter.usual : set->second;
    const double former = value;
    const std::string format =
        std::string(parameter.high >= 1000.0 ? "%.0f " : "%.2f ") + parameter.unit;
    slide(parameter.name, value, parameter.low, parameter.high, format.c_str());
    tell(parameter.about);
    if (value != former) choice.scene_settings[parameter.name] = value;
  }
  if (!choice.scene_settings.empty() && button("Usual scene")) choice.scene_settings.clear();
}

/// Which device, and what it touches.
void draw_device(UiState& ui) {
  HapticChoice& choice = ui.haptics;
  int device = static_cast<int>(choice.device);
  std::vector<std::string> devices{"Mouse alone", "Simulated Falcon", "Falcon"};
  if (!choice.replay_file.empty()) devices.emplace_back("Recording");
  if (pick_one("Device", device, devices)) choice.device = static_cast<DeviceChoice>(device);
  if (choice.device == DeviceChoice::falcon) {
    if (button("Firmware...")) ui.file_wish = FileWish::firmware;
    const std::string file = ui.firmware.string();
    tell(file.empty() ? "sent when the Falcon runs none; else ARGIL_FALCON_FIRMWARE"
                      : file.c_str());
  }
  if (choice.device == DeviceChoice::sim) draw_hand_choice(choice);
  if (choice.device == DeviceChoice::mouse) {
    check("Show the force", ui.show.has_force);
    tell("what the brush would feel under the pointer, pressed as deep as Feel > Press says");
  }
  std::vector<std::string> scenes{"clay"};
  int scene = 0;
  for (const haptics::SceneEntry& entry : haptics::scene_catalogue()) {
    if (choice.scene == entry.name) scene = static_cast<int>(scenes.size());
    scenes.emplace_back(entry.name);
  }
  if (pick_one("Scene", scene, scenes)) {
    choice.scene = scenes[static_cast<std::size_t>(scene)];
    choice.scene_settings.clear();
  }
  if (const haptics::SceneEntry* entry = haptics::find_scene(choice.scene)) {
    draw_parameters(*entry, choice);
  }
}

/// The numbers of the force law, in the ranges that the rig takes.
void draw_material(HapticChoice& choice, const HapticControl& control) {
  haptics::ForceMaterial& material = choice.material;
  slide("Exponent", material.exponent, 1.0, 8.0, "%.1f");
  tell("larger is softer outside and harder inside");
  slide("Skin", material.skin_mm, 0.5, 50.0, "%.1f mm", true);
  slide("Clamp", material.clamp_ratio, 1.01, 20.0, "%.2f times", true);
  tell("the force ends at so many times that on the surface");
  const double most = control.most_surface_force_n();
  slide("Surface force", material.surface_force_n, 0.0, most, "%.2f N");
  if (material.surface_force_n > most) material.surface_force_n = most;
  if (choice.is_direct) tell("no more, or a direct coupling would buzz");
  slide("Viscosity", material.viscosity_force_n, 0.0, 8.0, "%.1f N");
  slide("Viscosity rate", material.viscosity_s_per_mm, 0.0, 1.0, "%.3f s/mm", true);
}

/// Eq. 3 to 5: each weight between those that it must be above and below, so that no choice is one
/// that the rig refuses.
void draw_mix(HapticChoice& choice) {
  using Mix = haptics::ForceMix;
  constexpr double kStep = 0.01;
  Mix& mix = choice.mix;
  // A step beyond the others; half way where there is less room than a step.
  const auto above = [&] {
    const double others = std::max(mix.contact_active, mix.viscosity_passive);
    return others + std::min(kStep, 0.5 * (Mix::kMost - others));
  };
  const auto below = [&](double least) {
    const double others = std::min(mix.contact_passive, mix.viscosity_active);
    return others - std::min(kStep, 0.5 * (others - least));
  };
  slide("Touch: contact", mix.contact_passive, above(), Mix::kMost, "%.2f");
  tell("alpha p of equation 3: how much of the contact is felt while the tool only touches");
  slide("Touch: drag", mix.viscosity_passive, 0.0, below(0.0), "%.2f");
  tell("beta p of equation 3: how much of the drag");
  slide("Work: contact", mix.contact_active, Mix::kLeastContact, below(Mix::kLeastContact), "%.2f");
  tell("alpha a of equation 4: how much of the contact while the tool works; less than touching");
  slide("Work: drag", mix.viscosity_active, above(), Mix::kMost, "%.2f");
  tell("beta a of equation 4: how much of the drag; more than touching");
  slide("Changeover", choice.mix_ramp_s, 0.0, haptics::ModeBlend::kMostRampS, "%.2f s");
  tell("how long p of equation 5 takes from touching to working and back");
  if (button("Usual mix")) {
    choice.mix = {};
    choice.mix_ramp_s = haptics::ModeBlend::kUsualRampS;
  }
}

/// Eq. 6 to 8.
void draw_filter(HapticChoice& choice) {
  using Filter = haptics::PositionFilterOptions;
  check("Filter positions", choice.is_filtered);
  tell("against jitter; it makes contact softer, since its lag is one of the loop's");
  if (!choice.is_filtered) return;
  slide("Tau", choice.filter.gain, 0.01, 1.0, "%.2f");
  tell("of equation 6: what the tool makes up of its way in a millisecond; 1 filters nothing");
  slide("Lambda", choice.filter.lambda_mm, 0.01, Filter::kMostLambdaMm, "%.2f mm", true);
  tell("of equation 7: the tool is never farther from the handle than this");
}

/// How a path on the clay is felt, and which. It is drawn over the clay whatever the device.
void draw_guidance(UiState& ui, HapticControl& control) {
  haptics::GuidanceOptions& guidance = ui.haptics.guidance;
  int kind = static_cast<int>(guidance.kind);
  if (pick_one("Guidance", kind, {"None", "Direct", "Indirect", "Hybrid"})) {
    guidance.kind = static_cast<haptics::GuidanceKind>(kind);
  }
  tell(
      "direct draws the hand to the path, indirect pushes it off to be resisted,\n"
      "hybrid goes between the two by how well the hand follows");
  if (button(ui.draws_path ? "Drag over the clay" : "Draw a path")) ui.draws_path = !ui.draws_path;
  ImGui::SameLine();
  if (button("Path...")) ui.file_wish = FileWish::path;
  if (guidance.path_mm.empty()) return;
  ImGui::SameLine();
  if (button("No path")) guidance.path_mm.clear();
  slide("Guide by", guidance.stiffness_n_per_m, 10.0, 500.0, "%.0f N/m");
  slide("Guide at most", guidance.most_force_n, 0.1, 8.0, "%.1f N");
  if (!control.is_running() || guidance.kind == haptics::GuidanceKind::none) return;
  const haptics::GuidanceState& seen = control.rig().look().guidance;
  ImGui::Text("Off the path %.1f mm, %.0f %% direct", seen.distance_mm, 100.0 * seen.share);
  const bool has_ticked = seen.stiffness_n_per_m > 0.0;
  if (!has_ticked || seen.stiffness_n_per_m >= guidance.stiffness_n_per_m) return;
  ImGui::TextWrapped("By %.0f N/m only: more is unsteady at this rate, delay and filter.",
                     seen.stiffness_n_per_m);
}

void draw_feel(HapticChoice& choice, const HapticControl& control) {
  check("Direct coupling", choice.is_direct);
  slide("Coupling", choice.stiffness_n_per_m, 50.0, 3000.0, "%.0f N/m");
  int damping = static_cast<int>(choice.damping);
  if (pick_one("Damping", damping, {"Fixed", "Adaptive"})) {
    choice.damping = static_cast<haptics::DampingKind>(damping);
  }
  tell(
      "adaptive: more of it while the handle swings in what it touches,\n"
      "of use with a direct coupling at a hard scene");
  check("Texture as vibration", choice.has_vibro);
  tell("what is too fine for the tool's force, at most 0.1 N");
  draw_material(choice, control);
  if (button("Usual material")) choice.material = {};
  draw_filter(choice);
  const bool has_mix = ImGui::TreeNode("Touch and work");
  note_widget("Touch and work");
  if (has_mix) {
    draw_mix(choice);
    ImGui::TreePop();
  }
  slide("Scale", choice.scale, 0.0, 20.0, "%.2f");
  tell("mm of clay for each of the device; 0: fits");
  slide("Press", choice.press_mm, 0.0, 10.0, "%.1f mm");
}

/// Stopping and going on are two buttons, so that a second click on the one is never the other.
void draw_stop(UiState& ui, DocumentThread& document) {
  ImGui::PushStyleColor(ImGuiCol_Text, kOnStopColor);
  ImGui::PushStyleColor(ImGuiCol_Button, kStopColor);
  if (button("STOP the force (Space)", whole_width()))
    perform(Command::emergency_stop, ui, document);
  ImGui::PopStyleColor(2);
  if (!ui.is_force_stopped) return;
  colored_text(shown_colors().error, "The force is stopped.");
  ImGui::PushStyleColor(ImGuiCol_Text, kOnStopColor);
  ImGui::PushStyleColor(ImGuiCol_Button, kGiveColor);
  if (button("Give the force again", whole_width())) perform(Command::give_force, ui, document);
  ImGui::PopStyleColor(2);
}

/// What the running rig does: recording, plots, the governor and the faults of the last tick.
void draw_state(UiState& ui, HapticControl& control) {
  haptics::HapticRig& rig = control.rig();
  const haptics::RigSnapshot& seen = rig.look();
  if (button(rig.is_recording() ? "End the recording" : "Record")) {
    const auto done = control.toggle_recording();
    if (!done) {
      ui.notices.push_back({Notice::Kind::error, done.error().message});
    } else if (!done.value().empty()) {
      ui.notices.push_back({Notice::Kind::done, "recorded in " + done.value().string()});
    }
  }
  draw_plot("Force", rig.points(), "N", [](const auto& p) { return length(p.force_n); });
  draw_plot("Place", rig.points(), "mm", [](const auto& p) { return length(p.position_mm); });
  draw_plot("Rate", rig.points(), "Hz", [](const auto& p) { return p.rate_hz; });
  const haptics::RigOptions& options = rig.options();
  GovernorState governor;
  governor.is_direct = options.coupling == haptics::CouplingKind::direct;
  governor.asked_n_per_m = options.coupling_stiffness_n_per_m;
  governor.allowed_n_per_m = seen.tick.most_stiffness_n_per_m;
  governor.nominal_period_s = options.period_s;
  governor.rate_hz = rig.points().empty() ? 0.0 : rig.points().back().rate_hz;
  if (options.position_filter) {
    governor.filter_lag_s = haptics::filter_lag_s(*options.position_filter, options.period_s);
  }
  ImGui::PushTextWrapPos(0.0F);
  ImGui::TextUnformatted(governor_words(governor).c_str());
  if (options.damping == haptics::DampingKind::adaptive) {
    ImGui::TextUnformatted(damping_words(seen.tick.added_damping_n_s_per_m).c_str());
  }
  ImGui::PopTextWrapPos();
  if (options.position_filter) {
    ImGui::Text("Filtered by %.2f mm, at most %.2f",
                length(seen.tick.position_mm - seen.tick.felt_mm),
                haptics::most_filter_gap_mm(*options.position_filter, options.period_s));
  }
  ImGui::Text("Late %d, left out %d ticks; p99 %.0f us", static_cast<int>(seen.late_ticks),
              static_cast<int>(seen.skipped_ticks), seen.lateness.quantile_us(0.99));
  if (const haptics::Histogram& age = seen.window_age; age.count() > 0) {
    ImGui::Text("Clay felt %.0f ms late, p99 %.0f, most %.0f", 1e-3 * age.quantile_us(0.5),
                1e-3 * age.quantile_us(0.99), 1e-3 * age.max_us());
  }
  if (rig.is_replay_over()) {
    ImGui::TextUnformatted("The recording has ended.");
    return;
  }
  for (unsigned bit = 0; bit < 32; ++bit) {
    const std::uint32_t fault = seen.tick.faults & (1U << bit);
    if (fault == 0) continue;
    ImGui::PushTextWrapPos(0.0F);
    colored_text(shown_colors().warning, haptics::fault_text(fault));
    ImGui::PopTextWrapPos();
  }
}

}  // namespace

void draw_haptics(UiState& ui, HapticControl& control, DocumentThread& document) {
  if (!ui.panels.has_haptics) return;
  put_beside(kDevicePanelLeft, 300.0F);
  ImGui::SetNextWindowSize({300.0F * unit(), 0.0F});
  keep_on_screen(300.0F);
  ImGui::Begin("Device", &ui.panels.has_haptics, ImGuiWindowFlags_NoSavedSettings);
  ImGui::PushItemWidth(150.0F * unit());
  draw_device(ui);
  if (ui.haptics.scene == "clay") {
    const bool has_guidance = ImGui::CollapsingHeader("Guidance along a path");
    note_widget("Guidance along a path");
    if (has_guidance) draw_guidance(ui, control);
  }
  const bool has_feel = ImGui::CollapsingHeader("Feel");
  note_widget("Feel");
  if (has_feel) draw_feel(ui.haptics, control);
  ImGui::PopItemWidth();
  if (control.is_running() || ui.is_force_stopped) draw_stop(ui, document);
  if (control.is_running()) draw_falcon(control.rig());
  if (control.is_running()) draw_state(ui, control);
  ImGui::End();
}

}  // namespace argil::viewer
