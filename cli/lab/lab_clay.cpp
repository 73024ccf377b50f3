// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/lab_clay.h"

#include <utility>

#include "argil/engine/surface.h"

#include "output.h"

namespace argil::cli::lab {
namespace {

constexpr std::size_t kRingSamples = 1024;
/// How often the clay answers on virtual time: what its thread reaches with a tool of some mm.
constexpr double kStepS = 0.010;

haptics::ClaySceneOptions with_pulse(haptics::ClaySceneOptions options, const ClayPulse& pulse) {
  options.pulse = &pulse;
  return options;
}

}  // namespace

LabClay::LabClay(Clay clay, const ClayWorkerOptions& worker, const haptics::ClaySceneOptions& scene)
    : clay_(std::move(clay)),
      volume_before_mm3_(signed_volume(extract_surface(clay_))),
      ring_(kRingSamples),
      worker_(clay_, worker, ring_, channel_),
      scene_(with_pulse(scene, pulse_), ring_, channel_) {
  pulse_.alive = true;  // while no thread runs, the run itself answers for the clay
}

Result<void> LabClay::after_tick(double now_s) {
  if (now_s < next_step_s_) return {};
  next_step_s_ += kStepS;
  if (auto stepped = worker_.step(); !stepped) return stepped.error();
  return {};
}

Result<void> LabClay::answer_as(const haptics::WindowStamp& window) {
  if (window.answers <= answered_) return {};
  answered_ = window.answers;
  if (auto stepped = worker_.step(window.answers); !stepped) return stepped.error();
  return {};
}

Result<void> LabClay::start() {
  auto started = ClayThread::start(worker_, pulse_);
  if (!started) return started.error();
  thread_ = std::move(started).value();
  return {};
}

Result<void> LabClay::stop() {
  if (thread_) {
    Result<void> ended = thread_->stop();
    thread_.reset();
    return ended;
  }
  if (auto finished = worker_.finish(); !finished) return finished.error();
  return {};
}

Json LabClay::report() const {
  Json json;
  json["dabs"] = worker_.counts().dabs;
  json["strokes"] = worker_.counts().strokes;
  json["windows"] = worker_.counts().windows;
  json["dropped_samples"] = scene_.dropped();
  json["carved_mm3"] = volume_before_mm3_ - signed_volume(extract_surface(clay_));
  json["hash"] = hex(clay_.hash());
  return json;
}

}  // namespace argil::cli::lab
