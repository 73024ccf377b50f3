// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "argil/core/result.h"
#include "argil/core/tool_sample.h"
#include "argil/core/window_channel.h"
#include "argil/engine/clay.h"
#include "argil/engine/window.h"

namespace argil {

struct ClayWorkerOptions {
  Tool tool;               ///< what active samples work with; as validate_tool wants it
  StrokeStyle style = {};  ///< how its samples become dabs

  /// A window is published again when the tool's centre has moved this far since the last one, in
  /// window voxels; 0 or more. Must stay below the margin in the samples' reach_mm, or the servo
  /// runs out of the window. 0: for every sample.
  double drift_voxels = 1.0;

  /// And at the latest for a sample this far in time from the last one answered, in seconds of the
  /// servo's clock, which may go back. Well below the servo's stale limit (0.1 s), or a resting
  /// tool looks stale.
  double refresh_s = 0.03;

  /// Told each finished stroke, between strokes, on the clay's thread: all samples that were
  /// applied, so that Clay::apply of it on the clay before gives the same bits and the same undo
  /// step (ClayWorker.TellsStrokesThatApplyTheSame). Must not throw, nor change the clay; what it
  /// waits for, the hand waits for. A program that loses nothing gives each to io::Session::record,
  /// which does not wait for the disk.
  std::function<void(const Stroke&)> on_stroke = {};

  /// Asked before a stroke is begun, on the clay's thread; false: its samples are felt and not
  /// worked. Must not throw, nor change the clay.
  std::function<bool()> may_begin = {};
};

/// What a worker has done so far; all of it only grows.
struct ClayWorkerCounts {
  std::uint64_t samples = 0;  ///< taken from the ring
  std::uint64_t strokes = 0;  ///< ended, each one undo step
  std::uint64_t dabs = 0;
  std::uint64_t windows = 0;  ///< published
};

/// The clay's side of the servo's loop: turns the samples of the hand into strokes while they are
/// made, and answers with windows.
///
/// A run of active samples is a stroke: begun at the first, ended by the first passive one, which
/// is not part of it. A sample that the ring dropped is a straight piece of the stroke's path; when
/// all passive samples between two strokes were dropped, they are one.
///
/// Threads  the clay's thread only; the servo pushes into the ring and reads the channel meanwhile.
/// Memory   the ring's capacity in samples, from the start; with on_stroke also the open stroke's.
class ClayWorker {
 public:
  static constexpr std::uint64_t kAll = std::numeric_limits<std::uint64_t>::max();

  /// All must outlive the worker, which is the ring's only consumer and the channel's only writer.
  /// The clay may be edited between steps on the same thread, while no stroke is open.
  ClayWorker(Clay& clay, const ClayWorkerOptions& options, ToolSampleRing& ring,
             WindowChannel& channel);

  /// Takes the waiting samples in order up to the index `until` (one ring full at most, so that a
  /// fast producer cannot hold a step up), works the clay with them and publishes at most one
  /// window, for the newest of them: when it is wanted, and always when a replay names the sample.
  /// False when nothing was taken.
  ///
  /// Errors   of begin_stroke, extend_stroke, end_stroke: the samples in hand are not applied, the
  ///          open stroke is ended before them (or was taken back: memory), and active samples that
  ///          follow begin another. Of WindowPublisher::publish: the next step tries again. The
  ///          clay is whole after either and the worker can go on.
  /// Cost     the dabs of the samples, and a window: as Clay::extend_stroke, WindowPublisher.
  Result<bool> step(std::uint64_t until = kAll);

  /// Ends the open stroke as a passive sample would, told to on_stroke; samples that wait in the
  /// ring stay there. False when there was none. Errors as Clay::end_stroke.
  Result<bool> finish();

  /// As of the last step; the clay's thread only, as everything here.
  const ClayWorkerCounts& counts() const noexcept { return counts_; }

 private:
  /// What the last window showed.
  struct Shown {
    WindowRequest request;
    double time_s = 0.0;
    std::uint64_t clay = 0;
    std::uint64_t revision = 0;
  };

  std::optional<ToolSample> take(std::uint64_t until) noexcept;
  Result<void> work();
  Result<void> extend();
  bool wants_window(const ToolSample& newest) const;
  Result<void> answer(const ToolSample& newest);

  Clay& clay_;
  ClayWorkerOptions options_;
  ToolSampleRing& ring_;
  WindowPublisher publisher_;
  ClayWorkerCounts counts_;
  std::optional<ToolSample> held_;   ///< taken from the ring, newer than `until`
  int open_dabs_ = 0;                ///< of the open stroke, counted already
  std::vector<ToolSample> taken_;    ///< by this step
  std::vector<StrokeSample> piece_;  ///< of the open stroke, not applied yet
  Stroke told_;                      ///< the open stroke as far as applied, for on_stroke
  std::optional<Shown> shown_;
};

}  // namespace argil
