// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/command.h"

#include <algorithm>
#include <cassert>
#include <system_error>
#include <utility>
#include <variant>

#include "base/text.h"
#include "commands/measure.h"
#include "commands/piece_edits.h"
#include "picture/stereo.h"

namespace argil::viewer {
namespace {

constexpr double kSizeStep = 1.1;  // of one press; seven about double the size
constexpr double kStrengthStep = 0.05;

void grow(Brush& brush, double factor) {
  brush.radius_mm = std::clamp(brush.radius_mm * factor, kLeastRadiusMm, kMostRadiusMm);
  brush.radius_pixels = std::clamp(brush.radius_pixels * factor, 2.0, 2000.0);
}

void strengthen(Brush& brush, double by) {
  brush.strength = std::clamp(brush.strength + by, kLeastStrength, 1.0);
}

/// From now on moving the mouse changes the brush, until a click.
void take_hold(BrushDrag::What what, UiState& ui) {
  ui.brush_drag = BrushDrag{what, ui.brush, ui.pointer.x, ui.pointer};
}

void look(UiState& ui, const Vec3& toward, const Vec3& up = {0.0, 0.0, 1.0}) {
  ui.camera.look_from(toward, up);
}

void edit_mask(io::ScriptStep edit, const UiState& ui, DocumentThread& document) {
  document.send(DoStep{std::move(edit), active_key(ui.clay)});
}

/// What is done to the mask.
bool perform_on_mask(Command command, const UiState& ui, DocumentThread& document) {
  const MaskChoice numbers = mask_numbers(ui);
  switch (command) {
    case Command::mask_invert:
      edit_mask(MaskEdit::invert, ui, document);
      return true;
    case Command::mask_clear:
      edit_mask(MaskEdit::clear, ui, document);
      return true;
    case Command::mask_blur:
      edit_mask(MaskEdit::blur, ui, document);
      return true;
    case Command::mask_sharpen:
      edit_mask(MaskEdit::sharpen, ui, document);
      return true;
    case Command::mask_fill:
      edit_mask(MaskEdit::fill, ui, document);
      return true;
    case Command::mask_grow:
      edit_mask(MaskFilter(MaskGrow{numbers.by_mm}), ui, document);
      return true;
    case Command::mask_shrink:
      edit_mask(MaskFilter(MaskGrow{-numbers.by_mm}), ui, document);
      return true;
    case Command::mask_cavity:
      edit_mask(MaskFilter(MaskCavity{numbers.cavity_mm, numbers.cavity_factor,
                                      numbers.is_cavity_inverted}),
                ui, document);
      return true;
    default:
      return false;
  }
}

/// A project without a name is asked for one first.
void save(UiState& ui, DocumentThread& document) {
  if (ui.clay.is_untitled) {
    ui.file_wish = FileWish::save_as;
  } else {
    document.send(SaveProject{});
  }
}

/// What only changes how things are shown.
bool perform_on_view(Command command, UiState& ui) {
  switch (command) {
    case Command::view_front:
      look(ui, {0.0, -1.0, 0.0});
      return true;
    case Command::view_back:
      look(ui, {0.0, 1.0, 0.0});
      return true;
    case Command::view_right:
      look(ui, {1.0, 0.0, 0.0});
      return true;
    case Command::view_left:
      look(ui, {-1.0, 0.0, 0.0});
      return true;
    case Command::view_top:
      look(ui, {0.0, 0.0, 1.0}, {0.0, 1.0, 0.0});
      return true;
    case Command::view_bottom:
      look(ui, {0.0, 0.0, -1.0}, {0.0, -1.0, 0.0});
      return true;
    case Command::view_frame:
      frame_in_each(ui.camera, ui.show.is_stereo, ui.clay.all_bounds_mm, ui.panels.room);
      return true;
    case Command::view_parallel:
      ui.camera.set_parallel(!ui.camera.is_parallel());
      return true;
    case Command::shading_next:
      ui.show.shading = static_cast<Shading>((static_cast<int>(ui.show.shading) + 1) % 4);
      return true;
    case Command::wires:
      ui.show.has_wires = !ui.show.has_wires;
      return true;
    case Command::slice:
      ui.show.has_slice = !ui.show.has_slice;
      return true;
    case Command::theme:
      ui.settings.theme = ui.settings.theme == Theme::dark ? Theme::light : Theme::dark;
      return true;
    case Command::stereo:
      ui.show.is_stereo = !ui.show.is_stereo;
      return true;
    default:
      return false;
  }
}

bool perform_on_panels(Command command, UiState& ui) {
  switch (command) {
    case Command::panels:
      ui.panels.has_tools = ui.panels.has_brush = ui.panels.has_view = !ui.panels.has_tools;
      return true;
    case Command::references:
      ui.panels.has_references = !ui.panels.has_references;
      return true;
    case Command::history:
      ui.panels.has_history = !ui.panels.has_history;
      return true;
    case Command::messages:
      ui.panels.has_messages = !ui.panels.has_messages;
      return true;
    case Command::figures:
      ui.panels.has_info = !ui.panels.has_info;
      return true;
    case Command::print:
      ui.panels.has_print = !ui.panels.has_print;
      return true;
    case Command::device:
      ui.panels.has_haptics = !ui.panels.has_haptics;
      return true;
    case Command::search:
      ui.search.is_open = true;
      ui.search.skips_until_s = -1.0;
      ui.search.text.clear();
      ui.search.at = 0;
      return true;
    case Command::help:
      ui.panels.has_help = !ui.panels.has_help;
      return true;
    case Command::presets:
      ui.panels.has_presets = !ui.panels.has_presets;
      ui.preset_choice.waits_for_key = false;
      return true;
    case Command::favourites: {
      // A change of the brush has the pointer until it ends.
      const bool opens = !ui.pie.is_open && !ui.brush_drag;
      ui.pie = {};
      ui.pie.is_open = opens;
      ui.pie.opened_at = ui.pointer;
      return true;
    }
    case Command::favourite_list:
      ui.panels.has_favourites = !ui.panels.has_favourites;
      return true;
    case Command::keys:
      ui.panels.has_keys = !ui.panels.has_keys;
      ui.key_choice = {};
      return true;
    default:
      return false;
  }
}

/// With its list, unless panels are hidden: whoever has hidden them wants to see the clay.
void measure_by(MeasureKind kind, UiState& ui) {
  choose_measure(kind, ui.measures);
  ui.places_drain = ui.draws_path = false;
  if (ui.measures.tool && ui.panels.has_tools) ui.panels.has_measures = true;
}

bool perform_on_measures(Command command, UiState& ui) {
  switch (command) {
    case Command::measure_distance:
      measure_by(MeasureKind::distance, ui);
      return true;
    case Command::measure_angle:
      measure_by(MeasureKind::angle, ui);
      return true;
    case Command::measure_thickness:
      measure_by(MeasureKind::thickness, ui);
      return true;
    case Command::measure_clear:
      clear_measurements(ui.measures);
      return true;
    case Command::measure_list:
      ui.panels.has_measures = !ui.panels.has_measures;
      return true;
    default:
      return false;
  }
}

/// What only changes the brush.
bool perform_on_brush(Command command, UiState& ui) {
  switch (command) {
    case Command::symmetry_x:
      ui.brush.mirror.x = !ui.brush.mirror.x;
      return true;
    case Command::symmetry_y:
      ui.brush.mirror.y = !ui.brush.mirror.y;
      return true;
    case Command::symmetry_z:
      ui.brush.mirror.z = !ui.brush.mirror.z;
      return true;
    case Command::brush_smaller:
      grow(ui.brush, 1.0 / kSizeStep);
      return true;
    case Command::brush_larger:
      grow(ui.brush, kSizeStep);
      return true;
    case Command::brush_weaker:
      strengthen(ui.brush, -kStrengthStep);
      return true;
    case Command::brush_stronger:
      strengthen(ui.brush, kStrengthStep);
      return true;
    case Command::brush_size:
      take_hold(BrushDrag::What::size, ui);
      return true;
    case Command::brush_strength:
      take_hold(BrushDrag::What::strength, ui);
      return true;
    default:
      return false;
  }
}

/// "press Alt+Q, or ", before another way to do it; "" where no key does.
std::string press_words(const KeyMap& keys, Command command) {
  const std::string& key = keys.text_of(command);
  return key.empty() ? std::string() : std::string("press ") + key + ", or ";
}

/// What is done to pieces, or shown of them.
bool perform_on_piece(Command command, UiState& ui, DocumentThread& document) {
  switch (command) {
    case Command::pieces:
      ui.panels.has_pieces = !ui.panels.has_pieces;
      return true;
    case Command::piece_switch:
      if (!ui.is_pointer_over_clay_view) {  // it would be one behind a panel
        ui.notices.push_back({Notice::Kind::warning, "point at a piece in the picture and " +
                                                         press_words(ui.keys, command) +
                                                         "click it twice"});
        return true;
      }
      document.send(
          SelectPieceAt{part_at(ui.camera, ui.show.is_stereo, ui.pointer).ray_at(ui.pointer)});
      return true;
    case Command::piece_gizmo:
      ui.pieces.has_gizmo = !ui.pieces.has_gizmo;
      ui.pieces.handle.reset();
      return true;
    case Command::piece_ball:
      document.send(AddBallPiece{});
      return true;
    case Command::piece_import:
      ui.file_wish = FileWish::import_piece;
      return true;
    case Command::piece_duplicate:
      document.send(DuplicatePiece{});
      // It lies in its original, to be moved out of it.
      ui.pieces.has_gizmo = true;
      return true;
    case Command::piece_remove:
      edit_piece(RemovePiece{ui.clay.pieces->active_piece().look.name}, document);
      return true;
    case Command::piece_split:
      edit_piece(SplitPiece{ui.clay.pieces->active_piece().look.name}, document);
      return true;
    case Command::piece_bed:
      document.send(StandPiece{StandPiece::Where::bed});
      return true;
    case Command::piece_bed_all:
      document.send(StandPiece{StandPiece::Where::all_on_bed});
      return true;
    case Command::piece_flat:
      document.send(StandPiece{StandPiece::Where::flat});
      return true;
    case Command::piece_middle:
      document.send(StandPiece{StandPiece::Where::middle});
      return true;
    case Command::piece_unite:
      merge_pieces(CombineKind::unite, ui, document);
      return true;
    case Command::piece_subtract:
      merge_pieces(CombineKind::subtract, ui, document);
      return true;
    case Command::piece_intersect:
      merge_pieces(CombineKind::intersect, ui, document);
      return true;
    default:
      return false;
  }
}

/// Nothing for a command of another menu.
std::optional<bool> is_piece_possible(Command command, const UiState& ui) noexcept {
  const bool has_pieces = ui.clay.has_clay && ui.clay.pieces;
  switch (command) {
    case Command::pieces:
    case Command::piece_gizmo:
      return true;
    case Command::piece_switch:
    case Command::piece_ball:
    case Command::piece_import:
    case Command::piece_duplicate:
    case Command::piece_split:
    case Command::piece_bed:
    case Command::piece_bed_all:
    case Command::piece_flat:
    case Command::piece_middle:
      return has_pieces;
    case Command::piece_remove:
    case Command::piece_unite:
    case Command::piece_subtract:
    case Command::piece_intersect:
      return has_pieces && ui.clay.pieces->pieces.size() > 1;
    default:
      return std::nullopt;
  }
}

}  // namespace

void choose_tool(const ToolInfo& tool, UiState& ui) {
  leave_measuring(ui.measures);
  choose(ui.brush, tool);
}

void do_named(const KeyAim& aim, UiState& ui, DocumentThread& document) {
  const auto* command = std::get_if<Command>(&aim);
  if (command == nullptr) return choose_tool(*std::get<const ToolInfo*>(aim), ui);
  const bool measures = *command == Command::measure_distance ||
                        *command == Command::measure_angle ||
                        *command == Command::measure_thickness;
  if (measures && is_possible(*command, ui)) ui.measures.tool.reset();
  perform(*command, ui, document);
}

/// What a held key repeats; anything else would open or toggle as often as the keyboard repeats.
bool goes_on_while_held(Command command) noexcept {
  switch (command) {
    case Command::undo:
    case Command::redo:
    case Command::brush_smaller:
    case Command::brush_larger:
    case Command::brush_weaker:
    case Command::brush_stronger:
      return true;
    default:
      return false;
  }
}

bool is_possible(Command command, const UiState& ui) noexcept {
  if (const auto piece = is_piece_possible(command, ui)) return *piece;
  switch (command) {
    case Command::undo:
      return ui.clay.undo_depth > 0 || ui.clay.has_older_steps || ui.clay.is_stroke_open;
    case Command::redo:
      return ui.clay.steps && ui.clay.steps->done < ui.clay.steps->names.size();
    case Command::save:  // also of what seems unchanged: a stroke may be under way
    case Command::save_as:
    case Command::export_mesh:
    case Command::operations:
    case Command::mask_fill:
    case Command::mask_invert:
    case Command::measure_distance:
    case Command::measure_angle:
    case Command::measure_thickness:
    case Command::mask_cavity:
      return ui.clay.has_clay;
    case Command::measure_clear:
      return !ui.measures.list.empty() || !ui.measures.begun.empty();
    case Command::mask_clear:
    case Command::mask_blur:
    case Command::mask_grow:
    case Command::mask_shrink:
    case Command::mask_sharpen:
      return ui.clay.has_mask;
    case Command::give_force:
      return ui.is_force_stopped;
    default:
      return true;
  }
}

/// Nothing is done to the clay here: requests go to the document thread, and the rest is a word in
/// the state that the next frame obeys.
void perform(Command command, UiState& ui, DocumentThread& document) {
  // An undo that is not done yet makes a redo possible: the document thread knows.
  if (!is_possible(command, ui) && command != Command::redo) return;
  if (perform_on_view(command, ui) || perform_on_panels(command, ui)) return;
  if (perform_on_brush(command, ui) || perform_on_measures(command, ui)) return;
  if (perform_on_piece(command, ui, document) || perform_on_mask(command, ui, document)) return;
  switch (command) {
    case Command::new_clay:
      ui.panels.is_new_open = true;
      break;
    case Command::open:
      ui.file_wish = FileWish::open;
      break;
    case Command::recent:
      ui.panels.is_recent_open = true;
      break;
    case Command::import_mesh:
      ui.file_wish = FileWish::import_mesh;
      break;
    case Command::save:
      save(ui, document);
      break;
    case Command::save_as:
      ui.file_wish = FileWish::save_as;
      break;
    case Command::export_mesh:
      ui.panels.is_export_open = true;
      break;
    case Command::quit:
      leave_clay(AfterSaving::quit, ui, document);
      break;
    case Command::undo:
      document.send(DoStep{io::HistoryStep::undo});
      break;
    case Command::redo:
      document.send(DoStep{io::HistoryStep::redo});
      break;
    case Command::operations:
      ui.panels.is_operations_open = true;
      ui.operation.voxel_mm = ui.clay.voxel_mm;  // what it is now, to be made finer or coarser
      break;
    case Command::screenshot:
      ui.wants_screenshot = true;
      break;
    case Command::turntable:
      ui.turntable_left = kTurntableFrames;
      break;
    case Command::still:
      ui.still.is_open = true;
      break;
    case Command::emergency_stop:
      ui.wants_emergency_stop = true;
      break;
    case Command::give_force:
      ui.wants_force = true;
      break;
    default:
      break;
  }
}

Dialog open_dialog(const UiState& ui) noexcept {
  // By urgency: what may lose work first.
  if (ui.clay.left) return Dialog::recover;
  if (ui.asks_to_save) return Dialog::save_first;
  if (ui.file_wish != FileWish::none) return Dialog::file;
  if (ui.panels.is_recent_open) return Dialog::recent;
  if (ui.panels.is_import_open) return Dialog::import_mesh;
  if (ui.panels.is_export_open) return Dialog::export_mesh;
  if (ui.panels.is_operations_open) return Dialog::operations;
  if (ui.dropped_image) return Dialog::dropped_image;
  if (ui.still.is_open) return Dialog::still;
  return ui.panels.is_new_open ? Dialog::new_clay : Dialog::none;
}

/// What was to follow them is forgotten with them.
bool close_dialogs(UiState& ui) noexcept {
  const bool was_open = open_dialog(ui) != Dialog::none || ui.panels.has_help;
  ui.panels.is_new_open = false;
  ui.panels.is_recent_open = false;
  ui.panels.is_operations_open = false;
  ui.panels.is_export_open = false;
  ui.panels.is_import_open = false;
  ui.panels.has_help = false;
  ui.dropped_image.reset();
  ui.still.is_open = false;
  ui.still.done.reset();
  ui.asks_to_save = false;
  ui.file_wish = FileWish::none;
  ui.after_saving = AfterSaving::nothing;
  return was_open;
}

/// Asks first where something would be lost, and else goes on at once.
void leave_clay(AfterSaving then, UiState& ui, DocumentThread& document) {
  ui.after_saving = then;
  // What is under way will have changed it by the time it is left.
  const bool changes = ui.clay.is_changed || ui.clay.is_stroke_open || ui.task.is_running;
  if (ui.clay.has_clay && changes) {
    ui.asks_to_save = true;
    return;
  }
  go_on_after_saving(true, ui, document);
}

void go_on_after_saving(bool saves, UiState& ui, DocumentThread& document) {
  ui.asks_to_save = false;
  // Nobody waits for the end of work on a clay that is thrown away.
  if (!saves) document.cancel_task();
  switch (ui.after_saving) {
    case AfterSaving::nothing:
      break;
    case AfterSaving::quit:
      document.send(EndProject{saves});
      ui.wants_to_quit = true;
      break;
    case AfterSaving::make_new:
      document.send(NewClay{ui.waiting_start, saves});
      break;
    case AfterSaving::import_mesh:
      ui.waiting_import.saves_former = saves;
      document.send(ui.waiting_import);
      break;
    case AfterSaving::open_file:
      document.send(OpenFile{ui.waiting_file, saves});
      break;
  }
  ui.after_saving = AfterSaving::nothing;
}

void remember_folder_of(const std::filesystem::path& file, UiState& ui) {
  std::error_code error;
  if (std::filesystem::is_directory(file.parent_path(), error)) ui.folder = file.parent_path();
}

/// Opens the dialog, which has something to ask once the mesh was looked at.
void ask_about_mesh(const std::filesystem::path& file, UiState& ui, DocumentThread& document) {
  const std::int64_t number = ui.import.number + 1;
  ui.import = {};
  ui.import.file = file;
  ui.import.number = number;
  ui.panels.is_import_open = true;
  document.send(LookAtMesh{file, number});
}

void import_as_chosen(UiState& ui, DocumentThread& document) {
  assert(ui.import.is_filled && ui.clay.offer);
  ui.panels.is_import_open = false;
  ui.waiting_import = request_of(ui.import, *ui.clay.offer);
  leave_clay(AfterSaving::import_mesh, ui, document);
}

void open_file(const std::filesystem::path& file, UiState& ui, DocumentThread& document) {
  if (extension_of(file) == ".csv") {
    ui.haptics.replay_file = file;
    ui.haptics.device = DeviceChoice::replay;
    ui.panels.has_haptics = true;
    return;
  }
  remember_folder_of(file, ui);
  if (extension_of(file) != ".vdb") {
    ask_about_mesh(file, ui, document);
    return;
  }
  ui.waiting_file = file;
  leave_clay(AfterSaving::open_file, ui, document);
}

}  // namespace argil::viewer
