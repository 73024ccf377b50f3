// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the clay can be printed, and what makes it so.
#include <algorithm>
#include <cassert>
#include <cstdio>

#include <imgui.h>

#include "base/text.h"
#include "gestures/piece_gestures.h"
#include "gui/gui.h"
#include "gui/layout.h"
#include "panels/panels.h"

namespace argil::viewer {
namespace {

const char* yes_no(bool value) { return value ? "yes" : "NO"; }

/// The printer of the list, and its limits, which may be changed for this check alone.
void draw_printer(UiState& ui) {
  std::vector<std::string> names{"any"};
  int at = 0;
  for (const mesh::Printer& printer : ui.printers) {
    if (printer.name == ui.settings.printer) at = static_cast<int>(names.size());
    names.push_back(printer.name);
  }
  if (pick_one("Printer", at, names)) {
    ui.printer = at == 0 ? mesh::Printer() : ui.printers[static_cast<std::size_t>(at) - 1];
    ui.settings.printer = ui.printer.name;
  }
  number("Thinnest wall, mm", ui.printer.min_wall_mm, 0.0, 100.0, "%.2f");
  number("Steepest overhang, degrees", ui.printer.max_overhang_deg, 0.0, 89.0, "%.0f");
  check("Cavities need drains", ui.printer.needs_drains);
  const Vec3& bed = ui.printer.bed_mm;
  if (bed.x > 0.0) ImGui::TextDisabled("Bed %.0f x %.0f x %.0f mm", bed.x, bed.y, bed.z);
  ImGui::TextDisabled("0: not asked");
}

/// A thinner shell with holes through which resin or powder comes out.
void draw_hollow(UiState& ui, DocumentThread& document) {
  OperationChoice& choice = ui.operation;
  number("Wall, mm##hollow", choice.wall_mm, 0.01, 100.0, "%.2f");
  const double least = 4.0 * ui.clay.voxel_mm;  // of what can be seen
  number("Drains across, mm", choice.drain_mm, least, std::max(100.0, least), "%.2f");
  if (button(ui.places_drain ? "Click on the clay" : "Add a drain")) {
    ui.places_drain = !ui.places_drain;
  }
  ImGui::SameLine();
  if (button("No drains")) choice.drains.clear();
  ImGui::SameLine();
  ImGui::TextDisabled("%d", static_cast<int>(choice.drains.size()));
  if (button("Hollow it")) {
    document.send(DoStep{Hollow{choice.wall_mm, choice.drains}, active_key(ui.clay)});
    choice.drains.clear();
  }
}

/// Which of several pieces it was: an export of all shows the verdict on one.
void draw_judged_piece(const UiState& ui) {
  if (!ui.clay.pieces || ui.clay.pieces->pieces.size() < 2) return;
  for (const PieceState& piece : ui.clay.pieces->pieces) {
    if (piece.key == ui.report->piece) ImGui::TextUnformatted(piece.look.name.c_str());
  }
}

/// What the last check or export found.
void draw_verdict(UiState& ui) {
  assert(ui.report != nullptr);
  const mesh::MeshVerdict& verdict = ui.report->verdict;
  ImGui::Separator();
  if (ui.report->changes != ui.clay.changes) {
    ImGui::TextDisabled("as it was before the last change");
  }
  draw_judged_piece(ui);
  ImGui::Text("Printable: %s", yes_no(verdict.printable));
  ImGui::Text("Closed: %s, manifold: %s, outward: %s", yes_no(verdict.closed),
              yes_no(verdict.manifold), yes_no(verdict.outward));
  ImGui::Text("Volume: %.4g cm3, parts: %d", verdict.volume_mm3 / 1000.0,
              static_cast<int>(verdict.components));
  if (ui.report->exported) {
    ImGui::Text("%s triangles, error %.3g mm at samples",
                grouped(ui.report->exported->triangles).c_str(), ui.report->exported->max_error_mm);
  }
  if (verdict.problems.empty()) ImGui::TextUnformatted("No problems");
  int n = 0;
  for (const mesh::MeshProblem& problem : verdict.problems) {
    // A broken mesh has thousands; the pins in the picture show them all.
    if (n++ == 12) {
      ImGui::TextDisabled("and %d more", static_cast<int>(verdict.problems.size()) - 12);
      break;
    }
    char text[128];
    std::snprintf(text, sizeof text, "%s at %.1f, %.1f, %.1f##%d", problem.kind.c_str(),
                  problem.at_mm.x, problem.at_mm.y, problem.at_mm.z, n);
    // Looks there.
    const auto judged = judged_placement(ui);
    if (choice(text, false) && judged) ui.camera.set_target(placed(*judged, problem.at_mm));
  }
}

}  // namespace

void draw_print(UiState& ui, DocumentThread& document) {
  if (!ui.panels.has_print) return;
  put_beside(kPrintPanelLeft, 400.0F);
  ImGui::SetNextWindowSize({400.0F * unit(), 0.0F});
  keep_on_screen(400.0F);
  ImGui::Begin("Print", &ui.panels.has_print, ImGuiWindowFlags_NoSavedSettings);
  ImGui::PushItemWidth(140.0F * unit());
  draw_printer(ui);
  if (button("Check")) document.send(CheckPrint{ui.printer});
  const bool has_hollow = ui.clay.has_clay && ImGui::CollapsingHeader("Hollow with drains");
  note_widget("Hollow with drains");
  if (has_hollow) draw_hollow(ui, document);
  ImGui::PopItemWidth();
  if (ui.report) draw_verdict(ui);
  ImGui::End();
}

}  // namespace argil::viewer
