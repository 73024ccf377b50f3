// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of the window that are stored.
#include <cassert>
#include <cstdio>
#include <string>
#include <system_error>
#include <utility>

#include "argil/io/png.h"

#include "app/app.h"
#include "base/text.h"
#include "document/document.h"

namespace argil::viewer {

namespace fs = std::filesystem;

/// The next picture of a turntable, without panels and marks, into turntable-N-NN.png: the first N
/// that none has yet.
Result<void> App::turn_table() {
  // What is being drawn over the picture needs the camera where it is.
  if (ui_.turntable_left == 0 || ui_.outline) return {};
  const fs::path folder = ui_.folder.empty() ? fs::path(".") : ui_.folder;
  assert(ui_.turntable_left > 0 && ui_.turntable_left <= kTurntableFrames);
  const int number = kTurntableFrames - ui_.turntable_left--;
  const auto file_of = [&](int frame) {
    const std::string digits = std::to_string(100 + frame).substr(1);
    return folder / ("turntable-" + std::to_string(turntable_) + "-" + digits + ".png");
  };
  if (number == 0) {
    std::error_code error;
    for (turntable_ = 1; fs::exists(file_of(0), error);) ++turntable_;
  }
  Picture bare = picture();
  bare.is_moving = false;
  bare.rings.clear();
  bare.arrows.clear();
  bare.handles.clear();
  bare.planes.clear();
  bare.lines.clear();
  const fs::path file = file_of(number);
  auto saved = renderer_->draw(bare, 0, window_->width(), window_->height());
  if (saved) {
    saved = io::write_png(file, renderer_->read_image(0, window_->width(), window_->height()));
  }
  if (!saved) {
    ui_.turntable_left = 0;
    tell(notice_of(saved.error()));
    return {};
  }
  // A full turn is twice the drag of half a turn.
  ui_.camera.orbit(2.0 * window_->width() / kTurntableFrames, 0.0);
  if (ui_.turntable_left == 0) tell({Notice::Kind::done, "saved " + in_quotes(file.string())});
  return {};
}

/// The last one of --frames is stored.
void App::note_last_frame() {
  const bool is_last =
      options_.frames > 0 && static_cast<int>(frame_ms_.size()) + 1 == options_.frames;
  if (is_last && !options_.screenshot.empty()) shots_.push_back(options_.screenshot);
}

Result<void> App::take_shots() {
  if (std::exchange(ui_.wants_screenshot, false)) take_screenshot();
  if (shots_.empty()) return {};
  const Image image = renderer_->read_image(0, window_->width(), window_->height());
  for (const fs::path& file : std::exchange(shots_, {})) {
    if (auto saved = io::write_png(file, image); !saved) return saved;
  }
  return {};
}

/// Saves the window under the next free name.
void App::take_screenshot() {
  const fs::path folder = ui_.folder.empty() ? fs::path(".") : ui_.folder;
  int n = 1;
  std::error_code error;
  const auto name = [&] { return folder / ("argil-" + std::to_string(n) + ".png"); };
  while (fs::exists(name(), error)) ++n;
  const Image image = renderer_->read_image(0, window_->width(), window_->height());
  const auto saved = io::write_png(name(), image);
  tell(saved ? Notice{Notice::Kind::done, "saved " + in_quotes(name().string())}
             : notice_of(saved.error()));
}

}  // namespace argil::viewer
