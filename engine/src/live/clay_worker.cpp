// SPDX-License-Identifier: GPL-3.0-or-later
// Samples come in, dabs and windows go out. All samples that wait are taken at once, so that a slow
// dab is followed by one window and not by one for each sample.
#include "argil/engine/clay_worker.h"

#include <cassert>
#include <cmath>
#include <utility>

#include "clay/clay_access.h"

namespace argil {
namespace {

WindowRequest request_of(const ToolSample& sample) noexcept {
  return {sample.position_mm, sample.voxel_mm, sample.reach_mm, sample.depth_mm,
          sample.wants_detail};
}

}  // namespace

ClayWorker::ClayWorker(Clay& clay, const ClayWorkerOptions& options, ToolSampleRing& ring,
                       WindowChannel& channel)
    : clay_(clay), options_(options), ring_(ring), publisher_(channel) {
  taken_.reserve(ring.capacity());
  piece_.reserve(ring.capacity());
  static_cast<StrokeStyle&>(told_) = options_.style;
  told_.tool = options_.tool;
}

std::optional<ToolSample> ClayWorker::take(std::uint64_t until) noexcept {
  ToolSample sample;
  if (!held_ && ring_.pop(sample)) held_ = sample;
  if (!held_ || held_->index > until) return std::nullopt;
  sample = *held_;
  held_.reset();
  return sample;
}

Result<bool> ClayWorker::step(std::uint64_t until) {
  assert(taken_.capacity() >= ring_.capacity());
  taken_.clear();
  while (taken_.size() < ring_.capacity()) {
    const std::optional<ToolSample> sample = take(until);
    if (!sample) break;
    taken_.push_back(*sample);
  }
  if (taken_.empty()) return false;
  counts_.samples += taken_.size();
  const Result<void> worked = work();
  // The hand feels what there is, whether the work failed or not. Who names a sample wants its
  // window.
  const Result<void> answered =
      until != kAll || wants_window(taken_.back()) ? answer(taken_.back()) : Result<void>();
  if (!worked) return worked.error();
  if (!answered) return answered.error();
  return true;
}

/// All of what was taken; of several errors the first is reported.
Result<void> ClayWorker::work() {
  Result<void> first;
  const auto note = [&first](const Result<void>& done) {
    if (first && !done) first = done;
  };
  piece_.clear();
  for (const ToolSample& sample : taken_) {
    if (sample.is_active) {
      piece_.push_back({sample.time_s, sample.position_mm, sample.orientation, sample.pressure});
      continue;
    }
    note(extend());
    if (auto done = finish(); !done) note(done.error());
  }
  note(extend());
  return first;
}

/// Gives the open stroke, or a new one, the piece in hand.
Result<void> ClayWorker::extend() {
  if (piece_.empty()) return {};
  if (!clay_.is_stroke_open()) {
    if (options_.may_begin && !options_.may_begin()) {
      piece_.clear();
      return {};
    }
    auto begun = clay_.begin_stroke(options_.tool, options_.style);
    if (!begun) {
      piece_.clear();
      return begun;
    }
    told_.samples.clear();
  }
  const Result<int> dabs = clay_.extend_stroke(piece_);
  if (dabs && options_.on_stroke) {
    told_.samples.insert(told_.samples.end(), piece_.begin(), piece_.end());
  }
  piece_.clear();
  if (dabs) {
    counts_.dabs += static_cast<std::uint64_t>(dabs.value());
    open_dabs_ += dabs.value();
    return {};
  }
  // What was applied of the stroke stays, unless it was taken back; the error that is reported is
  // the one that came first.
  [[maybe_unused]] const Result<bool> ended = finish();
  return dabs.error();
}

Result<bool> ClayWorker::finish() {
  if (!clay_.is_stroke_open()) return false;
  const Result<StrokeReport> report = clay_.end_stroke();
  const int counted = std::exchange(open_dabs_, 0);
  if (!report) return report.error();
  counts_.dabs += static_cast<std::uint64_t>(report.value().dabs - counted);
  if (report.value().dabs > 0) {
    ++counts_.strokes;
    if (options_.on_stroke) options_.on_stroke(told_);
  }
  return true;
}

bool ClayWorker::wants_window(const ToolSample& newest) const {
  if (!shown_) return true;
  if (shown_->clay != identity(clay_) || shown_->revision != revision(clay_)) return true;
  const WindowRequest wanted = request_of(newest);
  const WindowRequest& has = shown_->request;
  if (wanted.voxel_mm != has.voxel_mm || wanted.reach_mm != has.reach_mm ||
      wanted.depth_mm != has.depth_mm || wanted.wants_detail != has.wants_detail) {
    return true;
  }
  const double drift_mm = length(wanted.center_mm - has.center_mm);
  // Not "greater": a position or time that is NaN must reach the publisher, which says so.
  return !(drift_mm < options_.drift_voxels * wanted.voxel_mm) ||
         !(std::abs(newest.time_s - shown_->time_s) < options_.refresh_s);
}

Result<void> ClayWorker::answer(const ToolSample& newest) {
  const WindowRequest request = request_of(newest);
  if (auto done = publisher_.publish(clay_, request, {newest.index, newest.time_s}); !done) {
    shown_.reset();  // the next sample tries again
    return done;
  }
  shown_ = Shown{request, newest.time_s, identity(clay_), revision(clay_)};
  ++counts_.windows;
  return {};
}

}  // namespace argil
