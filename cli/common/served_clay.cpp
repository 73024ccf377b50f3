// SPDX-License-Identifier: GPL-3.0-or-later
// A clay that is felt and worked: its worker, the scene of the servo, and the thread or the virtual
// time between them.
#include "common/served_clay.h"

#include <cassert>
#include <utility>

namespace argil::cli {
namespace {

haptics::ClaySceneOptions with_heartbeat(haptics::ClaySceneOptions options,
                                         const ClayHeartbeat& heartbeat) {
  options.heartbeat = &heartbeat;
  return options;
}

}  // namespace

ServedClay::ServedClay(Clay& clay, const ClayWorkerOptions& worker,
                       const haptics::ClaySceneOptions& scene,
                       std::function<Result<void>()> after_step)
    : ring_(kClayRingSamples),
      worker_(clay, worker, ring_, channel_),
      scene_(with_heartbeat(scene, heartbeat_), ring_, channel_),
      after_step_(std::move(after_step)) {
  heartbeat_.alive = true;  // while no thread runs, the run itself answers for the clay
}

Result<void> ServedClay::after_tick(double now_s) {
  assert(!thread_);  // which steps by the machine's clock
  if (now_s < next_step_s_) return {};
  next_step_s_ += kClayStepS;
  if (auto stepped = worker_.step(); !stepped) return stepped.error();
  return after_step_ ? after_step_() : Result<void>();
}

Result<void> ServedClay::answer_as(const haptics::WindowStamp& window) {
  assert(!thread_);
  // Only where the recording has a new window: the worker steps just where it did then.
  if (window.answers <= answered_) return {};
  answered_ = window.answers;
  if (auto stepped = worker_.step(window.answers); !stepped) return stepped.error();
  return {};
}

Result<void> ServedClay::start() {
  assert(!thread_);
  auto started = ClayThread::start(worker_, heartbeat_, after_step_);
  if (!started) return started.error();
  thread_ = std::move(started).value();
  return {};
}

Result<void> ServedClay::stop() {
  if (thread_) {
    Result<void> ended = thread_->stop();
    thread_.reset();
    return ended;
  }
  if (auto finished = worker_.finish(); !finished) return finished.error();
  return {};
}

Json ServedClay::report() const {
  Json json;
  json["dabs"] = worker_.counts().dabs;
  json["strokes"] = worker_.counts().strokes;
  json["windows"] = worker_.counts().windows;
  json["dropped_samples"] = scene_.dropped();
  if (const auto texture_n = scene_.most_texture_n()) json["texture_n"] = *texture_n;
  return json;
}

}  // namespace argil::cli
