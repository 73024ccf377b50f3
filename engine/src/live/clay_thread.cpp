// SPDX-License-Identifier: GPL-3.0-or-later
// The servo never waits for this thread: it polls, and naps for a millisecond when nothing came.
#include "argil/engine/clay_thread.h"

#include <cassert>
#include <chrono>
#include <exception>
#include <new>
#include <system_error>
#include <utility>

namespace argil {
namespace {

constexpr std::chrono::milliseconds kNap{1};

/// Runs `part`; what it throws becomes an error without a message, since that would need memory.
template <class Part>
Result<void> guarded(const Part& part) noexcept {
  try {
    return part();
  } catch (const std::bad_alloc&) {
    return Error{ErrorKind::memory, {}};
  } catch (const std::exception&) {
    return Error{ErrorKind::internal, {}};
  }
}

}  // namespace

Result<std::unique_ptr<ClayThread>> ClayThread::start(ClayWorker& worker, ClayHeartbeat& heartbeat,
                                                      std::function<Result<void>()> after_step) {
  try {
    std::unique_ptr<ClayThread> made(new ClayThread(worker, heartbeat, std::move(after_step)));
    heartbeat.alive.store(true, std::memory_order_release);
    made->thread_ = std::thread([runner = made.get()] { runner->run(); });
    return made;
  } catch (const std::system_error&) {
    heartbeat.alive.store(false, std::memory_order_release);
    return Error{ErrorKind::internal,
                 "the system gives no thread for the clay; end other programs and try again"};
  } catch (const std::bad_alloc&) {
    heartbeat.alive.store(false, std::memory_order_release);
    return Error{ErrorKind::memory, "not enough memory for the clay's thread"};
  }
}

ClayThread::~ClayThread() {
  is_stopping_.store(true, std::memory_order_relaxed);
  if (thread_.joinable()) thread_.join();
}

Result<void> ClayThread::stop() {
  assert(std::this_thread::get_id() != thread_.get_id());
  is_stopping_.store(true, std::memory_order_relaxed);
  if (thread_.joinable()) thread_.join();
  if (!result_ && result_.error().message.empty()) {
    const bool is_memory = result_.error().kind == ErrorKind::memory;
    result_ = Error{result_.error().kind,
                    is_memory ? "not enough memory in the clay's thread; use a larger voxel or a "
                                "smaller tool"
                              : "the clay's thread failed; please report this as a bug"};
  }
  return result_;
}

/// Whatever happens inside, the servo hears that nobody answers any more.
void ClayThread::run() noexcept {
  result_ = guarded([this] { return step_until_stopped(); });
  const Result<void> ended = guarded([this]() -> Result<void> {
    if (auto done = worker_.finish(); !done) return done.error();
    return {};
  });
  if (result_ && !ended) result_ = ended;
  heartbeat_.alive.store(false, std::memory_order_release);
}

Result<void> ClayThread::step_until_stopped() {
  for (;;) {
    const bool is_last = is_stopping_.load(std::memory_order_relaxed);
    const Result<bool> stepped = worker_.step();
    heartbeat_.beats.fetch_add(1, std::memory_order_relaxed);
    if (!stepped) return stepped.error();
    if (after_step_) {
      if (auto done = after_step_(); !done) return done.error();
    }
    if (is_last) return {};
    if (!stepped.value()) std::this_thread::sleep_for(kNap);
  }
}

}  // namespace argil
