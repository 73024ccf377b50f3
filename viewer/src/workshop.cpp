// SPDX-License-Identifier: GPL-3.0-or-later
#include "workshop.h"

#include <new>
#include <utility>

#include "bench.h"

namespace argil::viewer {
namespace {

/// Pieces of one stroke that wait are one: the hand was faster than the clay.
void merge_waiting(ExtendStroke& piece, std::deque<Command>& commands) {
  while (!commands.empty()) {
    auto* next = std::get_if<ExtendStroke>(&commands.front());
    if (next == nullptr) return;
    piece.samples.insert(piece.samples.end(), next->samples.begin(), next->samples.end());
    commands.pop_front();
  }
}

}  // namespace

Workshop::Workshop(WorkshopOptions options)
    : options_(std::move(options)), thread_([this] { run(); }) {}

Workshop::~Workshop() {
  {
    const std::lock_guard held(mutex_);
    is_ending_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void Workshop::run() {
  Bench bench(*this);
  std::unique_lock held(mutex_);
  for (;;) {
    const auto has_something = [this] {
      return is_ending_ || !commands_.empty() || question_ || has_new_view_ || has_new_plane_;
    };
    if (bench.has_backlog()) {
      // Commands first, else a dab of what waits.
    } else if (bench.is_linked()) {
      // The servo never wakes anybody: its ring is looked at every millisecond.
      wake_.wait_for(held, std::chrono::milliseconds(1), has_something);
    } else {
      wake_.wait(held, has_something);
    }
    if (is_ending_) return;
    is_busy_ = true;
    std::optional<Command> command;
    if (!commands_.empty()) {
      command = std::move(commands_.front());
      commands_.pop_front();
      if (auto* piece = std::get_if<ExtendStroke>(&*command)) merge_waiting(*piece, commands_);
    }
    const auto question = std::exchange(question_, std::nullopt);
    const bool has_view = std::exchange(has_new_view_, false);
    const bool has_plane = std::exchange(has_new_plane_, false);
    const auto view = view_;
    const auto plane = plane_;
    held.unlock();

    std::optional<Answer> answer;
    try {
      if (has_view) bench.look(*view);
      if (has_plane) bench.cut(plane);
      if (command) bench.perform(std::move(*command));
      const bool has_worked = bench.step_hand() || (!command && bench.work_backlog());
      if (command || has_view || has_plane || has_worked) bench.show();
      if (question) answer = bench.answer(question->ray, question->touch);
    } catch (const std::bad_alloc&) {
      // The clay is whole; its blocks are sent anew with the next thing that is shown.
      bench.out_of_memory();
    }

    held.lock();
    if (answer) answer_ = answer;
    is_busy_ = false;
    has_backlog_ = bench.has_backlog();
  }
}

void Workshop::send(Command command) {
  {
    const std::lock_guard held(mutex_);
    commands_.push_back(std::move(command));
  }
  wake_.notify_all();
}

void Workshop::look(const DisplayView& view) {
  {
    const std::lock_guard held(mutex_);
    view_ = view;
    has_new_view_ = true;
  }
  wake_.notify_all();
}

void Workshop::ask(const Ray& ray, const std::optional<Touch>& touch) {
  {
    const std::lock_guard held(mutex_);
    question_ = Question{ray, touch};
  }
  wake_.notify_all();
}

std::optional<Workshop::Answer> Workshop::answer() const {
  const std::lock_guard held(mutex_);
  return answer_;
}

void Workshop::cut(const std::optional<SlicePlane>& plane) {
  {
    const std::lock_guard held(mutex_);
    if (plane == plane_) return;
    plane_ = plane;
    has_new_plane_ = true;
  }
  wake_.notify_all();
}

std::optional<SlicePicture> Workshop::take_slice() {
  const std::lock_guard held(mutex_);
  return std::exchange(slice_, std::nullopt);
}

BlockNews Workshop::take_blocks(std::vector<double>& shown_inputs_s) {
  const std::lock_guard held(mutex_);
  shown_inputs_s = std::exchange(shown_inputs_s_, {});
  return std::exchange(news_, {});
}

std::vector<Notice> Workshop::take_notices() {
  const std::lock_guard held(mutex_);
  return std::exchange(notices_, {});
}

ClayState Workshop::state() const {
  const std::lock_guard held(mutex_);
  return state_;
}

std::shared_ptr<const PrintReport> Workshop::report() const {
  const std::lock_guard held(mutex_);
  return report_;
}

Task Workshop::task() const {
  const std::lock_guard held(mutex_);
  return task_;
}

bool Workshop::is_idle() const {
  const std::lock_guard held(mutex_);
  return !is_busy_ && !has_backlog_ && commands_.empty() && !question_ && !has_new_view_ &&
         !has_new_plane_ && news_.empty();
}

}  // namespace argil::viewer
