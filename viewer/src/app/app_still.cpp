// SPDX-License-Identifier: GPL-3.0-or-later
// A picture larger than the window: a few of its parts in each frame, then its file by a thread of
// its own, so that the window goes on.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <future>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "argil/io/png.h"

#include "app/app.h"
#include "base/text.h"

namespace argil::viewer {

namespace fs = std::filesystem;

/// Without what belongs to the work on it. Ambient occlusion depends on what is around a part: it
/// is left out.
Picture App::bare_picture() const {
  Picture bare = picture();
  bare.is_moving = false;
  bare.right_lens.reset();
  bare.has_occlusion = false;
  bare.rings.clear();
  bare.arrows.clear();
  bare.handles.clear();
  bare.planes.clear();
  bare.pins.clear();
  bare.lines.clear();
  bare.references.clear();
  return bare;
}

/// How much finer the clay is wanted than the window shows it.
double App::still_detail() const {
  if (!ui_.still.done) return 1.0;
  const StillOptions& options = ui_.still.options;
  const double finer = static_cast<double>(options.height) / window_->height();
  return std::max({1.0, finer, static_cast<double>(options.width) / window_->width()});
}

/// The next free name.
fs::path App::still_file() const {
  const fs::path folder = ui_.folder.empty() ? fs::path(".") : ui_.folder;
  std::error_code error;
  for (int n = 1;; ++n) {
    fs::path file = folder / ("still-" + std::to_string(n) + ".png");
    if (!fs::exists(file, error)) return file;
  }
}

void App::end_still(Notice notice) {
  still_.reset();
  ui_.still.done.reset();
  tell(std::move(notice));
}

/// For a tenth of a second. Begun once the clay is there in as much detail as it needs.
void App::step_still() {
  if (!ui_.still.done) {
    still_.reset();
    stops_still_ = true;  // what becomes of it nobody waits for
    const bool is_over =
        still_written_.valid() &&
        still_written_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
    if (is_over) still_written_ = {};
    return;
  }
  if (still_written_.valid()) return wait_for_still();
  try {
    const int width = window_->width();
    const int height = window_->height();
    const bool is_ready = document_.is_idle() && is_view_told();
    if (!still_ && !is_ready) return;
    const bool fits = width >= Still::kLeastPartPixels && height >= Still::kLeastPartPixels;
    if (!fits || (still_ && std::pair(width, height) != still_part_)) {
      return end_still({Notice::Kind::warning,
                        "the still was stopped: the window changed its size; save it again"});
    }
    if (!still_) {
      still_picture_ = bare_picture();
      still_.emplace(ui_.still.options, still_picture_.lens, width, height);
      still_part_ = {width, height};
    }
    constexpr double kAtOnceS = 0.1;
    const double end_s = window_->now_s() + kAtOnceS;
    while (!still_->is_done() && window_->now_s() < end_s) {
      Picture part = still_picture_;
      part.lens = still_->lens();
      part.ground_rows = still_->rows();
      if (auto drawn = renderer_->draw(part, 0, width, height); !drawn) {
        return end_still(notice_of(drawn.error()));
      }
      still_->take(renderer_->read_image(0, width, height));
    }
    // Packing and writing it come after the last part.
    constexpr double kDrawn = 0.9;
    ui_.still.done = kDrawn * still_->fraction();
    if (still_->is_done()) write_still();
  } catch (const std::bad_alloc&) {
    end_still({Notice::Kind::error, "not enough memory for a still of that size; make it smaller",
               ErrorKind::memory});
  } catch (const std::system_error& error) {
    end_still({Notice::Kind::error,
               std::string("the still cannot be written, for want of a thread: ") + error.what() +
                   "; close other programs",
               ErrorKind::memory});
  }
}

void App::write_still() {
  still_path_ = still_file();
  stops_still_ = false;
  still_written_ = std::async(
      std::launch::async, [this, file = still_path_, image = std::move(*still_).image()] {
        return io::write_png(file, image,
                             [this](std::string_view, double) { return !stops_still_.load(); });
      });
  still_.reset();
}

void App::wait_for_still() {
  if (still_written_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  const Result<void> written = still_written_.get();
  // Of one that was stopped, though perhaps too late, after which another was asked for.
  if (stops_still_) return;
  end_still(written ? Notice{Notice::Kind::done, "saved " + in_quotes(still_path_.string())}
                    : notice_of(written.error()));
}

}  // namespace argil::viewer
