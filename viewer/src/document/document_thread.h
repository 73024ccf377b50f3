// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "argil/core/vec3.h"
#include "argil/engine/display_surface.h"
#include "argil/engine/pick.h"

#include "document/measure_pick.h"
#include "document/outbox.h"
#include "document/request.h"
#include "settings/thumbnail.h"

namespace argil::viewer {

struct DocumentThreadOptions {
  std::filesystem::path home;  ///< a folder for what has no name yet
  /// Called on the thread when there is something to take, once until the blocks are taken.
  std::function<void()> on_news = {};
  PicturePlaces places = {};  ///< of pictures of projects; none: none are kept
};

/// A thread that owns the document (clay and session), does what is requested in order, and answers
/// with blocks to draw and states to show. The caller never waits for it. Views, rays, slices and
/// strokes are in the sculpture's frame, whichever piece they meet.
///
/// Threads  all but the constructor and the destructor: any thread, usually the window's.
class DocumentThread {
 public:
  explicit DocumentThread(DocumentThreadOptions options);
  /// Ends the thread; an open session leaves its journal, as after a kill.
  ~DocumentThread();
  DocumentThread(const DocumentThread&) = delete;
  DocumentThread& operator=(const DocumentThread&) = delete;

  void send(Request request);

  /// The newest view counts; blocks follow it soon.
  void look(const DisplayView& view);

  /// Where a ray meets the clay, and what would be felt there: the newest question counts.
  void ask(const Ray& ray, const std::optional<Touch>& touch = {});
  std::optional<PointerAnswer> answer() const;

  /// Where rays meet the clay exactly, once all that was sent before is done: of each number the
  /// newest question counts.
  void measure(const MeasureQuestion& question);
  /// The answers so far, once.
  std::vector<MeasureAnswer> take_measured();

  /// What a slice through the clay shows; nothing when a plane was never asked for.
  void cut(const std::optional<SlicePlane>& plane);
  /// The newest slice, once.
  std::optional<SlicePicture> take_slice() { return outbox_.take_slice(); }

  /// What a renderer has to take, once; with the input times whose dabs it shows.
  SceneNews take_blocks(std::vector<double>& shown_inputs_s) {
    return outbox_.take_blocks(shown_inputs_s);
  }
  std::vector<Notice> take_notices() { return outbox_.take_notices(); }
  ClayState state() const { return outbox_.state(); }
  std::shared_ptr<const PrintReport> report() const { return outbox_.report(); }

  Task task() const { return outbox_.task(); }
  void cancel_task() noexcept { outbox_.cancel_task(); }
  /// Nobody waits for a look at a mesh any more: one that runs ends, one that waits is skipped.
  void stop_looking() noexcept { outbox_.want_look(0); }

  /// Whether on_news was called since the blocks were taken.
  bool has_news() const noexcept { return outbox_.has_news(); }

  /// All that was sent is done and taken.
  bool is_idle() const;

 private:
  void run();

  DocumentThreadOptions options_;
  Outbox outbox_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<Request> requests_;
  bool is_ending_ = false;
  bool is_busy_ = false;
  bool has_backlog_ = false;
  std::optional<DisplayView> view_;
  bool has_new_view_ = false;
  struct Question {
    Ray ray;
    std::optional<Touch> touch;
  };
  std::optional<Question> question_;
  std::optional<PointerAnswer> answer_;
  std::vector<MeasureQuestion> measures_;
  std::vector<MeasureAnswer> measured_;
  std::optional<SlicePlane> plane_;
  bool has_new_plane_ = false;
  std::thread thread_;
};

}  // namespace argil::viewer
