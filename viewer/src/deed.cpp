// SPDX-License-Identifier: GPL-3.0-or-later
#include "deed.h"

#include <algorithm>
#include <system_error>

#include "file_ending.h"

namespace argil::viewer {
namespace {

constexpr DeedInfo kDeeds[] = {
    {Deed::new_clay, "File", "New...", "Ctrl+N"},
    {Deed::open, "File", "Open...", "Ctrl+O"},
    {Deed::import_mesh, "File", "Import mesh...", "Ctrl+I"},
    {Deed::save, "File", "Save", "Ctrl+S"},
    {Deed::save_as, "File", "Save as...", "Ctrl+Shift+S"},
    {Deed::export_mesh, "File", "Export for printing...", "Ctrl+E"},
    {Deed::screenshot, "File", "Screenshot", "F12"},
    {Deed::turntable, "File", "Turntable", "Shift+F12"},
    {Deed::quit, "File", "Quit", "Ctrl+Q"},
    {Deed::undo, "Edit", "Undo", "Ctrl+Z"},
    {Deed::redo, "Edit", "Redo", "Ctrl+Shift+Z"},
    {Deed::history, "Edit", "History", "Ctrl+H"},
    {Deed::operations, "Edit", "Whole clay...", "Ctrl+W"},
    {Deed::mask_invert, "Mask", "Invert", "Ctrl+Shift+I"},
    {Deed::mask_clear, "Mask", "Clear", "Alt+M"},
    {Deed::mask_blur, "Mask", "Blur", "Alt+B"},
    {Deed::mask_fill, "Mask", "Fill", "Alt+F"},
    {Deed::symmetry_x, "Brush", "Symmetry X", "X"},
    {Deed::symmetry_y, "Brush", "Symmetry Y", "Y"},
    {Deed::symmetry_z, "Brush", "Symmetry Z", "Shift+X"},
    {Deed::brush_size, "Brush", "Size by mouse", "F"},
    {Deed::brush_strength, "Brush", "Strength by mouse", "Shift+F"},
    {Deed::brush_smaller, "Brush", "Smaller", "["},
    {Deed::brush_larger, "Brush", "Larger", "]"},
    {Deed::brush_weaker, "Brush", "Weaker", "Shift+["},
    {Deed::brush_stronger, "Brush", "Stronger", "Shift+]"},
    {Deed::view_front, "View", "Front", "Num1"},
    {Deed::view_back, "View", "Back", "Ctrl+Num1"},
    {Deed::view_right, "View", "Right", "Num3"},
    {Deed::view_left, "View", "Left", "Ctrl+Num3"},
    {Deed::view_top, "View", "Top", "Num7"},
    {Deed::view_bottom, "View", "Bottom", "Ctrl+Num7"},
    {Deed::view_parallel, "View", "Perspective or parallel", "Num5"},
    {Deed::view_frame, "View", "All of it", "Home"},
    {Deed::shading_next, "View", "Next shading", "Z"},
    {Deed::wires, "View", "Wireframe", "W"},
    {Deed::slice, "View", "Slice", "Shift+W"},
    {Deed::stereo, "View", "Stereo", "Shift+Z"},
    {Deed::panels, "View", "Panels", "Tab"},
    {Deed::help, "Help", "Keys", "F1"},
    {Deed::messages, "Help", "Messages", "Ctrl+M"},
    {Deed::red_stop, "Device", "Stop the force", "Space"},
    {Deed::give_force, "Device", "Give the force again", "Ctrl+Shift+G"}};

constexpr double kSizeStep = 1.1;
constexpr double kStrengthStep = 0.05;

void grow(Brush& brush, double factor) {
  brush.radius_mm = std::clamp(brush.radius_mm * factor, kLeastRadiusMm, kMostRadiusMm);
  brush.radius_pixels = std::clamp(brush.radius_pixels * factor, 2.0, 2000.0);
}

void strengthen(Brush& brush, double by) {
  brush.strength = std::clamp(brush.strength + by, kLeastStrength, 1.0);
}

void take_hold(BrushDrag::What what, UiState& ui) {
  ui.brush_drag = BrushDrag{what, ui.brush, ui.pointer.x, ui.pointer};
}

void look(UiState& ui, const Vec3& toward, const Vec3& up = {0.0, 0.0, 1.0}) {
  ui.camera.look_from(toward, up);
}

void edit_mask(MaskEdit edit, Workshop& shop) { shop.send(DoStep{edit}); }

void save(UiState& ui, Workshop& shop) {
  if (ui.clay.is_untitled) {
    ui.file_wish = FileWish::save_as;
  } else {
    shop.send(SaveProject{});
  }
}

/// What only changes how things are shown.
bool perform_on_view(Deed deed, UiState& ui) {
  switch (deed) {
    case Deed::view_front:
      look(ui, {0.0, -1.0, 0.0});
      return true;
    case Deed::view_back:
      look(ui, {0.0, 1.0, 0.0});
      return true;
    case Deed::view_right:
      look(ui, {1.0, 0.0, 0.0});
      return true;
    case Deed::view_left:
      look(ui, {-1.0, 0.0, 0.0});
      return true;
    case Deed::view_top:
      look(ui, {0.0, 0.0, 1.0}, {0.0, 1.0, 0.0});
      return true;
    case Deed::view_bottom:
      look(ui, {0.0, 0.0, -1.0}, {0.0, -1.0, 0.0});
      return true;
    case Deed::view_frame:
      ui.camera.frame(ui.clay.bounds_mm);
      return true;
    case Deed::view_parallel:
      ui.camera.set_parallel(!ui.camera.is_parallel());
      return true;
    case Deed::shading_next:
      ui.show.shading = static_cast<Shading>((static_cast<int>(ui.show.shading) + 1) % 4);
      return true;
    case Deed::wires:
      ui.show.has_wires = !ui.show.has_wires;
      return true;
    case Deed::slice:
      ui.show.has_slice = !ui.show.has_slice;
      return true;
    case Deed::stereo:
      ui.show.is_stereo = !ui.show.is_stereo;
      return true;
    case Deed::panels:
      ui.panels.has_tools = ui.panels.has_brush = ui.panels.has_view = !ui.panels.has_tools;
      return true;
    case Deed::history:
      ui.panels.has_history = !ui.panels.has_history;
      return true;
    case Deed::messages:
      ui.panels.has_messages = !ui.panels.has_messages;
      return true;
    case Deed::help:
      ui.panels.has_help = !ui.panels.has_help;
      return true;
    default:
      return false;
  }
}

/// What only changes the brush.
bool perform_on_brush(Deed deed, UiState& ui) {
  switch (deed) {
    case Deed::symmetry_x:
      ui.brush.mirror.x = !ui.brush.mirror.x;
      return true;
    case Deed::symmetry_y:
      ui.brush.mirror.y = !ui.brush.mirror.y;
      return true;
    case Deed::symmetry_z:
      ui.brush.mirror.z = !ui.brush.mirror.z;
      return true;
    case Deed::brush_smaller:
      grow(ui.brush, 1.0 / kSizeStep);
      return true;
    case Deed::brush_larger:
      grow(ui.brush, kSizeStep);
      return true;
    case Deed::brush_weaker:
      strengthen(ui.brush, -kStrengthStep);
      return true;
    case Deed::brush_stronger:
      strengthen(ui.brush, kStrengthStep);
      return true;
    case Deed::brush_size:
      take_hold(BrushDrag::What::size, ui);
      return true;
    case Deed::brush_strength:
      take_hold(BrushDrag::What::strength, ui);
      return true;
    default:
      return false;
  }
}

}  // namespace

std::span<const DeedInfo> deed_infos() noexcept { return kDeeds; }

const DeedInfo& info_of(Deed deed) noexcept {
  return *std::find_if(std::begin(kDeeds), std::end(kDeeds),
                       [&](const DeedInfo& info) { return info.deed == deed; });
}

std::optional<Deed> deed_of(const KeyChord& chord) noexcept {
  for (const DeedInfo& info : kDeeds) {
    if (chord_of(info.chord) == chord) return info.deed;
  }
  return std::nullopt;
}

const ActionInfo* tool_named_by(const KeyChord& chord) noexcept {
  if (chord.modifiers != Modifiers{} || chord.key == 0) return nullptr;
  for (const ActionInfo& info : action_infos()) {
    if (info.key == chord.key) return &info;
  }
  return nullptr;
}

bool goes_on_while_held(Deed deed) noexcept {
  switch (deed) {
    case Deed::undo:
    case Deed::redo:
    case Deed::brush_smaller:
    case Deed::brush_larger:
    case Deed::brush_weaker:
    case Deed::brush_stronger:
      return true;
    default:
      return false;
  }
}

bool is_possible(Deed deed, const UiState& ui) noexcept {
  switch (deed) {
    case Deed::undo:
      return ui.clay.undo_depth > 0 || ui.clay.is_stroke_open;
    case Deed::redo:
      return ui.clay.steps && ui.clay.steps->done < ui.clay.steps->names.size();
    case Deed::save:  // also of what seems unchanged: a stroke may still be on its way
    case Deed::save_as:
    case Deed::export_mesh:
    case Deed::operations:
    case Deed::mask_fill:
    case Deed::mask_invert:
      return ui.clay.has_clay;
    case Deed::mask_clear:
    case Deed::mask_blur:
      return ui.clay.has_mask;
    case Deed::give_force:
      return ui.is_force_stopped;
    default:
      return true;
  }
}

void perform(Deed deed, UiState& ui, Workshop& shop) {
  // An undo that is still on its way makes a redo possible: the clay's thread knows.
  if (!is_possible(deed, ui) && deed != Deed::redo) return;
  if (perform_on_view(deed, ui) || perform_on_brush(deed, ui)) return;
  switch (deed) {
    case Deed::new_clay:
      ui.panels.is_new_open = true;
      break;
    case Deed::open:
      ui.file_wish = FileWish::open;
      break;
    case Deed::import_mesh:
      ui.file_wish = FileWish::import_mesh;
      break;
    case Deed::save:
      save(ui, shop);
      break;
    case Deed::save_as:
      ui.file_wish = FileWish::save_as;
      break;
    case Deed::export_mesh:
      ui.panels.is_export_open = true;
      break;
    case Deed::quit:
      leave_clay(AfterSaving::quit, ui, shop);
      break;
    case Deed::undo:
      shop.send(DoStep{io::HistoryStep::undo});
      break;
    case Deed::redo:
      shop.send(DoStep{io::HistoryStep::redo});
      break;
    case Deed::operations:
      ui.panels.is_operations_open = true;
      break;
    case Deed::mask_invert:
      edit_mask(MaskEdit::invert, shop);
      break;
    case Deed::mask_clear:
      edit_mask(MaskEdit::clear, shop);
      break;
    case Deed::mask_blur:
      edit_mask(MaskEdit::blur, shop);
      break;
    case Deed::mask_fill:
      edit_mask(MaskEdit::fill, shop);
      break;
    case Deed::screenshot:
      ui.wants_screenshot = true;
      break;
    case Deed::turntable:
      ui.turntable_left = kTurntableFrames;
      break;
    case Deed::red_stop:
      ui.wants_red_stop = true;
      break;
    case Deed::give_force:
      ui.wants_force = true;
      break;
    default:
      break;
  }
}

Dialog open_dialog(const UiState& ui) noexcept {
  if (ui.clay.left) return Dialog::recover;
  if (ui.asks_to_save) return Dialog::save_first;
  if (ui.file_wish != FileWish::none) return Dialog::file;
  if (ui.panels.is_export_open) return Dialog::export_mesh;
  if (ui.panels.is_operations_open) return Dialog::operations;
  return ui.panels.is_new_open ? Dialog::new_clay : Dialog::none;
}

void close_dialogs(UiState& ui) noexcept {
  ui.panels.is_new_open = false;
  ui.panels.is_operations_open = false;
  ui.panels.is_export_open = false;
  ui.panels.has_help = false;
  ui.asks_to_save = false;
  ui.file_wish = FileWish::none;
  ui.after_saving = AfterSaving::nothing;
}

void leave_clay(AfterSaving then, UiState& ui, Workshop& shop) {
  ui.after_saving = then;
  // What is on its way will have changed it.
  const bool changes = ui.clay.is_changed || ui.clay.is_stroke_open || ui.task.is_running;
  if (ui.clay.has_clay && changes) {
    ui.asks_to_save = true;
    return;
  }
  go_on_after_saving(true, ui, shop);
}

void go_on_after_saving(bool saves, UiState& ui, Workshop& shop) {
  ui.asks_to_save = false;
  if (!saves) shop.cancel_task();
  switch (ui.after_saving) {
    case AfterSaving::nothing:
      break;
    case AfterSaving::quit:
      shop.send(EndProject{saves});
      ui.wants_to_quit = true;
      break;
    case AfterSaving::make_new:
      shop.send(NewClay{ui.waiting_start, saves});
      break;
    case AfterSaving::open_file:
      shop.send(OpenFile{ui.waiting_file, saves});
      break;
  }
  ui.after_saving = AfterSaving::nothing;
}

void remember_folder_of(const std::filesystem::path& file, UiState& ui) {
  std::error_code error;
  if (std::filesystem::is_directory(file.parent_path(), error)) ui.folder = file.parent_path();
}

void open_file(const std::filesystem::path& file, UiState& ui, Workshop& shop) {
  if (ending_of(file) == ".csv") {
    ui.haptics.replay_file = file;
    ui.haptics.device = DeviceChoice::replay;
    ui.panels.has_haptics = true;
    return;
  }
  ui.waiting_file = file;
  remember_folder_of(file, ui);
  leave_clay(AfterSaving::open_file, ui, shop);
}

}  // namespace argil::viewer
