// SPDX-License-Identifier: GPL-3.0-or-later
// What asks before it does: a new clay, operations on all of it, export, print, saving.
#include <algorithm>
#include <chrono>
#include <cstdio>

#include <imgui.h>

#include "deed.h"
#include "panels.h"

namespace argil::viewer {
namespace {

/// A window in the middle of the picture; to be ended with ImGui::End().
bool begin_dialog(const char* title, bool* is_open, float width = 380.0F) {
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5F * screen.x, 0.45F * screen.y}, ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowSize({width, 0.0F});
  return ImGui::Begin(title, is_open,
                      ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                          ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize);
}

std::string clock_text(std::chrono::system_clock::time_point when) {
  const std::time_t seconds = std::chrono::system_clock::to_time_t(when);
  std::tm local{};
  localtime_r(&seconds, &local);
  char text[64];
  std::strftime(text, sizeof text, "%d %B %Y, %H:%M", &local);
  return text;
}

void say_wrapped(const std::string& text) {
  ImGui::PushTextWrapPos(0.0F);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
}

void apply(const Operation& operation, Workshop& shop) { shop.send(DoStep{operation}); }

const char* yes_no(bool value) { return value ? "yes" : "NO"; }

}  // namespace

void draw_new_dialog(UiState& ui, Workshop& shop) {
  if (!ui.panels.is_new_open) return;
  begin_dialog("New clay", &ui.panels.is_new_open);
  io::StartShape& shape = ui.waiting_start;
  ImGui::PushItemWidth(180.0F);
  int kind = shape.kind == io::StartShape::Kind::block ? 1 : 0;
  if (pick_one("Form", kind, {"Ball", "Block"})) {
    shape.kind = kind == 1 ? io::StartShape::Kind::block : io::StartShape::Kind::ball;
  }
  if (shape.kind == io::StartShape::Kind::ball) {
    number("Radius, mm", shape.size_mm.x, 0.1, 1000.0, "%.2f");
  } else {
    number("Width, mm", shape.size_mm.x, 0.1, 1000.0, "%.2f");
    number("Depth, mm", shape.size_mm.y, 0.1, 1000.0, "%.2f");
    number("Height, mm", shape.size_mm.z, 0.1, 1000.0, "%.2f");
  }
  number("Finest voxel, mm", shape.options.voxel_mm, 0.001, 100.0, "%.3f");
  ImGui::PopItemWidth();
  if (button("Make it")) {
    ui.panels.is_new_open = false;
    leave_clay(AfterSaving::make_new, ui, shop);
  }
  ImGui::SameLine();
  if (button("Not now")) ui.panels.is_new_open = false;
  ImGui::End();
}

void draw_operations(UiState& ui, Workshop& shop) {
  if (!ui.panels.is_operations_open) return;
  begin_dialog("Whole clay", &ui.panels.is_operations_open, 430.0F);
  OperationChoice& choice = ui.operation;
  ImGui::PushItemWidth(130.0F);
  number("Move surface by, mm", choice.offset_mm, -100.0, 100.0, "%.2f");
  ImGui::SameLine(330.0F);
  if (button("Offset")) apply(Offset{choice.offset_mm}, shop);
  number("Wall, mm", choice.wall_mm, 0.01, 100.0, "%.2f");
  ImGui::SameLine(330.0F);
  if (button("Hollow")) apply(Hollow{choice.wall_mm, {}}, shop);
  const char* const axes[] = {"x", "y", "z"};
  pick_one("Plane across", choice.cut_axis, {axes[0], axes[1], axes[2]});
  number("at, mm", choice.cut_at_mm, -1000.0, 1000.0, "%.2f");
  check("Keep the far side", choice.keeps_front);
  ImGui::SameLine(330.0F);
  if (button("Cut")) {
    Cut cut;
    cut.normal = {};
    cut.normal[static_cast<std::size_t>(choice.cut_axis)] = 1.0;
    cut.point_mm = choice.cut_at_mm * cut.normal;
    cut.keeps_front = choice.keeps_front;
    apply(cut, shop);
  }
  number("Finest voxel, mm", choice.voxel_mm, 0.001, 100.0, "%.3f");
  ImGui::SameLine(330.0F);
  if (button("Resample")) apply(Resample{choice.voxel_mm}, shop);
  ImGui::PopItemWidth();
  ImGui::End();
}

void draw_export(UiState& ui) {
  if (!ui.panels.is_export_open) return;
  begin_dialog("Export for printing", &ui.panels.is_export_open);
  say_wrapped("A mesh in mm, checked after it was read back. 3MF keeps the unit, so prefer it.");
  ImGui::PushItemWidth(150.0F);
  number("Largest error, mm", ui.export_options.max_error_mm, 0.0, 10.0, "%.3f");
  double triangles = static_cast<double>(ui.export_options.triangles);
  if (number("Triangles at most", triangles, 0.0, 1e9, "%.0f")) {
    ui.export_options.triangles = static_cast<std::int64_t>(triangles);
  }
  ImGui::TextDisabled("0: as they are");
  check("A part for each body (3MF)", ui.export_options.parts);
  ImGui::PopItemWidth();
  if (button("Choose a file...")) {
    ui.panels.is_export_open = false;
    ui.file_wish = FileWish::export_mesh;
  }
  ImGui::End();
}

void draw_print(UiState& ui, Workshop& shop) {
  if (!ui.panels.has_print) return;
  ImGui::SetNextWindowPos({kBesideTools, ImGui::GetFrameHeight() + 12.0F}, ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize({400.0F, 0.0F});
  ImGui::Begin("Print", &ui.panels.has_print, ImGuiWindowFlags_NoSavedSettings);
  ImGui::PushItemWidth(140.0F);
  number("Thinnest wall, mm", ui.printer.min_wall_mm, 0.0, 100.0, "%.2f");
  number("Steepest overhang, degrees", ui.printer.max_overhang_deg, 0.0, 89.0, "%.0f");
  check("Cavities need drains", ui.printer.needs_drains);
  ImGui::PopItemWidth();
  ImGui::TextDisabled("0: not asked");
  if (button("Check")) shop.send(CheckPrint{ui.printer});
  if (ui.report) {
    const io::MeshVerdict& verdict = ui.report->verdict;
    ImGui::Separator();
    if (ui.report->changes != ui.clay.changes) {
      ImGui::TextDisabled("as it was before the last change");
    }
    ImGui::Text("Printable: %s", yes_no(verdict.printable));
    ImGui::Text("Closed: %s, manifold: %s, outward: %s", yes_no(verdict.closed),
                yes_no(verdict.manifold), yes_no(verdict.outward));
    ImGui::Text("Volume: %.4g cm3, parts: %d", verdict.volume_mm3 / 1000.0,
                static_cast<int>(verdict.components));
    if (ui.report->exported) {
      ImGui::Text("%s triangles, error at most %.3g mm",
                  grouped(ui.report->exported->triangles).c_str(),
                  ui.report->exported->max_error_mm);
    }
    if (verdict.problems.empty()) ImGui::TextUnformatted("No problems");
    int n = 0;
    for (const io::MeshProblem& problem : verdict.problems) {
      if (n++ == 12) {
        ImGui::TextDisabled("and %d more", static_cast<int>(verdict.problems.size()) - 12);
        break;
      }
      char text[128];
      std::snprintf(text, sizeof text, "%s at %.1f, %.1f, %.1f##%d", problem.kind.c_str(),
                    problem.at_mm.x, problem.at_mm.y, problem.at_mm.z, n);
      // Looks there.
      if (choice(text, false)) ui.camera.set_target(problem.at_mm);
    }
  }
  ImGui::End();
}

void draw_save_question(UiState& ui, Workshop& shop) {
  if (!ui.asks_to_save) return;
  begin_dialog("Save first?", nullptr);
  say_wrapped(ui.clay.is_untitled ? "The clay was never saved."
                                  : "The clay has changes that are not saved.");
  if (button("Save it")) {
    ui.asks_to_save = false;
    if (ui.clay.is_untitled) {
      ui.file_wish = FileWish::save_as;  // and then goes on
    } else {
      go_on_after_saving(true, ui, shop);
    }
  }
  ImGui::SameLine();
  if (button("Do not save")) {
    ui.asks_to_save = false;
    go_on_after_saving(false, ui, shop);
  }
  ImGui::SameLine();
  if (button("Back")) {
    ui.asks_to_save = false;
    ui.after_saving = AfterSaving::nothing;
  }
  ImGui::End();
}

void draw_left_question(UiState& ui, Workshop& shop) {
  if (!ui.clay.left) return;
  const LeftQuestion& left = *ui.clay.left;
  begin_dialog("Recover?", nullptr, 420.0F);
  say_wrapped(left.asked.file.filename().string() +
              " was not closed: " + std::to_string(left.left.steps) +
              (left.left.steps == 1 ? " step was" : " steps were") +
              " not saved, the last one at " + clock_text(left.left.newest) + ".");
  const auto answer = [&](OpenFile::Left word) {
    OpenFile again = left.asked;
    again.left = word;
    shop.send(again);
  };
  if (button("Recover")) answer(OpenFile::Left::repeat);
  ImGui::SameLine();
  if (button("Open as it was saved")) answer(OpenFile::Left::put_aside);
  ImGui::TextDisabled("What is not recovered is kept beside the project.");
  ImGui::End();
}

}  // namespace argil::viewer
