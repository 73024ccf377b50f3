// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <thread>
#include <utility>

#include "argil/core/clay_heartbeat.h"
#include "argil/core/result.h"
#include "argil/engine/clay_worker.h"

namespace argil {

/// Steps a worker on a thread of its own until it is stopped or the worker fails.
///
/// The thread naps for a millisecond when nothing waits, so that the servo never has to wake it.
/// When it ends it takes what still waits and ends the open stroke.
///
/// Threads  start, stop and the destructor: one thread, not the servo's. Worker and clay belong to
///          the runner's thread from start to stop.
class ClayThread {
 public:
  /// Starts the thread; heartbeat.alive is true from before the return until its end. `worker` and
  /// `heartbeat` must outlive it. `after_step`, when given, is called on the thread after each
  /// step, strokes open or not; what it takes, the hand waits for, and its error ends the thread.
  /// What it throws ends the thread as an error too.
  ///
  /// Errors   internal when the system gives no thread; memory. heartbeat.alive is false then.
  static Result<std::unique_ptr<ClayThread>> start(ClayWorker& worker, ClayHeartbeat& heartbeat,
                                                   std::function<Result<void>()> after_step = {});

  /// Stops as `stop` does; an error that ended the thread is lost: ask for it before.
  ~ClayThread();
  ClayThread(const ClayThread&) = delete;
  ClayThread& operator=(const ClayThread&) = delete;

  /// Waits for the step in hand, then for the last one, and returns the error that ended the
  /// thread, if one did. Again: the same result at once.
  ///
  /// Errors   of ClayWorker::step, of after_step, and of ClayWorker::finish, the first that came;
  ///          memory or internal for what was thrown. heartbeat.alive has been false since.
  /// Threads  not the clay's own, which it waits for.
  Result<void> stop();

 private:
  ClayThread(ClayWorker& worker, ClayHeartbeat& heartbeat,
             std::function<Result<void>()> after_step) noexcept
      : worker_(worker), heartbeat_(heartbeat), after_step_(std::move(after_step)) {}
  void run() noexcept;
  Result<void> step_until_stopped();

  ClayWorker& worker_;
  ClayHeartbeat& heartbeat_;
  std::function<Result<void>()> after_step_;
  std::atomic<bool> is_stopping_{false};
  Result<void> result_;  ///< the thread's own until it is joined
  std::thread thread_;
};

}  // namespace argil
