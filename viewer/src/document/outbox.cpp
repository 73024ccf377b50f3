// SPDX-License-Identifier: GPL-3.0-or-later
// What is posted is made before the lock is taken, and what is taken once is swapped out whole.
#include "document/outbox.h"

#include <string_view>
#include <utility>

namespace argil::viewer {

void Outbox::announce() {
  if (!has_news_.exchange(true) && on_news_) on_news_();
}

void Outbox::post(Notice notice) {
  const std::lock_guard lock(mutex_);
  notices_.push_back(std::move(notice));
}

void Outbox::post_blocks(SceneNews news, const std::vector<double>& shown_inputs_s) {
  const std::lock_guard lock(mutex_);
  news_.append(std::move(news));
  shown_inputs_s_.insert(shown_inputs_s_.end(), shown_inputs_s.begin(), shown_inputs_s.end());
}

void Outbox::post_slice(SlicePicture slice) {
  const std::lock_guard lock(mutex_);
  slice_ = std::move(slice);
}

void Outbox::post_state(ClayState state, std::shared_ptr<const PrintReport> report) {
  const std::lock_guard lock(mutex_);
  state_ = std::move(state);
  report_ = std::move(report);
}

/// The Progress refers to this. It is called on the document thread, at most as often as the work
/// reports, and costs a lock each time. The window is told at once: other news of the thread wait
/// for the end of what is done.
Progress Outbox::begin_task(std::string name) {
  // Before the lock: who cancels now means the task that begins.
  cancels_ = false;
  set_task({true, true, name, 0.0});
  return [this, name = std::move(name)](std::string_view stage, double fraction) {
    set_task({true, true, stage.empty() ? name : std::string(stage), fraction});
    return !cancels_ && !is_ending_;
  };
}

void Outbox::begin_silent_task(std::string name) { set_task({true, false, std::move(name), 0.0}); }

void Outbox::end_task() { set_task({}); }

void Outbox::set_task(Task task) {
  {
    const std::lock_guard lock(mutex_);
    task_ = std::move(task);
  }
  announce();
}

SceneNews Outbox::take_blocks(std::vector<double>& shown_inputs_s) {
  has_news_ = false;  // before: what is posted from now on is announced again
  const std::lock_guard lock(mutex_);
  shown_inputs_s = std::exchange(shown_inputs_s_, {});
  return std::exchange(news_, {});
}

std::optional<SlicePicture> Outbox::take_slice() {
  const std::lock_guard lock(mutex_);
  return std::exchange(slice_, std::nullopt);
}

std::vector<Notice> Outbox::take_notices() {
  const std::lock_guard lock(mutex_);
  return std::exchange(notices_, {});
}

bool Outbox::has_blocks() const {
  const std::lock_guard lock(mutex_);
  return !news_.empty();
}

ClayState Outbox::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

std::shared_ptr<const PrintReport> Outbox::report() const {
  const std::lock_guard lock(mutex_);
  return report_;
}

Task Outbox::task() const {
  const std::lock_guard lock(mutex_);
  return task_;
}

}  // namespace argil::viewer
