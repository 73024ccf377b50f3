// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/document_thread.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <new>
#include <utility>

#include "document/document_worker.h"

namespace argil::viewer {
namespace {

/// How soon a window that shows a new clay says from where it looks at it: a frame or two.
constexpr std::chrono::milliseconds kViewSoon(100);

/// Joins pieces of one stroke that wait: the hand was faster than the clay, and one long piece
/// costs less than many short ones, whose surfaces would each be built and sent.
void merge_waiting(ExtendStroke& piece, std::deque<Request>& requests) {
  while (!requests.empty()) {
    auto* next = std::get_if<ExtendStroke>(&requests.front());
    if (next == nullptr) return;
    piece.samples.insert(piece.samples.end(), next->samples.begin(), next->samples.end());
    requests.pop_front();
  }
}

}  // namespace

DocumentThread::DocumentThread(DocumentThreadOptions options)
    : options_(std::move(options)), outbox_(options_.on_news), thread_([this] { run(); }) {}

DocumentThread::~DocumentThread() {
  {
    const std::lock_guard lock(mutex_);
    is_ending_ = true;
    outbox_.stop_all();
  }
  wake_.notify_all();
  thread_.join();
}

void DocumentThread::run() {
  DocumentWorker worker(outbox_, options_.home, options_.places);
  std::unique_lock lock(mutex_);
  for (;;) {
    const auto has_something = [this] {
      return is_ending_ || !requests_.empty() || question_ || has_new_view_ || has_new_plane_ ||
             !measures_.empty();
    };
    if (worker.waits_for_view()) {
      wake_.wait_for(lock, kViewSoon, has_something);
    } else if (worker.has_backlog()) {
      // Commands first, else a dab of what waits.
    } else if (worker.is_linked()) {
      // The servo never wakes anybody: its ring is looked at every millisecond.
      wake_.wait_for(lock, std::chrono::milliseconds(1), has_something);
    } else {
      wake_.wait(lock, has_something);
    }
    if (is_ending_) return;
    // Everything that was asked for is taken under the lock and done without it, so that the window
    // never waits for the clay.
    is_busy_ = true;
    std::optional<Request> request;
    if (!requests_.empty()) {
      request = std::move(requests_.front());
      requests_.pop_front();
      if (auto* piece = std::get_if<ExtendStroke>(&*request)) merge_waiting(*piece, requests_);
    }
    // Of questions, views and planes only the newest counts: older ones were overwritten.
    const auto question = std::exchange(question_, std::nullopt);
    const bool has_view = std::exchange(has_new_view_, false);
    const bool has_plane = std::exchange(has_new_plane_, false);
    const auto view = view_;
    const auto plane = plane_;
    // Of the clay as it will be once all of that is done.
    const bool may_measure = requests_.empty() && !worker.has_backlog();
    const auto measures =
        may_measure ? std::exchange(measures_, {}) : std::vector<MeasureQuestion>();
    lock.unlock();

    std::optional<PointerAnswer> answer;
    std::vector<MeasureAnswer> measured;
    bool has_something_new = request || question || has_view || has_plane || !measures.empty();
    try {
      if (has_view) worker.look(*view);
      if (has_plane) worker.cut(plane);
      if (request) worker.perform(std::move(*request));
      const bool has_worked = worker.step_hand() || (!request && worker.work_backlog());
      if (request || has_view || has_plane || has_worked) worker.show();
      has_something_new = has_something_new || has_worked;
      if (question) answer = worker.answer(question->ray, question->touch);
      for (const MeasureQuestion& each : measures) measured.push_back(worker.measure(each));
    } catch (const std::bad_alloc&) {
      // The clay is whole; its blocks are sent again with the next thing that is shown.
      worker.out_of_memory();
    }

    // Whoever asked what there was no memory for is told that nothing was met.
    for (std::size_t n = measured.size(); n < measures.size(); ++n) {
      measured.emplace_back().number = measures[n].number;
    }
    lock.lock();
    if (answer) answer_ = answer;
    measured_.insert(measured_.end(), measured.begin(), measured.end());
    is_busy_ = false;
    has_backlog_ = worker.has_backlog();
    // Last: whoever wakes finds the thread idle if it is.
    if (has_something_new) outbox_.announce();
  }
}

void DocumentThread::send(Request request) {
  if (const auto* look = std::get_if<LookAtMesh>(&request)) outbox_.want_look(look->number);
  {
    const std::lock_guard lock(mutex_);
    requests_.push_back(std::move(request));
  }
  wake_.notify_all();
}

void DocumentThread::look(const DisplayView& view) {
  {
    const std::lock_guard lock(mutex_);
    view_ = view;
    has_new_view_ = true;
  }
  wake_.notify_all();
}

void DocumentThread::ask(const Ray& ray, const std::optional<Touch>& touch) {
  {
    const std::lock_guard lock(mutex_);
    question_ = Question{ray, touch};
  }
  wake_.notify_all();
}

std::optional<PointerAnswer> DocumentThread::answer() const {
  const std::lock_guard lock(mutex_);
  return answer_;
}

void DocumentThread::measure(const MeasureQuestion& question) {
  {
    const std::lock_guard lock(mutex_);
    const auto same =
        std::find_if(measures_.begin(), measures_.end(),
                     [&](const MeasureQuestion& each) { return each.number == question.number; });
    if (same == measures_.end()) {
      measures_.push_back(question);
    } else {
      *same = question;
    }
  }
  wake_.notify_all();
}

std::vector<MeasureAnswer> DocumentThread::take_measured() {
  const std::lock_guard lock(mutex_);
  return std::exchange(measured_, {});
}

void DocumentThread::cut(const std::optional<SlicePlane>& plane) {
  {
    const std::lock_guard lock(mutex_);
    assert(!plane || (plane->columns > 1 && plane->rows > 1));
    if (plane == plane_) return;
    plane_ = plane;
    has_new_plane_ = true;
  }
  wake_.notify_all();
}

bool DocumentThread::is_idle() const {
  const std::lock_guard lock(mutex_);
  return !is_busy_ && !has_backlog_ && requests_.empty() && !question_ && !has_new_view_ &&
         !has_new_plane_ && measures_.empty() && measured_.empty() && !outbox_.has_blocks();
}

}  // namespace argil::viewer
