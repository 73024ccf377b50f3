// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "argil/haptics/force/force_mix.h"
#include "argil/haptics/force/tool_force.h"
#include "argil/haptics/servo/adaptive_damping.h"
#include "argil/haptics/servo/guidance.h"
#include "argil/haptics/servo/position_filter.h"
#include "argil/haptics/simulation/hand_model.h"

#include "commands/brush.h"
#include "commands/brush_preset.h"
#include "commands/favourites.h"
#include "commands/import_choice.h"
#include "commands/measure.h"
#include "commands/outline.h"
#include "commands/pie_menu.h"
#include "commands/search_choice.h"
#include "document/document_thread.h"
#include "keys/key_map.h"
#include "picture/camera.h"
#include "picture/gizmo.h"
#include "picture/reference_image.h"
#include "picture/renderer.h"
#include "picture/slice_chord.h"
#include "picture/stereo.h"
#include "picture/still.h"
#include "settings/alpha_list.h"
#include "settings/settings.h"
#include "settings/thumbnail.h"

namespace argil::viewer {

/// How things are shown.
struct ShowState {
  Shading shading = Shading::matcap;
  bool has_wires = false;
  bool has_occlusion = true;
  bool is_stereo = false;
  bool has_planes = true;  ///< of symmetry
  bool has_pins = true;    ///< of the print report
  bool has_force = false;  ///< of the mouse alone: what the brush would feel
  bool has_slice = false;
  int slice_axis = 0;           ///< x, y, z
  double slice_position = 0.0;  ///< along it, as a fraction of the clay's half size, -1 to 1
};

/// Which panels are open, and what dialogs wait for.
struct PanelState {
  bool has_tools = true;
  bool has_brush = true;
  bool has_view = true;
  float view_top = 1e4F;         ///< pixels: where the view's panel began in the last frame
  float tools_right = 0.0F;      ///< likewise, where the tools' ended
  std::optional<FreeRoom> room;  ///< that menu, status line, tools, brush and view left then
  bool has_haptics = false;
  bool has_print = false;
  bool has_pieces = false;
  bool has_references = false;
  bool has_measures = false;
  bool has_info = false;
  bool has_history = false;
  bool has_messages = false;
  bool has_help = false;
  bool has_keys = false;
  bool has_presets = false;
  bool has_favourites = false;
  bool is_new_open = false;
  bool is_recent_open = false;
  bool is_operations_open = false;
  bool is_export_open = false;
  bool is_import_open = false;
};

/// Dialogs, which must be answered before anything else goes on.
enum class Dialog {
  none,
  recover,
  save_first,
  file,
  recent,
  import_mesh,
  export_mesh,
  operations,
  new_clay,
  dropped_image,
  still
};

/// What a file is asked for.
enum class FileWish {
  none,
  open,
  save_as,
  export_mesh,
  import_mesh,
  import_piece,
  stamp,
  alpha,
  reference,
  firmware,
  path
};

/// What the window does once the question "Save first?" is answered.
enum class AfterSaving { nothing, quit, make_new, open_file, import_mesh };

enum class DeviceChoice { mouse, sim, falcon, replay };

/// What is felt, and with what.
struct HapticChoice {
  DeviceChoice device = DeviceChoice::mouse;
  std::filesystem::path replay_file;
  haptics::Hand hand = haptics::Hand::arm;
  bool is_direct = false;
  haptics::DampingKind damping = haptics::DampingKind::fixed;
  bool has_vibro = false;  ///< RigOptions::has_vibro
  double stiffness_n_per_m = 1500.0;
  haptics::ForceMaterial material;
  haptics::ForceMix mix;
  double mix_ramp_s = haptics::ModeBlend::kUsualRampS;
  bool is_filtered = false;
  haptics::PositionFilterOptions filter;  ///< where it is
  std::string scene = "clay";
  std::map<std::string, double> scene_settings;  ///< that are not usual (SceneParameter)
  double scale = 0.0;     ///< mm of clay for each of the device; 0: the clay fills its reach
  double press_mm = 2.0;  ///< how deep the simulated hand aims under the pointer
  haptics::GuidanceOptions
      guidance;  ///< its path on the clay, in the piece's frame; its scale is the placement's
  friend bool operator==(const HapticChoice& a, const HapticChoice& b) {
    const auto numbers = [](const HapticChoice& c) {
      return std::pair{std::array{c.stiffness_n_per_m, c.scale, c.press_mm, c.mix_ramp_s},
                       numbers_of(c.material)};
    };
    return a.device == b.device && a.replay_file == b.replay_file && a.hand == b.hand &&
           a.is_direct == b.is_direct && a.damping == b.damping && a.has_vibro == b.has_vibro &&
           a.scene == b.scene && a.mix == b.mix && a.is_filtered == b.is_filtered &&
           a.filter == b.filter && a.scene_settings == b.scene_settings &&
           a.guidance == b.guidance && numbers(a) == numbers(b);
  }
};

/// Numbers of the dialog for operations.
struct OperationChoice {
  double offset_mm = 0.5;
  double wall_mm = 2.0;
  double drain_mm = 4.0;      ///< across
  std::vector<Drain> drains;  ///< of the next hollow, in the active piece's frame
  int cut_axis = 2;
  double cut_at_mm = 0.0;
  bool keeps_front = true;
  double voxel_mm = 0.25;  ///< of resampling: the clay's when the dialog opens
};

/// Numbers of the mask's edits. A length of 0 follows the clay's voxel (mask_numbers).
struct MaskChoice {
  double by_mm = 0.0;      ///< how far it grows or shrinks
  double cavity_mm = 0.0;  ///< the size of cavities
  double cavity_factor = 1.0;
  bool is_cavity_inverted = false;
};

/// A change of the brush by moving the mouse, until a click (F, Shift+F).
struct BrushDrag {
  enum class What { size, strength } what = What::size;
  Brush before;
  double start_x = 0.0;
  Camera::Pixel at;  ///< where the ring stays
};

/// The active piece while it is dragged, shown so until the document has it there.
struct PieceDrag {
  PieceKey piece = 0;
  Placement placement = {};
  bool is_sent = false;      ///< to the document; while it is held it is not
  double factor = 1.0;       ///< how many times as large it is shown
  std::int64_t changes = 0;  ///< ClayState::changes when it was sent
};

/// What the window remembers of pieces.
struct PieceChoice {
  bool has_gizmo = false;
  std::optional<GizmoPart> handle;  ///< under the pointer, or held
  std::optional<PieceDrag> drag;
  std::optional<PieceKey> other;  ///< to merge with, as chosen
  bool keeps_other = false;
  std::optional<PieceKey> listed;   ///< the active one, to which the list was scrolled
  std::optional<PieceKey> renamed;  ///< whose name is being typed
  std::string new_name;
  std::string typed_color;
  // Of the active piece as they are being typed.
  Vec3 position_mm;
  Vec3 turns_deg;
  Quat turned;  ///< what those turns are
  Vec3 size_mm;
  double percent = 100.0;
  bool is_typing_size = false;
  bool is_typing = false;
  /// Where a press was on another piece, while the pointer is near: it is said how to sculpt that.
  std::optional<Camera::Pixel> refused_at;
};

/// What the panel of keys waits for.
struct KeyChoice {
  std::optional<KeyAim> waiting;   ///< for a key
  std::optional<KeyChord> wanted;  ///< by it, which something else has: it is asked about
  std::string refused;             ///< why the last key could not be given; "" it could
  bool asks_to_reset = false;      ///< all of them
  std::string filter;
};

/// What the palette of brushes with names waits for.
struct PresetChoice {
  std::string chosen;          ///< the name of the one chosen last; "" none
  std::string name;            ///< that is being typed
  bool waits_for_key = false;  ///< the one chosen
  std::string refused;         ///< why the last name or key could not be taken; "" it could
  // For the program, once a frame: files of these names.
  std::vector<std::string> to_write;
  std::vector<std::string> to_remove;
};

/// How many of them are remembered.
inline constexpr std::size_t kMostPressures = 256;

/// A reference image that is wanted, until it was read.
struct ReferenceWish {
  std::filesystem::path file;  ///< absolute
  StraightView view = StraightView::front;
  bool is_asked = false;    ///< the reader knows of it
  bool is_dropped = false;  ///< it is not wanted any more
};

/// A picture larger than the window.
struct StillChoice {
  bool is_open = false;  ///< the dialog
  StillOptions options;
  std::optional<double> done;  ///< how much of it, while it is made
};

/// Pictures of a turntable: three seconds of a film.
inline constexpr int kTurntableFrames = 72;

/// A project without a name that a killed window left.
struct LeftProject {
  std::filesystem::path file;
  std::string text;   ///< its name and when it was last changed
  std::string state;  ///< the same for a program, to the second
};

/// A picture that the renderer keeps for panels.
struct ShownPicture {
  std::uintptr_t number = 0;  ///< Renderer::keep_image; 0: there is none
  int width = 0;              ///< pixels
  int height = 0;
};

/// A file in a list. The pixels of its pictures are the renderer's.
struct ShownFile {
  FileLook look;
  ShownPicture picture;        ///< as it was saved
  ShownPicture work;           ///< with steps that are not saved
  std::size_t work_steps = 0;  ///< that it shows
};

/// The files of the list that is open.
struct FileShelf {
  std::vector<std::filesystem::path> wanted;         ///< in its order
  std::map<std::filesystem::path, ShownFile> known;  ///< of these, those that were looked at
};

/// The state of the window: all that neither the document nor the renderer keeps.
struct UiState {
  Brush brush;
  Camera camera;
  ShowState show;
  PanelState panels;

  Camera::Pixel pointer;
  double panel_scale = 1.0;  ///< of the last frame (scale_of_panels): marks are as large as letters
  bool is_pointer_over_clay_view = false;
  std::optional<Chord> chord;  ///< through the slice's material, under the pointer
  bool is_hand_led = false;    ///< the mouse leads a device's hand, which works the clay
  std::optional<BrushDrag> brush_drag;
  MeasureChoice measures;
  KeyMap keys;
  KeyChoice key_choice;
  std::vector<BrushPreset> presets;  ///< by name
  PresetChoice preset_choice;
  Favourites favourites = usual_favourites();
  PieMenu pie;  ///< their ring
  SearchChoice search;
  OutlineChoice outlines;
  std::optional<OutlineDrag> outline;  ///< while it is drawn
  std::optional<StrokeGuide> guide;    ///< likewise

  FileWish file_wish = FileWish::none;
  AfterSaving after_saving = AfterSaving::nothing;
  bool asks_to_save = false;  ///< the dialog is open
  bool asks_to_drop =
      false;  ///< in the dialog about what was left: asks again before it is removed
  std::filesystem::path waiting_file;  ///< of AfterSaving::open_file
  io::StartShape waiting_start{
      io::StartShape::Kind::ball, {25.0, 50.0, 50.0}, {}};  ///< of make_new
  ImportChoice import;                                      ///< of the dialog about a mesh
  ImportMesh waiting_import;                                ///< of AfterSaving::import_mesh
  HapticChoice haptics;
  OperationChoice operation;
  MaskChoice mask;
  PieceChoice pieces;
  io::ExportOptions export_options;
  mesh::Printer printer;
  std::vector<mesh::Printer> printers;  ///< that can be chosen
  std::vector<AlphaChoice> alphas;      ///< likewise, once they were asked for
  bool wants_alphas = false;            ///< they shall be read, if they were not
  bool reads_alphas = false;            ///< they are being read
  Settings settings;
  std::vector<float> pressures;    ///< of the pen's last strokes, as it told them, the newest last
  std::filesystem::path firmware;  ///< as in Settings, unless the command line named another

  std::vector<ReferenceImage> references;
  std::vector<ReferenceWish> reference_wishes;
  std::optional<std::filesystem::path> dropped_image;  ///< it is asked what it is for
  std::optional<std::filesystem::path> dropped_alpha;  ///< to emboss with

  std::vector<std::filesystem::path> recent;
  std::optional<std::filesystem::path> forgotten_recent;  ///< it shall leave that list
  FileShelf shelf;
  std::filesystem::path marked_file;       ///< in the dialog that opens a project; "" none
  std::vector<LeftProject> left_projects;  ///< newest first; without the one that is open
  std::filesystem::path folder;            ///< of the last file
  std::vector<Notice> notices;             ///< of the window itself, to be shown
  std::size_t shown_step = 0;              ///< that the history was scrolled to
  bool wants_to_quit = false;
  bool wants_screenshot = false;
  bool wants_emergency_stop = false;  ///< the force shall end
  bool wants_force = false;           ///< and begin again, after a stop
  bool is_force_stopped = false;      ///< until wants_force
  bool places_drain = false;          ///< the next click on the clay says where
  bool draws_path = false;            ///< the next drag over the clay is a path of guidance
  std::vector<Vec3> drawn_path_mm;    ///< so far, while it is dragged
  bool is_clutched = false;           ///< the hand moves without the tool
  std::string other_under_pointer;    ///< the name of the piece that the pointer is over; "" none
  StillChoice still;
  int turntable_left = 0;  ///< pictures to come, of kTurntableFrames once around

  // What the document thread reports, copied once a frame.
  ClayState clay;
  Task task;
  std::shared_ptr<const PrintReport> report;
};

/// How a drag over the clay is taken: only masks and trims may be drawn by an outline.
inline DragForm drag_form_of(const UiState& ui) noexcept {
  if (ui.brush.action == Action::mask) return ui.outlines.mask;
  return ui.brush.action == Action::trim ? ui.outlines.trim : DragForm::brush;
}

/// The numbers of the mask's edits: what nobody has set is 8 voxels of the clay, and 4 for
/// cavities.
inline MaskChoice mask_numbers(const UiState& ui) noexcept {
  MaskChoice numbers = ui.mask;
  if (numbers.by_mm <= 0.0) numbers.by_mm = 8.0 * ui.clay.voxel_mm;
  if (numbers.cavity_mm <= 0.0) numbers.cavity_mm = 4.0 * ui.clay.voxel_mm;
  return numbers;
}

}  // namespace argil::viewer
