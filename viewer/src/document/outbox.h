// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "argil/core/progress.h"
#include "argil/engine/pick.h"

#include "document/clay_state.h"
#include "document/scene_feed.h"
#include "document/touch.h"
#include "picture/renderer.h"

namespace argil::viewer {

/// A plane whose slice through the clay is asked for.
struct SlicePlane {
  Vec3 corner_mm, along_mm, down_mm;
  int columns = 0;
  int rows = 0;
  friend bool operator==(const SlicePlane&, const SlicePlane&) = default;
};

/// What a ray meets, and what would be felt there; in the sculpture's frame.
struct PointerAnswer {
  Ray ray;
  std::optional<Pick> pick;  ///< of the active piece, where no other is in front of it
  std::optional<FeltForce> felt;
  PieceKey piece = 0;  ///< the active one, and where it stood
  Placement placement;
  std::string other;  ///< the name of the piece that is met instead; "" none
};

/// What the document thread has made and the window has not taken yet.
///
/// Threads  any: every call holds the lock for as long as a move or a copy takes.
class Outbox {
 public:
  /// `on_news` is called by whoever posts, once until the blocks are taken, which the window does
  /// first: it wakes the window.
  explicit Outbox(std::function<void()> on_news = {}) : on_news_(std::move(on_news)) {}

  /// Something was posted, or is there to be seen elsewhere.
  void announce();
  bool has_news() const noexcept { return has_news_; }

  void post(Notice notice);
  void post_blocks(SceneNews news, const std::vector<double>& shown_inputs_s);
  void post_slice(SlicePicture slice);
  void post_state(ClayState state, std::shared_ptr<const PrintReport> report);

  /// A task that says how far it is and ends when it is told to.
  Progress begin_task(std::string name);
  /// A task that neither tells how far it is nor can be stopped.
  void begin_silent_task(std::string name);
  void end_task();
  /// Stops the task that runs now; `stop_all` also those that begin later.
  void cancel_task() noexcept { cancels_ = true; }
  void stop_all() noexcept { is_ending_ = true; }

  /// Only the look at a mesh with this number is waited for; 0 none.
  void want_look(std::int64_t number) noexcept { wanted_look_ = number; }
  bool is_look_wanted(std::int64_t number) const noexcept { return wanted_look_ == number; }

  /// What a renderer has to take, once; with the input times whose dabs it shows.
  SceneNews take_blocks(std::vector<double>& shown_inputs_s);
  std::optional<SlicePicture> take_slice();
  std::vector<Notice> take_notices();
  bool has_blocks() const;

  ClayState state() const;
  std::shared_ptr<const PrintReport> report() const;
  Task task() const;

 private:
  void set_task(Task task);

  mutable std::mutex mutex_;
  SceneNews news_;
  std::vector<double> shown_inputs_s_;
  std::optional<SlicePicture> slice_;
  std::vector<Notice> notices_;
  ClayState state_;
  std::shared_ptr<const PrintReport> report_;
  Task task_;
  std::function<void()> on_news_;
  std::atomic<bool> has_news_{false};
  std::atomic<bool> cancels_{false};
  std::atomic<bool> is_ending_{false};
  std::atomic<std::int64_t> wanted_look_{0};
};

}  // namespace argil::viewer
