// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/app.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

#include <imgui.h>

#include "argil/io/png.h"
#include "argil/io/safe_file.h"

#include "base/text.h"
#include "commands/command.h"
#include "commands/measure.h"
#include "document/document.h"
#include "gestures/measure_marks.h"
#include "gestures/pie_gestures.h"
#include "gestures/piece_gestures.h"
#include "gui/layout.h"
#include "haptics/felt_tool.h"
#include "picture/stereo.h"
#include "settings/printer_list.h"

namespace argil::viewer {
namespace {

namespace fs = std::filesystem;

constexpr double kViewEveryS = 0.05;  // blocks follow a turning camera so often
constexpr double kRestS = 0.005;      // between frames that show nothing new
// How long a window that shows all there is waits for something to happen. A signal does not end
// the wait, so it ends by itself four times a second, and no frame is made.
constexpr double kLookUpS = 0.25;
constexpr int kFramesToSettle = 3;  // of panels after an event: a list opens in the second frame
// Between frames of what moves by itself: a hand or a stroke; a bar, a slider that is held, and an
// answer of the desktop.
constexpr double kLiveS = 1.0 / 60.0;
constexpr double kBarS = 0.05;
constexpr double kPlotsS = 0.2;  // between pictures in which only a device's plots moved
// While the camera turns, and so long after, a clay that takes longer to draw than this is drawn
// with fewer triangles. A whole frame of a screen that is waited for takes 17 ms.
constexpr double kMotionS = 0.15;
constexpr double kFluentMs = 25.0;

/// By nearest rank; 0 of nothing.
double quantile(std::vector<double> values, double fraction) {
  assert(fraction >= 0.0 && fraction <= 1.0);
  if (values.empty()) return 0.0;
  const auto at =
      static_cast<std::size_t>(std::lround(fraction * static_cast<double>(values.size() - 1)));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
  return values[at];
}

/// Letters of one text are played in one frame.
bool is_text(const ScriptStep& step) {
  const auto* played = std::get_if<PlayEvent>(&step.what);
  return played != nullptr && played->event.kind == InputEvent::Kind::text;
}

}  // namespace

App::App(ViewOptions options, fs::path home, std::unique_ptr<Window> window,
         std::unique_ptr<Renderer> renderer, std::vector<ScriptStep> script)
    : options_(std::move(options)),
      home_(std::move(home)),
      window_(std::move(window)),
      renderer_(std::move(renderer)),
      document_({home_, [] { Window::wake(); }, picture_places(home_, !options_.home.empty())}),
      images_(home_, [] { Window::wake(); }),
      gui_(*window_),
      // A script clicks what the window draws.
      files_(options_.input.empty()),
      looks_([places = picture_places(home_, !options_.home.empty())](
                 const std::filesystem::path& file) { return look_at_file(places, file); },
             [] { Window::wake(); }),
      gestures_(ui_, document_, [this](const Camera::Pixel& pixel) { return probe(pixel); }),
      script_(std::make_move_iterator(script.begin()), std::make_move_iterator(script.end())),
      has_script_(!script_.empty()) {
  assert(window_ != nullptr && renderer_ != nullptr);
  ui_.camera.look_from(normalized(Vec3{0.35, -1.0, 0.45}), {0.0, 0.0, 1.0});
  ui_.recent = read_recent(home_);
  ui_.settings = kept_settings_ = read_settings(home_);
  read_habits();
  PrinterList printers = read_printers(home_);
  ui_.printers = std::move(printers.printers);
  for (const Error& problem : printers.problems) {
    ui_.notices.push_back({Notice::Kind::warning, problem.message});
  }
  for (const mesh::Printer& printer : ui_.printers) {
    if (printer.name == ui_.settings.printer) ui_.printer = printer;
  }
  // A script or a test does not wait for the screen.
  window_->set_swap_interval(options_.frames > 0 || has_script_ ? 0 : 1);
  haptics_ = std::make_unique<HapticControl>(ui_, document_, options_.falcon);
  if (options_.device == "sim") ui_.haptics.device = DeviceChoice::sim;
  if (options_.device == "falcon") ui_.haptics.device = DeviceChoice::falcon;
  ui_.haptics.damping = options_.damping;
  ui_.haptics.is_filtered = options_.position_filter.has_value();
  ui_.haptics.filter = options_.position_filter.value_or(ui_.haptics.filter);
  ui_.haptics.mix = options_.mix;
  ui_.haptics.mix_ramp_s = options_.mix_ramp_s;
  ui_.firmware =
      options_.falcon.firmware.empty() ? ui_.settings.firmware : options_.falcon.firmware;
  ui_.haptics.guidance = options_.guidance;
  constexpr std::string_view kReplay = "replay:";
  if (options_.device.starts_with(kReplay)) {
    ui_.haptics.device = DeviceChoice::replay;
    ui_.haptics.replay_file = options_.device.substr(kReplay.size());
  }
  ui_.panels.has_haptics = ui_.haptics.device != DeviceChoice::mouse;
  find_left_projects();
  // Forget those that are gone or were worked on since.
  std::erase_if(ui_.settings.unasked, [this](const std::string& state) {
    return std::none_of(ui_.left_projects.begin(), ui_.left_projects.end(),
                        [&](const LeftProject& left) { return left.state == state; });
  });
  open_first();
}

/// Nobody waits for a still that is being written, nor looks on while the picture of the project
/// that was just saved is.
App::~App() {
  stops_still_ = true;
  window_->hide();
}

/// What the command line names, else the newest project that a killed window left and that is still
/// asked about; else nothing, and start_empty() makes a ball.
void App::open_first() {
  if (!options_.file.empty()) {
    document_.send(OpenFile{options_.file});
    return;
  }
  // What a killed window left without a name comes before an empty start.
  const std::vector<std::string>& unasked = ui_.settings.unasked;
  for (const LeftProject& left : ui_.left_projects) {
    if (std::find(unasked.begin(), unasked.end(), left.state) != unasked.end()) continue;
    document_.send(OpenFile{left.file});
    return;
  }
}

void App::find_left_projects() {
  ui_.left_projects.clear();
  for (const fs::path& file : left_untitled(home_)) {
    if (io::is_in_session(file)) continue;  // this window's, or another one's
    // The journal is what was written last.
    std::error_code error;
    auto when = fs::last_write_time(journal_of(file), error);
    if (error) when = fs::last_write_time(file, error);
    const auto clock = std::chrono::time_point_cast<std::chrono::system_clock::duration>(
        std::chrono::file_clock::to_sys(when));
    const auto second = std::chrono::floor<std::chrono::seconds>(clock).time_since_epoch().count();
    const std::string name = file.stem().string();
    ui_.left_projects.push_back({file, name + ", " + clock_text(clock, "%d %B %Y, %H:%M"),
                                 name + " " + std::to_string(second)});
  }
}

Result<ViewReport> App::run() {
  last_s_ = window_->now_s();
  while (!has_ended()) {
    if (auto done = frame(); !done) return done.error();
  }
  drop_untouched();
  // What tests and `argil view --json` read.
  report_.frames = static_cast<std::int64_t>(frame_ms_.size());
  report_.frame_ms_p50 = quantile(frame_ms_, 0.5);
  report_.frame_ms_p99 = quantile(frame_ms_, 0.99);
  report_.latency_ms_p50 = quantile(latency_ms_, 0.5);
  report_.latency_ms_p99 = quantile(latency_ms_, 0.99);
  report_.most_force_n = std::max(haptics_->most_force_n(), most_shown_n_);
  if (haptics_->is_running()) {
    const haptics::RigSnapshot& seen = haptics_->rig().look();
    report_.servo_lateness_us_p50 = seen.lateness.quantile_us(0.5);
    report_.servo_lateness_us_p99 = seen.lateness.quantile_us(0.99);
    report_.clay_age_ms_p50 = 1e-3 * seen.window_age.quantile_us(0.5);
    report_.clay_age_ms_p99 = 1e-3 * seen.window_age.quantile_us(0.99);
    report_.clay_age_ms_max = 1e-3 * seen.window_age.max_us();
  }
  report_.dabs = ui_.clay.dabs;
  report_.uploaded_bytes = renderer_->counts().uploaded_bytes;
  report_.gl_objects = renderer_->counts().objects;
  report_.gl_errors = renderer_->counts().errors;
  report_.panels = cut_off_.panels();
  report_.cut_off = cut_off_.found();
  if (options_.checks_gl && report_.gl_errors > 0) {
    return Error{ErrorKind::internal, "OpenGL reported " + std::to_string(report_.gl_errors) +
                                          " errors, the last: " + renderer_->last_error()};
  }
  return report_;
}

/// A new clay that nobody has touched is no work to be found again.
void App::drop_untouched() {
  const ClayState clay = document_.state();
  if (!clay.has_clay || !clay.is_untitled || clay.is_changed || !document_.is_idle()) return;
  document_.send(EndProject{false});
  // Removing a file takes no time; a disk that hangs is not waited for.
  for (int n = 0; n < 200 && !document_.is_idle(); ++n) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    document_.take_blocks(shown_inputs_s_);
  }
}

/// Asked before each frame: what ends the window by itself, then a signal, then the user.
bool App::has_ended() {
  if (options_.frames > 0 && static_cast<int>(frame_ms_.size()) >= options_.frames) return true;
  if (has_script_ && script_.empty() && wait_frames_ == 0 && shots_.empty() &&
      options_.frames == 0) {
    return true;
  }
  // A signal asks the process to end. Nothing can be saved any more (io::replace_file), and nothing
  // is lost: the journal has all of it.
  if (io::interrupted()) return true;
  if (!ui_.wants_to_quit || !document_.is_idle()) return false;
  // The session could not be ended: the message is on the screen, and nothing is lost.
  if (document_.state().has_clay) ui_.wants_to_quit = false;
  return ui_.wants_to_quit;
}

// ---- a frame -----------------------------------------------------------------------------------

Result<void> App::frame() {
  if (auto played = play_script(); !played) return played;
  const std::vector<InputEvent> events = window_->poll(wait_s());
  const double now = window_->now_s();
  const double start = now;
  const bool is_due = !waits_for_events() || now >= next_frame_s_;
  const bool has_news = !events.empty() || document_.has_news() || images_.has_news() ||
                        looks_.has_news() || window_->is_exposed();
  if (!is_due && !has_news) return {};
  if (has_news) frames_to_settle_ = kFramesToSettle;
  ui_.camera.resize(window_->width(), window_->height());
  take_events(events);
  gestures_.tick(now);
  take_news();
  follow_camera();
  ask_for_hover();
  cut_slice();
  ui_.measures.seen = seen_half();
  ui_.measures.slice = ui_.measures.seen ? &*slice_ : nullptr;
  tick_haptics(now);

  const auto felt_now = felt();
  if (felt_now && !haptics_->is_running()) {
    most_shown_n_ = std::max(most_shown_n_, length(felt_now->force_n));
  }
  shown_force_ = steadied(felt_now, shown_force_, ui_.camera.pixel_mm_at(ui_.camera.target_mm()),
                          arrow_mm_per_n());
  if (auto turned = turn_table(); !turned) return turned;
  step_still();
  note_last_frame();
  note_motion(now);
  ui_.chord = chord();
  const Picture picture = this->picture();
  ui_.panel_scale = scale_of_panels(window_->scale(), ui_.settings.panel_percent, window_->width(),
                                    window_->height());
  gui_.set_look(ui_.panel_scale, ui_.settings.theme);
  gui_.begin_frame(now - last_s_);
  // take_events() went by the panels of the frame before, and another event may not follow.
  ui_.is_pointer_over_clay_view = !gui_.takes_mouse();
  last_s_ = now;
  follow_files();
  draw_panels();
  ask_for_images();
  const bool has_new_panels = gui_.end_frame();
  if (has_script_) cut_off_.look();
  owes_panels_ = owes_panels_ || has_new_panels;
  const bool may_wait = may_panels_wait(now, has_news);
  // What fades or was laid out anew goes on; the plots of a device always do.
  const bool goes_on = has_new_panels && !haptics_->is_running();
  frames_to_settle_ = std::max(frames_to_settle_ - 1, goes_on ? 1 : 0);
  keep_settings();
  forget_recent();
  note_measurements();
  const RendererCounts former = renderer_->counts();
  if (auto shown = show(picture, owes_panels_ && !may_wait); !shown) return shown;

  const double end = window_->now_s();
  for (const double input : std::exchange(shown_inputs_s_, {})) {
    latency_ms_.push_back(1e3 * (end - input));
  }
  frame_ms_.push_back(1e3 * (end - start));
  const RendererCounts counts = renderer_->counts();
  if (counts.pictures != former.pictures)
    last_frame_ = {frame_ms_.back(), counts, recent_latency()};
  if (counts.whole_pictures != former.whole_pictures && !picture.is_moving) {
    is_fluent_ = frame_ms_.back() < kFluentMs;
  }
  next_frame_s_ = next_frame_s(now);
  return {};
}

/// A device's plots move all the time, and panels cannot be drawn without the picture below them.
/// While the hand is still and nobody does anything, a few times a second are enough.
bool App::may_panels_wait(double now_s, bool has_news) const {
  return haptics_->is_running() && waits_for_events() && !has_news && frames_to_settle_ == 0 &&
         now_s < shown_s_ + kPlotsS;
}

/// Of the strokes that a person remembers.
std::optional<std::pair<double, double>> App::recent_latency() const {
  constexpr std::size_t kMost = 500;
  if (!options_.shows_latency || latency_ms_.empty()) return std::nullopt;
  const std::size_t count = std::min(kMost, latency_ms_.size());
  const std::vector<double> recent(latency_ms_.end() - static_cast<std::ptrdiff_t>(count),
                                   latency_ms_.end());
  return std::pair{quantile(recent, 0.5), quantile(recent, 0.99)};
}

/// A script and a number of frames go on whatever happens.
bool App::waits_for_events() const { return !has_script_ && options_.frames == 0; }

/// How long the next frame may wait for an event.
double App::wait_s() const {
  const double rest_s = is_at_rest_ ? kRestS : 0.0;
  if (!waits_for_events()) return rest_s;
  return std::clamp(next_frame_s_ - window_->now_s(), rest_s, kLookUpS);
}

/// When there is something new to see though nothing happens until then.
double App::next_frame_s(double now_s) const {
  if (frames_to_settle_ > 0 || gui_.has_waiting_input() || ui_.turntable_left > 0 ||
      ui_.still.done) {
    return now_s;
  }
  double next_s = log_.next_s();
  const auto every = [&](bool is_wanted, double s) {
    if (is_wanted) next_s = std::min(next_s, now_s + s);
  };
  every(haptics_->is_running() || gestures_.is_stroke_open(), kLiveS);
  every(ui_.task.is_running || gui_.is_held() || files_.is_waiting(), kBarS);
  if (is_moving()) next_s = std::min(next_s, moved_s_ + kMotionS);
  // The last turn of the camera came too soon after the one before to be told of.
  if (!gestures_.is_stroke_open() && !is_view_told()) {
    next_s = std::min(next_s, view_sent_s_ + kViewEveryS);
  }
  return next_s;
}

/// Draws the picture and the panels into the window; nothing where the window shows them already. A
/// picture that the driver cannot draw is an error where none ever could be drawn, or where it is
/// to be stored. Otherwise it is told when the size or the driver's mind changes: panels and
/// messages are drawn all the same, and another size may do.
Result<void> App::show(const Picture& picture, bool has_new_panels) {
  const int width = window_->width();
  const int height = window_->height();
  const bool is_exposed = window_->take_exposed();
  is_at_rest_ = !is_exposed && !has_new_panels && shots_.empty() && !ui_.wants_screenshot &&
                renderer_->holds(picture, width, height);
  if (is_at_rest_) return {};
  owes_panels_ = false;
  shown_s_ = window_->now_s();
  if (auto drawn = renderer_->draw(picture, 0, width, height); !drawn) {
    if (renderer_->counts().pictures == 0 || !shots_.empty()) return drawn;
    ui_.wants_screenshot = false;
    const std::pair size{width, height};
    if (std::exchange(refused_size_, size) != size) tell(notice_of(drawn.error()));
  } else {
    refused_size_ = {};
  }
  gui_.draw();
  if (auto taken = take_shots(); !taken) return taken;
  window_->swap();
  return {};
}

void App::take_events(const std::vector<InputEvent>& events) {
  for (const InputEvent& event : events) {
    if (gui_.leaves_list(event)) continue;
    // The click that ends a change of the brush, or is for the ring of favourites, does not press
    // the panel under the pointer.
    const bool ends_brush_drag = ui_.brush_drag && event.kind == InputEvent::Kind::press;
    const bool is_taken = !ends_brush_drag && !is_for_pie(event, ui_) && gui_.feed(event);
    if (event.kind == InputEvent::Kind::close) {
      perform(Command::quit, ui_, document_);
    } else if (event.kind == InputEvent::Kind::drop) {
      take_dropped(event.files);
    } else {
      const bool is_key = event.kind == InputEvent::Kind::key_down ||
                          event.kind == InputEvent::Kind::key_up ||
                          event.kind == InputEvent::Kind::text;
      if (!is_key) ui_.is_pointer_over_clay_view = !is_taken;
      gestures_.on(event, is_taken && !gestures_.is_stroke_open());
    }
  }
}

/// Errors  memory: what there was no room for is not drawn, nor is what stood there before.
Result<void> App::take_blocks(PieceKey piece, const BlockNews& news) {
  if (news.is_fresh) renderer_->drop(piece);
  for (const BlockId& id : news.gone) renderer_->drop(piece, id);
  Result<void> taken;
  for (const auto& [id, block] : news.changed) {
    auto put = renderer_->put(piece, block);
    if (put) continue;
    renderer_->drop(piece, id);
    taken = std::move(put);
  }
  return taken;
}

/// Sent again all of them may fit, since those that are drawn go first. Once for each change of the
/// clay: it may fail as before.
void App::ask_for_lost_blocks(const Error& error) {
  const std::int64_t changes = document_.state().changes;
  if (std::exchange(lost_at_, changes) == changes) return;
  tell(notice_of(error));
  document_.send(SendBlocksAgain{});
}

void App::take_news() {
  const SceneNews news = document_.take_blocks(shown_inputs_s_);
  if (!news.empty()) has_new_blocks_ = true;
  for (const PieceKey piece : news.gone) renderer_->drop(piece);
  for (const auto& [piece, blocks] : news.pieces) {
    if (auto taken = take_blocks(piece, blocks); !taken) ask_for_lost_blocks(taken.error());
  }
  const std::shared_ptr<const Stamp> former_stamp = ui_.clay.stamp;
  const std::shared_ptr<const Alpha> former_alpha = ui_.clay.alpha;
  const bool was_asked = ui_.clay.left.has_value();
  const std::shared_ptr<const PieceList> former_pieces = ui_.clay.pieces;
  const bool was_idle = document_.is_idle();  // before: then the state is that of all that was sent
  ui_.clay = document_.state();
  // A piece that moves sends no blocks, and is another answer all the same.
  if (ui_.clay.pieces != former_pieces) asked_.reset();
  if (was_asked && !ui_.clay.left) find_left_projects();  // the answer may have removed one
  if (ui_.clay.stamp != former_stamp) {
    ui_.brush.mesh = ui_.clay.stamp->mesh;
    ui_.brush.shape = Shape::mesh;
  }
  if (ui_.clay.alpha != former_alpha) ui_.brush.alpha = ui_.clay.alpha->image;
  ui_.task = document_.task();
  ui_.report = document_.report();
  if (auto slice = document_.take_slice()) slice_ = std::move(slice);
  std::vector<Notice> notices = document_.take_notices();
  notices.insert(notices.end(), ui_.notices.begin(), ui_.notices.end());
  ui_.notices.clear();
  for (Notice& notice : notices) tell(std::move(notice));
  // Another clay is framed; one that was only saved under another name is not.
  if (ui_.clay.has_clay && framed_ != ui_.clay.number) {
    frame_in_each(ui_.camera, ui_.show.is_stereo, ui_.clay.all_bounds_mm);
    ui_.operation.drains.clear();
    take_over_path(framed_ > 0);
    framed_ = ui_.clay.number;
    framed_pieces_ = ui_.clay.pieces_added;
  }
  take_pieces(was_idle);
  if (ui_.clay.has_clay && ui_.clay.file != last_file_) {
    note_recent();
    find_left_projects();
  }
  follow_references();
  take_images();
  start_empty();
}

/// `was_idle`: all that was sent before is in the state.
///
/// A piece that was just added may stand outside of the picture. What lies on one piece, or in its
/// frame, is of no use to another.
void App::take_pieces(bool was_idle) {
  if (!ui_.clay.pieces) return;
  if (std::exchange(framed_pieces_, ui_.clay.pieces_added) != ui_.clay.pieces_added) {
    frame_in_each(ui_.camera, ui_.show.is_stereo, ui_.clay.all_bounds_mm);
  }
  const PieceKey active = ui_.clay.pieces->active_piece().key;
  if (std::exchange(active_piece_, active).value_or(active) != active) {
    ui_.operation.drains.clear();
    ui_.haptics.guidance.path_mm.clear();
    ui_.pieces.refused_at.reset();
    asked_.reset();
  }
  const MarkedClay former = std::exchange(
      marked_, {ui_.clay.surface_mm, ui_.clay.voxel_mm, ui_.clay.pieces->pieces.size()});
  follow_marks(former, marked_, ui_);
  // Shown there until the document has it there, or has refused.
  if (is_drag_done(ui_, was_idle)) ui_.pieces.drag.reset();
  const auto answer = document_.answer();
  const bool is_over = ui_.is_pointer_over_clay_view && answer;
  ui_.other_under_pointer = is_over ? answer->other : "";
}

/// A ball, where nothing could be opened at the start or what a killed window left is not wanted.
void App::start_empty() {
  if (!document_.is_idle()) return;
  has_started_ = true;
  if (has_begun_ || ui_.clay.left) return;
  has_begun_ = true;
  if (!ui_.clay.has_clay) document_.send(NewClay{ui_.waiting_start});
}

/// For the report, as long as there is a clay: what lies on it is gone with it.
void App::note_measurements() {
  if (!ui_.clay.has_clay) return;
  report_.measurements.clear();
  for (const Measurement& each : ui_.measures.list) {
    auto places = places_of(each.points, ui_);
    if (!places) continue;
    const double value = measured(each.kind, *places);
    report_.measurements.push_back(
        {word_of(each.kind), value, std::move(*places), is_current(each)});
  }
}

void App::tell(Notice notice) {
  if (notice.kind == Notice::Kind::error) report_.complaints.push_back(notice.text);
  log_.add(std::move(notice), window_->now_s(),
           clock_text(std::chrono::system_clock::now(), "%H:%M:%S"));
}

void App::note_recent() {
  last_file_ = ui_.clay.file;
  window_->set_title(
      (ui_.clay.is_untitled ? std::string("New clay") : ui_.clay.file.filename().string()) +
      " - Argil");
  if (ui_.clay.is_untitled) return;
  std::error_code error;
  const auto kept = add_recent(home_, fs::absolute(ui_.clay.file, error), ui_.recent);
  if (!kept) tell({Notice::Kind::warning, kept.error().message});
}

/// Tells the document thread where the camera is, for the levels of detail. Not while a stroke is
/// drawn, so that nothing but the stroke changes.
void App::follow_camera() {
  if (gestures_.is_stroke_open()) return;
  const double now = window_->now_s();
  if (is_view_told() || now - view_sent_s_ < kViewEveryS) return;
  shown_view_ = wanted_view();
  view_sent_s_ = now;
  document_.look(shown_view_);
}

/// In more detail than the window shows while a larger picture is made.
DisplayView App::wanted_view() const {
  DisplayView view = ui_.camera.display_view();
  const double detail = still_detail();
  view.pixel_rad /= detail;
  view.pixel_mm /= detail;
  return view;
}

bool App::is_view_told() const {
  const DisplayView view = wanted_view();
  return view.eye_mm == shown_view_.eye_mm && view.pixel_rad == shown_view_.pixel_rad &&
         view.pixel_mm == shown_view_.pixel_mm;
}

/// The question what the brush would feel, where the force is shown without a device.
std::optional<Touch> App::touch() const {
  if (!ui_.show.has_force || ui_.haptics.device != DeviceChoice::mouse) return std::nullopt;
  const auto answer = document_.answer();
  const double pixel_mm =
      answer && answer->pick ? ui_.camera.pixel_mm_at(answer->pick->point_mm) : 1.0;
  // Held still and touching: of the contact as much as then.
  haptics::ForceMaterial material = ui_.haptics.material;
  material.surface_force_n *= ui_.haptics.mix.contact_passive;
  return Touch{felt_tool(ui_.brush, radius_on(ui_.brush, pixel_mm)), material,
               ui_.haptics.press_mm};
}

/// Asks where the brush would be: again when pointer, camera or clay have moved, or when something
/// else would be felt there.
void App::ask_for_hover() {
  if (!ui_.clay.has_clay || ui_.task.is_running || gestures_.is_stroke_open()) return;
  if (!ui_.is_pointer_over_clay_view && !ui_.brush_drag) return;
  const Camera::Pixel at = ui_.brush_drag ? ui_.brush_drag->at : ui_.pointer;
  const Ray ray = part_at(ui_.camera, ui_.show.is_stereo, at).ray_at(at);
  const std::optional<Touch> touch = this->touch();
  const bool is_same = asked_ && asked_->origin_mm == ray.origin_mm &&
                       asked_->direction == ray.direction && asked_touch_ == touch &&
                       !has_new_blocks_;
  if (is_same) return;
  asked_ = ray;
  asked_touch_ = touch;
  has_new_blocks_ = false;
  document_.ask(ray, touch);
}

/// Notes whether the camera is another one than before, by any hand.
void App::note_motion(double now_s) {
  const Lens lens = ui_.camera.lens({});
  // A piece that is dragged moves as the camera does.
  const Placement dragged = ui_.pieces.drag ? ui_.pieces.drag->placement : Placement{};
  const bool is_new = std::exchange(seen_lens_, lens) != lens;
  if (!are_same(std::exchange(dragged_, dragged), dragged) || is_new) moved_s_ = now_s;
  in_motion_ = now_s - moved_s_ < kMotionS;
}

/// Whether fewer triangles do for this picture. One that is stored has all of them.
bool App::is_moving() const {
  return in_motion_ && !is_fluent_ && shots_.empty() && !ui_.wants_screenshot;
}

/// Of the clay with all its triangles, also while the camera still turns.
SurfaceProbe App::probe(const Camera::Pixel& pixel) {
  Picture picture = this->picture();
  if (std::exchange(picture.is_moving, false)) {
    moved_s_ = -kMotionS;
    in_motion_ = false;
    // Where it cannot be drawn nothing is under the pointer.
    static_cast<void>(renderer_->draw(picture, 0, window_->width(), window_->height()).ok());
  }
  const WindowPart part = part_at(ui_.camera, ui_.show.is_stereo, pixel);
  return {renderer_->read_depth(part.eye), part};
}

// ---- the hand and the panels -------------------------------------------------------------------

/// Leads the hand to the point of the clay under the pointer. What cannot be felt goes back to the
/// mouse, with a message.
void App::tick_haptics(double now_s) {
  std::optional<SurfaceHit> hit;
  const auto answer = document_.answer();
  const bool leads =
      (ui_.is_pointer_over_clay_view || gestures_.is_hand_pressing()) && !ui_.pieces.drag;
  if (leads && answer && answer->pick && answer->piece == active_key(ui_.clay)) {
    const Placement& at = answer->placement;  // the piece may have moved since
    hit = SurfaceHit{unplaced(at, answer->pick->point_mm), turned_back(at, answer->pick->normal)};
  }
  if (auto done = haptics_->tick(now_s, hit, gestures_.is_hand_pressing()); !done) {
    tell(notice_of(done.error()));
    ui_.haptics.device = DeviceChoice::mouse;
  }
  ui_.is_hand_led = haptics_->is_running() && ui_.haptics.device == DeviceChoice::sim &&
                    ui_.haptics.scene == "clay";
}

/// What the hand feels; without a device, what the brush under the pointer would feel.
std::optional<FeltForce> App::felt() const {
  if (haptics_->is_running()) {
    if (ui_.haptics.scene != "clay") return std::nullopt;
    // The device works in the frame of the piece.
    const haptics::RigSnapshot& seen = haptics_->rig().look();
    const Placement at = shown_placement(ui_);
    return FeltForce{placed(at, seen.tool_mm), haptics_->rig().options().tool.radii_mm.x,
                     turned(at, seen.placement.turned(seen.tick.force_n))};
  }
  const auto answer = document_.answer();
  const bool is_shown =
      asked_touch_ && ui_.is_pointer_over_clay_view && !gestures_.is_stroke_open();
  return is_shown && answer ? answer->felt : std::nullopt;
}

/// A path lies on the clay that it was drawn on: with another one it is gone. That of the command
/// line is of the first clay.
void App::take_over_path(bool had_clay) {
  std::vector<Vec3>& path = ui_.haptics.guidance.path_mm;
  if (had_clay) return path.clear();
  if (!path.empty()) document_.send(CheckPath{path, active_key(ui_.clay)});
}

void App::draw_panels() {
  // In this order they lie over each other; dialogs come after the panels, messages last.
  draw_outline(ui_);
  draw_measure_marks(ui_);
  draw_guide(ui_);
  draw_menu(ui_, document_);
  draw_tools(ui_);
  draw_brush(ui_, document_);
  draw_view(ui_);
  note_free_room(ui_);
  draw_info(ui_);
  draw_history(ui_, document_);
  draw_print(ui_, document_);
  draw_references(ui_);
  draw_pieces(ui_, document_);
  draw_presets(ui_);
  draw_favourites(ui_);
  draw_measures(ui_, document_);
  draw_haptics(ui_, *haptics_, document_);
  draw_thickness(ui_);
  draw_switch_hint(ui_);
  draw_status(ui_, last_frame_);
  draw_new_dialog(ui_, document_);
  draw_operations(ui_, document_);
  draw_recent(ui_, document_);
  draw_import(ui_, document_);
  draw_export(ui_);
  files_.draw(ui_, document_);
  draw_save_question(ui_, document_);
  draw_left_question(ui_, document_);
  draw_dropped_image(ui_);
  draw_still(ui_);
  draw_help(ui_);
  draw_keys(ui_);
  draw_search(ui_, document_);
  draw_task(ui_, document_);
  log_.tick(window_->now_s());
  if (!ui_.panels.has_messages) draw_toasts(log_);
  draw_messages(ui_, log_);
  draw_pie(ui_);
}

// ---- scripts and pictures ----------------------------------------------------------------------

/// One step a frame, so that each meets the panels as the last one left them.
Result<void> App::play_script() {
  if (wait_frames_ > 0) {
    --wait_frames_;
    return {};
  }
  if (script_.empty()) return {};
  // A typed text is one step.
  for (bool goes_on = true; goes_on;) {
    auto done = play(script_.front());
    if (!done) return done.error();
    if (!done.value()) return {};
    const bool was_text = is_text(script_.front());
    script_.pop_front();
    goes_on = was_text && !script_.empty() && is_text(script_.front());
  }
  return {};
}

/// False: the step cannot be done yet.
Result<bool> App::play(const ScriptStep& step) {
  if (const auto* event = std::get_if<PlayEvent>(&step.what)) {
    InputEvent played = event->event;
    window_->play(played);
  } else if (const auto* wait = std::get_if<WaitFrames>(&step.what)) {
    wait_frames_ = wait->frames - 1;
  } else if (std::holds_alternative<Settle>(step.what)) {
    // What is shown depends on from where: the thread must have been told.
    const bool is_working =
        !document_.is_idle() || ui_.task.is_running || !images_.is_idle() || !looks_.is_idle();
    if (!has_started_ || is_working || !is_view_told()) return false;
    wait_frames_ = 2;  // drawn, and its answers shown
  } else if (const auto* size = std::get_if<Resize>(&step.what)) {
    window_->resize(size->width, size->height);
  } else if (const auto* shot = std::get_if<Shot>(&step.what)) {
    shots_.push_back(shot->file);
  } else {
    const std::string& label = std::get<PointAt>(step.what).label;
    const auto position = gui_.position_of(label);
    if (!position) {
      std::string known;
      for (const std::string& name : gui_.labels()) known += " " + in_quotes(name);
      return Error{ErrorKind::bad_input, options_.input.string() + ":" + std::to_string(step.line) +
                                             ": nothing is labelled " + in_quotes(label) +
                                             "; there are" + known};
    }
    // Panels that answers of the document's thread still move would be missed by the press.
    if (pointed_at_ != position) {
      pointed_at_ = position;
      wait_frames_ = 1;
      return false;
    }
    pointed_at_.reset();
    InputEvent move;
    move.x = position->x;
    move.y = position->y;
    window_->play(move);
  }
  return true;
}

}  // namespace argil::viewer
