// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/viewer/view.h"

#include <exception>
#include <new>
#include <utility>

#include "app/app.h"
#include "base/text.h"
#include "document/document.h"
#include "gl/gl_renderer.h"

namespace argil::viewer {
namespace {

/// Errors  bad_input for a number out of range.
Result<void> check_number(const char* name, int value, int least, int most) {
  if (value >= least && value <= most) return {};
  return Error{ErrorKind::bad_input, std::string(name) + " is " + std::to_string(value) +
                                         "; must be " + std::to_string(least) + " to " +
                                         std::to_string(most)};
}

/// What a device would refuse only once it is chosen.
Result<void> check_feel(const ViewOptions& options) {
  if (options.position_filter) {
    if (auto good = haptics::validate(*options.position_filter); !good) return good;
  }
  if (auto good = haptics::validate(options.mix); !good) return good;
  constexpr double kMost = haptics::ModeBlend::kMostRampS;
  if (options.mix_ramp_s >= 0.0 && options.mix_ramp_s <= kMost) return {};
  return Error{ErrorKind::bad_input, "the mix ramp is " + std::to_string(options.mix_ramp_s) +
                                         " s; must be 0 to " + std::to_string(kMost) + " s"};
}

/// Options and script are checked before the window opens.
Result<ViewReport> open_and_run(const ViewOptions& options) {
  if (auto good = check_number("the window's width", options.width, 320, 8192); !good) {
    return good.error();
  }
  if (auto good = check_number("the window's height", options.height, 240, 8192); !good) {
    return good.error();
  }
  if (auto good = check_number("the number of frames", options.frames, 0, 1'000'000); !good) {
    return good.error();
  }
  if (options.device != "mouse" && options.device != "sim" && options.device != "falcon" &&
      !(options.device.starts_with("replay:") && options.device.size() > 7)) {
    return Error{ErrorKind::bad_input, "the device is " + in_quotes(options.device) +
                                           "; must be mouse, sim, falcon or replay:RUN.csv"};
  }
  if (auto good = check_feel(options); !good) return good.error();
  std::vector<ScriptStep> script;
  if (!options.input.empty()) {
    auto read = read_input_script(options.input);
    if (!read) return read.error();
    script = std::move(read).value();
  }
  auto window = Window::open(options.width, options.height, options.checks_gl);
  if (!window) return window.error();
  auto renderer = make_gl_renderer();
  if (!renderer) return renderer.error();
  App app(options, options.home.empty() ? usual_home() : options.home, std::move(window).value(),
          std::move(renderer).value(), std::move(script));
  return app.run();
}

}  // namespace

Result<ViewReport> view(const ViewOptions& options) {
  try {
    return open_and_run(options);
  } catch (const std::bad_alloc&) {
    return Error{ErrorKind::memory, "not enough memory for the window; close other programs"};
  } catch (const std::exception& fault) {
    return Error{ErrorKind::internal,
                 std::string("the window failed (") + fault.what() + "); please report this"};
  }
}

}  // namespace argil::viewer
