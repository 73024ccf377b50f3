// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "argil/core/result.h"
#include "argil/haptics/falcon/falcon_device.h"

namespace argil::viewer {

struct ViewOptions {
  /// A project to open, or a mesh to import; "": what a killed window left, else a ball. If it
  /// cannot be opened the window says so.
  std::filesystem::path file;
  std::string device = "mouse";  ///< mouse, sim, falcon, or replay:FILE
  /// Of a falcon. Its firmware "": what was chosen last, else ARGIL_FALCON_FIRMWARE.
  haptics::FalconOptions falcon;
  int width = 1280;  ///< of the window, 320 to 8192 pixels
  int height = 800;  ///< 240 to 8192

  /// Ends after so many frames, and stores the last one; 0: until the window is closed.
  int frames = 0;
  std::filesystem::path screenshot;  ///< PNG, of the last frame; "": none

  /// A script played into the window instead of a user's input (docs/viewer.md); "": none.
  std::filesystem::path input;

  /// Where what has no name yet, settings, printers and the list of recent files are kept; "": the
  /// user's own folder, $XDG_DATA_HOME/argil or ~/.local/share/argil.
  std::filesystem::path home;

  bool checks_gl = false;  ///< an OpenGL error ends the program; slower
};

/// What a window measured. Times are of whole frames: input, the clay's changes, drawing and the
/// swap.
struct ViewReport {
  std::int64_t frames = 0;
  double frame_ms_p50 = 0.0;
  double frame_ms_p99 = 0.0;
  std::int64_t dabs = 0;
  std::int64_t uploaded_bytes = 0;     ///< to the graphics card, of blocks
  double latency_ms_p50 = 0.0;         ///< from an input event to the frame that shows its dab
  double latency_ms_p99 = 0.0;         ///< 0 without a stroke
  double most_force_n = 0.0;           ///< that the device was given, or that was shown without one
  double servo_lateness_us_p50 = 0.0;  ///< of its ticks; 0 without a device
  double servo_lateness_us_p99 = 0.0;
  std::int64_t gl_objects = 0;          ///< of OpenGL that live at the end
  std::int64_t gl_errors = 0;           ///< of a debug context
  std::vector<std::string> complaints;  ///< what was shown to the user as an error
};

/// Opens the window, and returns when it is closed. What was not saved is in the journal then.
///
/// Errors   device when there is no display or no OpenGL 3.3, with the remedy; bad_input for
///          options out of range, or a script line that is not understood; disk for a script that
///          cannot be read or a picture that cannot be written.
/// Threads  the main one, as window systems ask for.
Result<ViewReport> view(const ViewOptions& options);

}  // namespace argil::viewer
