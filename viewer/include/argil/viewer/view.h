// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "argil/core/result.h"
#include "argil/core/vec3.h"
#include "argil/haptics/falcon/falcon_device.h"
#include "argil/haptics/force/force_mix.h"
#include "argil/haptics/servo/adaptive_damping.h"
#include "argil/haptics/servo/guidance.h"
#include "argil/haptics/servo/position_filter.h"

namespace argil::viewer {

/// What a window opens with. The defaults are those of `argil view` without options.
struct ViewOptions {
  /// A project to open, or a mesh to import; "": what a killed window left, else a ball. If it
  /// cannot be opened the window says so.
  std::filesystem::path file;
  /// mouse (none), sim, falcon, or replay:FILE, a recording of the servo's ticks. It can be changed
  /// in the window, which says so if a device cannot be started, and goes on with the mouse.
  std::string device = "mouse";
  /// Of a falcon. Its firmware "": what was chosen last, else ARGIL_FALCON_FIRMWARE.
  haptics::FalconOptions falcon;
  /// As RigOptions has the four; they can be changed in the window.
  haptics::DampingKind damping = haptics::DampingKind::fixed;
  std::optional<haptics::PositionFilterOptions> position_filter;
  haptics::ForceMix mix;
  double mix_ramp_s = haptics::ModeBlend::kUsualRampS;
  /// Along a path on the clay; shown, and felt where there is a device. It can be changed in the
  /// window. As haptics::check_guidance takes it.
  haptics::GuidanceOptions guidance;
  int width = 1280;  ///< of the window, 320 to 8192 pixels
  int height = 800;  ///< 240 to 8192

  /// Ends after so many frames, at most 1000000, drawn without waiting for the screen; 0: until the
  /// window is closed, or the script has been played.
  int frames = 0;
  /// PNG, of the last of `frames`; "": none. Without a number of frames nothing is stored.
  std::filesystem::path screenshot;

  /// A script played into the window as if by a user (docs/viewer.md); "": none. What a real user
  /// does meanwhile counts too. All of it is read before the window opens.
  std::filesystem::path input;

  /// Where what has no name yet, settings, printers and the list of recent files are kept, and
  /// pictures of these; "": the user's own folder, $XDG_DATA_HOME/argil or ~/.local/share/argil,
  /// with the pictures of what is saved in the desktop's cache of thumbnails.
  std::filesystem::path home;

  /// The status line says how long after an input its dab was on the screen (ViewReport has it
  /// always).
  bool shows_latency = false;

  /// Asks for a debug context, counts what it reports (ViewReport::gl_errors), and makes any error
  /// that of `view` at the end; slower.
  bool checks_gl = false;
};

/// What the user measured on the clay, as the window showed it at its end.
struct ViewMeasurement {
  std::string kind;    ///< distance, angle, thickness
  double value = 0.0;  ///< mm; of an angle degrees
  std::vector<Vec3>
      points_mm;           ///< in the sculpture's frame: two; of an angle three, its corner second
  bool is_current = true;  ///< false: the clay there is no longer as it was when they were picked
};

/// What a window measured, from its opening to its end. Times are of whole frames: input, the
/// clay's changes, drawing and the swap. Quantiles are by nearest rank, 0 of nothing.
struct ViewReport {
  std::int64_t frames = 0;
  double frame_ms_p50 = 0.0;
  double frame_ms_p99 = 0.0;
  /// Applied to the clay, mirror images included, of the mouse and of the device.
  std::int64_t dabs = 0;
  std::int64_t uploaded_bytes = 0;  ///< to the graphics card, of blocks
  /// From an input event to the end of the frame that shows its dab; 0 without a stroke.
  double latency_ms_p50 = 0.0;
  double latency_ms_p99 = 0.0;
  /// The largest that the device was given, or that was shown without one.
  double most_force_n = 0.0;
  /// How late ticks of the servo began; 0 where none runs at the end.
  double servo_lateness_us_p50 = 0.0;
  double servo_lateness_us_p99 = 0.0;
  /// How old the clay was that the hand felt; 0 where none was.
  double clay_age_ms_p50 = 0.0;
  double clay_age_ms_p99 = 0.0;
  double clay_age_ms_max = 0.0;
  /// Of OpenGL that live at the end, before they are freed: what grows from run to run is a leak.
  std::int64_t gl_objects = 0;
  std::int64_t gl_errors = 0;                 ///< of a debug context, else 0
  std::vector<ViewMeasurement> measurements;  ///< oldest first; those of hidden pieces left out
  /// What was shown to the user as an error, in order. None of it makes `view` fail.
  std::vector<std::string> complaints;
  /// The titles of the panels and dialogs that were shown while a script was played, each once.
  std::vector<std::string> panels;
  /// What could not be seen whole meanwhile, each once: a title or a button's words, and how.
  std::vector<std::string> cut_off;
};

/// Opens the window, and returns when it is closed, a signal asks for the end (io::interrupted), or
/// frames or script are done. What was not saved is in the journal then.
///
/// Errors   bad_input for options out of range, or a script line that is not understood: no window
///          was opened. disk for a script that cannot be read or a picture that cannot be written.
///          device when there is no display or no OpenGL 3.3, with the remedy. bad_input also for a
///          script that points at what the window does not show. memory. internal for what
///          `checks_gl` found, and for what a library threw. The clay is in its journal after each.
/// Threads  the main one, as window systems ask for; one window at a time. Starts the thread that
///          owns the clay, and with a device the servo's; a Falcon has its own.
/// Files    everything under `home`, the project that is open and its journal; pictures in
///          $XDG_CACHE_HOME/thumbnails or ~/.cache/thumbnails, where `home` is ""; other files
///          where the user says.
Result<ViewReport> view(const ViewOptions& options);

}  // namespace argil::viewer
