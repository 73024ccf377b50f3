// SPDX-License-Identifier: GPL-3.0-or-later
// What asks before it does: a new clay, operations on all of it, export, saving.
#include <algorithm>
#include <cassert>
#include <cstdio>
#include <optional>

#include <imgui.h>

#include "base/text.h"
#include "commands/command.h"
#include "gui/dialog.h"
#include "gui/gui.h"
#include "gui/layout.h"
#include "panels/panels.h"

namespace argil::viewer {
namespace {

void say_wrapped(const std::string& text) {
  ImGui::PushTextWrapPos(0.0F);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
}

}  // namespace

void draw_new_dialog(UiState& ui, DocumentThread& document) {
  const bool is_asked = open_dialog(ui) == Dialog::new_clay;
  if (!begin_dialog("New clay", is_asked, &ui.panels.is_new_open)) return;
  io::StartShape& shape = ui.waiting_start;
  ImGui::PushItemWidth(180.0F * unit());
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
    leave_clay(AfterSaving::make_new, ui, document);
  }
  ImGui::SameLine();
  if (button("Not now")) ui.panels.is_new_open = false;
  end_dialog();
}

namespace {

/// The plane across an axis of the clay.
Cut cut_of(const OperationChoice& choice) {
  Cut cut;
  cut.normal = {};
  cut.normal[static_cast<std::size_t>(choice.cut_axis)] = 1.0;
  cut.point_mm = choice.cut_at_mm * cut.normal;
  cut.keeps_front = choice.keeps_front;
  return cut;
}

/// The operation that was chosen, if one was.
std::optional<Operation> draw_operation_choice(OperationChoice& choice) {
  std::optional<Operation> wanted;
  number("Move surface by, mm", choice.offset_mm, -100.0, 100.0, "%.2f");
  if (button("Offset")) wanted = Offset{choice.offset_mm};
  ImGui::Separator();
  number("Wall, mm", choice.wall_mm, 0.01, 100.0, "%.2f");
  if (button("Hollow")) wanted = Hollow{choice.wall_mm, choice.drains};
  if (!choice.drains.empty()) {
    ImGui::SameLine();
    ImGui::TextDisabled("with %d drains", static_cast<int>(choice.drains.size()));
  }
  ImGui::Separator();
  pick_one("Plane across", choice.cut_axis, {"x", "y", "z"});
  number("at, mm", choice.cut_at_mm, -1000.0, 1000.0, "%.2f");
  check("Keep the far side", choice.keeps_front);
  if (button("Cut")) wanted = cut_of(choice);
  ImGui::Separator();
  number("Finest voxel, mm", choice.voxel_mm, 0.001, 100.0, "%.3f");
  if (button("Resample")) wanted = Resample{choice.voxel_mm};
  return wanted;
}

}  // namespace

void draw_operations(UiState& ui, DocumentThread& document) {
  const bool is_asked = open_dialog(ui) == Dialog::operations;
  const DialogLayout layout{true, 290.0F, 0.0F};  // beside the clay, which shows the plane
  if (!begin_dialog("Whole clay", is_asked, &ui.panels.is_operations_open, layout)) return;
  ImGui::PushItemWidth(90.0F * unit());
  if (const auto wanted = draw_operation_choice(ui.operation)) {
    document.send(DoStep{*wanted, active_key(ui.clay)});
    if (std::holds_alternative<Hollow>(*wanted)) ui.operation.drains.clear();
    ui.panels.is_operations_open = false;
  }
  ImGui::PopItemWidth();
  ImGui::Separator();
  if (button("Close")) ui.panels.is_operations_open = false;
  end_dialog();
}

void draw_export(UiState& ui) {
  const bool is_asked = open_dialog(ui) == Dialog::export_mesh;
  if (!begin_dialog("Export for printing", is_asked, &ui.panels.is_export_open)) return;
  say_wrapped("A mesh in mm, checked after it was read back. 3MF keeps the unit, so prefer it.");
  ImGui::PushItemWidth(150.0F * unit());
  number("Largest error, mm", ui.export_options.max_error_mm, 0.0, 10.0, "%.3f");
  // number() edits doubles, which hold every count of triangles exactly.
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
  ImGui::SameLine();
  if (button("Close")) ui.panels.is_export_open = false;
  end_dialog();
}

void draw_save_question(UiState& ui, DocumentThread& document) {
  if (!begin_dialog("Save first?", open_dialog(ui) == Dialog::save_first, nullptr)) return;
  say_wrapped(ui.clay.is_untitled ? "The clay was never saved."
                                  : "The clay has changes that are not saved.");
  if (button("Save it")) {
    ui.asks_to_save = false;
    if (ui.clay.is_untitled) {
      ui.file_wish = FileWish::save_as;  // and then goes on
    } else {
      go_on_after_saving(true, ui, document);
    }
  }
  ImGui::SameLine();
  if (button("Do not save")) {
    ui.asks_to_save = false;
    go_on_after_saving(false, ui, document);
  }
  ImGui::SameLine();
  if (button("Back")) {
    ui.asks_to_save = false;
    ui.after_saving = AfterSaving::nothing;
  }
  end_dialog();
}

}  // namespace argil::viewer
