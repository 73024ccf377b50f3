// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <deque>
#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "argil/core/vec3.h"
#include "argil/viewer/view.h"

#include "commands/piece_edits.h"
#include "commands/ui_state.h"
#include "document/document_thread.h"
#include "gestures/gestures.h"
#include "gui/cut_off.h"
#include "gui/gui.h"
#include "haptics/haptic_control.h"
#include "input/input_script.h"
#include "input/window.h"
#include "panels/file_list.h"
#include "panels/panels.h"
#include "picture/renderer.h"
#include "picture/still.h"
#include "settings/file_looks.h"
#include "settings/image_reader.h"

namespace argil::viewer {

/// The window and all behind it: each frame takes events and what the document thread reports, and
/// draws.
///
/// Threads  the main one.
class App {
 public:
  App(ViewOptions options, std::filesystem::path home, std::unique_ptr<Window> window,
      std::unique_ptr<Renderer> renderer, std::vector<ScriptStep> script);
  ~App();
  App(const App&) = delete;
  App& operator=(const App&) = delete;

  /// Frames until it is closed. Errors  of a script's step; of the screenshot; of the first
  /// picture; internal for what OpenGL reported under checks_gl.
  Result<ViewReport> run();

 private:
  void open_first();
  void find_left_projects();
  Result<void> frame();
  std::optional<std::pair<double, double>> recent_latency() const;
  bool waits_for_events() const;
  bool may_panels_wait(double now_s, bool has_news) const;
  double wait_s() const;
  double next_frame_s(double now_s) const;
  Result<void> show(const Picture& picture, bool has_new_panels);
  Result<void> play_script();
  Result<bool> play(const ScriptStep& step);
  void take_events(const std::vector<InputEvent>& events);
  void take_news();
  void ask_for_lost_blocks(const Error& error);
  Result<void> take_blocks(PieceKey piece, const BlockNews& news);
  void take_pieces(bool was_idle);
  void follow_camera();
  bool is_view_told() const;
  void ask_for_hover();
  void draw_panels();
  Picture picture() const;
  void add_pieces(Picture& picture) const;
  void add_rings(Picture& picture) const;
  void add_planes(Picture& picture) const;
  void add_cut(Picture& picture) const;
  std::optional<Touch> touch() const;
  std::optional<FeltForce> felt() const;
  double arrow_mm_per_n() const;
  void add_force(Picture& picture) const;
  void add_path(Picture& picture) const;
  void take_over_path(bool had_clay);
  void tick_haptics(double now_s);
  void cut_slice();
  std::optional<Chord> chord() const;
  std::optional<SeenHalf> seen_half() const;
  void note_motion(double now_s);
  bool is_moving() const;
  SurfaceProbe probe(const Camera::Pixel& pixel);
  void note_last_frame();
  Result<void> take_shots();
  Result<void> turn_table();
  Picture bare_picture() const;
  double still_detail() const;
  DisplayView wanted_view() const;
  std::filesystem::path still_file() const;
  void step_still();
  void write_still();
  void wait_for_still();
  void end_still(Notice notice);
  void take_screenshot();
  bool has_ended();
  void drop_untouched();
  void note_recent();
  void forget_recent();
  std::vector<std::filesystem::path> listed_files() const;
  ShownPicture kept_picture(const std::shared_ptr<const ReferencePixels>& pixels);
  void drop_file(const ShownFile& file);
  void follow_files();
  void ask_for_images();
  void take_images();
  bool is_awaited(const std::filesystem::path& file) const;
  void take_pixels(const std::filesystem::path& file, const ImageReader::News::Pixels& read);
  void take_alphas(AlphaList list);
  void take_added_alpha(const Result<std::filesystem::path>& added);
  void take_dropped(const std::vector<std::string>& files);
  void follow_references();
  void open_references();
  void add_references(Picture& picture) const;
  void start_empty();
  void read_habits();
  void keep_settings();
  void keep_keys();
  void keep_presets();
  void keep_favourites();
  void take_preset(const std::filesystem::path& file);
  void note_measurements();
  void tell(Notice notice);

  ViewOptions options_;
  std::filesystem::path home_;
  std::unique_ptr<Window> window_;
  std::unique_ptr<Renderer> renderer_;
  UiState ui_;
  std::unique_ptr<HapticControl> haptics_;  // outlives the document thread, which uses its ring
  DocumentThread document_;
  ImageReader images_;
  Gui gui_;
  CutOff cut_off_;
  FileList files_;
  FileLooks looks_;
  Gestures gestures_;
  std::deque<ScriptStep> script_;             ///< what is still to be played
  bool has_script_ = false;                   ///< there was one: the window ends with it
  int wait_frames_ = 0;                       ///< until its next step
  std::optional<Vec3> pointed_at_;            ///< where the widget of its step was two frames ago
  std::vector<std::filesystem::path> shots_;  ///< to be stored once this frame is drawn
  std::optional<Still> still_;                ///< that is being drawn, of still_picture_
  Picture still_picture_;
  std::pair<int, int> still_part_;  ///< the size of its parts
  std::filesystem::path still_path_;
  std::atomic<bool> stops_still_{false};
  std::future<Result<void>> still_written_;  ///< while it is written
  int turntable_ = 0;                        ///< which one is being made

  MessageLog log_;
  Settings kept_settings_;  ///< as they are in the file
  KeyMap kept_keys_;        ///< likewise
  Favourites kept_favourites_;
  std::optional<SlicePicture> slice_;
  FrameState last_frame_;
  DisplayView shown_view_;  ///< that the document thread was told last, and when
  double view_sent_s_ = -1.0;
  // The last question about the pointer, so that it is not asked again with every frame.
  std::optional<Ray> asked_;
  std::optional<Touch> asked_touch_;
  double most_shown_n_ = 0.0;             ///< without a device
  std::optional<FeltForce> shown_force_;  ///< as the last frame drew it
  bool has_new_blocks_ = false;           ///< since that question: its answer may be another now
  double last_s_ = 0.0;                   ///< when the last frame began
  std::pair<int, int> refused_size_;      ///< of the last picture, if the driver could not draw it
  std::int64_t lost_at_ = -1;       ///< ClayState::changes when all blocks were asked for again
  bool is_at_rest_ = false;         ///< the last frame had nothing new to show
  bool owes_panels_ = false;        ///< they look different from how they were drawn
  double shown_s_ = 0.0;            ///< when the window was last drawn
  Lens seen_lens_;                  ///< of the last frame
  Placement dragged_;               ///< where the piece that is dragged was in it
  double moved_s_ = 0.0;            ///< when it was last another one
  bool in_motion_ = false;          ///< that was just now
  bool is_fluent_ = true;           ///< all of the clay is drawn in less time than a turn needs
  int frames_to_settle_ = 0;        ///< that follow each other without waiting for events
  double next_frame_s_ = 0.0;       ///< when one is due without an event
  std::int64_t framed_ = 0;         ///< ClayState::number of the clay that the camera has framed
  std::int64_t framed_pieces_ = 0;  ///< ClayState::pieces_added that the camera has framed
  std::vector<ReferenceImage> kept_references_;  ///< as they are in the file
  std::vector<std::string> unread_references_;   ///< ReferenceList::unread of that file
  std::int64_t referenced_clay_ = 0;             ///< ClayState::number of the clay that they are of
  std::filesystem::path referenced_file_;
  std::optional<PieceKey> active_piece_;  ///< of the last frame
  MarkedClay marked_;                     ///< likewise
  bool has_started_ = false;              ///< the document thread has done the first requests
  bool has_begun_ = false;                ///< with a clay, or there was none to begin with
  std::filesystem::path last_file_;       ///< that the title names
  bool has_asked_alphas_ = false;
  bool has_told_alphas_ = false;        ///< of files there that are no images
  std::vector<double> shown_inputs_s_;  ///< of inputs whose dabs this frame shows first
  std::vector<double> frame_ms_;
  std::vector<double> latency_ms_;
  ViewReport report_;
};

}  // namespace argil::viewer
