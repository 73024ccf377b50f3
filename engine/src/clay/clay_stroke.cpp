// SPDX-License-Identifier: GPL-3.0-or-later
// Strokes, whole or while they are made.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <new>
#include <sstream>
#include <utility>

#include <time.h>

#include "action/dab.h"
#include "brush/dab_plan.h"
#include "clay/clay_state.h"
#include "edit/prune.h"
#include "edit/redistance.h"

namespace argil {
namespace {

/// A tool may span at most this many voxels of the coarsest level from its centre: beyond, the clay
/// has no level coarse enough to write it at in bounded time.
constexpr double kLargestToolVoxels = 128.0;

/// CPU time, so that a report does not depend on what else the machine does.
double thread_cpu_ms() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

/// A smaller tool meets no node but by chance, and its dabs are as many as it is small.
Result<void> validate_tool_detail(const Tool& tool, const LevelStack& stack) {
  constexpr double kLeastVoxels = 0.05;
  const double least = kLeastVoxels * stack.voxel_mm(0);
  const double radius = smallest_radius(tool);
  if (radius >= least) return {};
  std::ostringstream message;
  message << "radius_mm is " << radius << "; for voxels of this size it must be at least " << least;
  return Error{ErrorKind::bad_input, message.str()};
}

Result<void> validate_tool_reach(const Tool& tool, const LevelStack& stack) {
  if (auto ok = validate_tool_detail(tool, stack); !ok) return ok;
  const double radius = largest_radius(tool);
  const double most_radius = kLargestToolVoxels * stack.voxel_mm(stack.top());
  if (radius <= most_radius) return {};
  std::ostringstream message;
  message << "radius_mm is " << radius << "; for a clay of this size it may be at most "
          << most_radius;
  return Error{ErrorKind::bad_input, message.str()};
}

/// The tool must stay within the nodes a level may have, wherever the hand goes.
Result<void> validate_pose_reach(std::span<const StrokeSample> samples, const Tool& tool,
                                 const LevelStack& stack) {
  const double most = (kMaxNode - 64) * stack.voxel_mm(0) - largest_radius(tool);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Vec3& p = samples[i].position_mm;
    const double reach = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    if (reach <= most) continue;
    std::ostringstream message;
    message << "poses[" << i << "]: a coordinate of " << reach
            << " mm is out of reach; with this voxel size at most " << most << " mm";
    return Error{ErrorKind::bad_input, message.str()};
  }
  return {};
}

/// Asked before they are made: a long path of a small tool is more dabs than memory holds.
Result<void> validate_dab_count(std::span<const StrokeSample> samples, const DabFeeder& feeder,
                                std::int64_t free_bytes) {
  const double dabs = feeder.most_dabs(samples);
  const double bytes = dabs * static_cast<double>(sizeof(Dab));
  if (bytes <= static_cast<double>(std::max<std::int64_t>(free_bytes, 0))) return {};
  std::ostringstream message;
  message << "the stroke makes up to " << dabs << " dabs, which take " << bytes / 1048576.0
          << " MB, more than the clay's memory limit leaves; use a larger radius_mm or spacing";
  return Error{ErrorKind::memory, message.str()};
}

/// How many of the dabs are one edit with the first, images included.
std::size_t joined_count(std::span<const Dab> dabs, std::size_t images) {
  std::size_t count = images;
  while (dabs[count - 1].is_joined) count += images;
  assert(count <= dabs.size());
  return count;
}

/// The work of an edit is split evenly among its dabs and their images.
void add_to(StrokeReport& report, std::size_t dabs, double cpu_ms) {
  const double each = cpu_ms / static_cast<double>(dabs);
  report.dab_cpu_ms.insert(report.dab_cpu_ms.end(), dabs, each);
  report.dabs += static_cast<int>(dabs);
}

Error no_stroke_is_open() { return {ErrorKind::bad_input, "no stroke is open; begin one first"}; }

}  // namespace

Error stroke_is_open() {
  return {ErrorKind::bad_input, "a stroke is open; end or cancel it before another"};
}

EditTarget Clay::State::target_of_open_stroke() {
  assert(open);
  EditTarget target = target_into(open->step);
  target.redistance_queue = &open->redistance_queue;
  target.stroke_step = &open->step;
  target.mask_sink = [this](const Coord& origin, const float* values, float constant) {
    open->mask_step.try_emplace(origin, values, constant);
  };
  return target;
}

void Clay::State::open_stroke(const Tool& tool, const StrokeStyle& style) {
  assert(!open);
  open.emplace(OpenStroke{tool, DabFeeder(tool, style), {}, {}, {}, {}, {}, false, {}, {}});
  open->report.level = level_of_tool(*levels, smallest_radius(tool));
}

bool Clay::State::apply_dabs(const std::vector<Dab>& dabs, const Progress& progress) {
  assert(open && dabs.size() % open->feeder.images() == 0);
  if (dabs.empty()) return true;
  if (is_anchored(open->tool.action)) {
    extend_path(dabs);
    return true;
  }
  EditTarget target = target_of_open_stroke();
  const std::size_t images = open->feeder.images();
  for (std::size_t first = 0; first < dabs.size();) {
    const std::size_t count = joined_count(std::span(dabs).subspan(first), images);
    const double start = thread_cpu_ms();
    apply_dab(target, open->tool, std::span(dabs).subspan(first, count), images);
    add_to(open->report, count, thread_cpu_ms() - start);
    first += count;
    const double done = static_cast<double>(first) / static_cast<double>(dabs.size());
    if (progress && !progress("sculpt", done)) return false;
  }
  return true;
}

/// The levels go back to the stroke's start, and the whole path is applied: what was moved before
/// leaves no trace, so that a stroke in pieces ends as it does in one.
void Clay::State::apply_path_anew() {
  assert(open);
  restore(open->step);
  open->step.clear();  // as if nothing had been touched
  open->redistance_queue = {};
  open->is_carried = false;
  EditTarget target = target_of_open_stroke();
  if (can_be_carried(open->tool.action)) target.redistance_queue = nullptr;  // solved at once
  apply_path(target, open->tool, open->path, open->feeder.images());
}

bool Clay::State::apply_whole_path(const std::vector<Dab>& dabs, const Progress& progress) {
  assert(open && open->path.empty() && is_anchored(open->tool.action));
  if (dabs.empty()) return true;
  if (progress && !progress("sculpt", 0.0)) return false;
  const double start = thread_cpu_ms();
  open->path = dabs;
  apply_path_anew();
  add_to(open->report, dabs.size(), thread_cpu_ms() - start);
  return !progress || progress("sculpt", 1.0);
}

/// What can be carried along is, from where the last piece left it, until the stroke ends: the
/// whole path would take longer with every piece.
void Clay::State::extend_path(const std::vector<Dab>& dabs) {
  const double start = thread_cpu_ms();
  open->path.insert(open->path.end(), dabs.begin(), dabs.end());
  if (can_be_carried(open->tool.action)) {
    open->is_carried = true;
    EditTarget target = target_of_open_stroke();
    apply_path(target, open->tool, dabs, open->feeder.images());
  } else {
    apply_path_anew();
  }
  add_to(open->report, dabs.size(), thread_cpu_ms() - start);
}

void Clay::State::finish_path() {
  const std::vector<Dab> dabs = std::exchange(open->waiting, {});
  if (dabs.empty() && !open->is_carried) return;
  const double start = thread_cpu_ms();
  open->path.insert(open->path.end(), dabs.begin(), dabs.end());
  apply_path_anew();
  if (!dabs.empty()) add_to(open->report, dabs.size(), thread_cpu_ms() - start);
}

void Clay::State::apply_next_dab() {
  assert(open && !open->waiting.empty());
  std::vector<Dab>& waiting = open->waiting;
  const std::size_t count = is_anchored(open->tool.action)
                                ? waiting.size()
                                : joined_count(waiting, open->feeder.images());
  const auto rest = waiting.begin() + static_cast<std::ptrdiff_t>(count);
  const std::vector<Dab> next(waiting.begin(), rest);
  waiting.erase(waiting.begin(), rest);
  apply_dabs(next, {});
}

void Clay::State::apply_waiting_dabs() {
  const std::vector<Dab> dabs = std::exchange(open->waiting, {});
  apply_dabs(dabs, {});
}

StrokeReport Clay::State::close_stroke() {
  assert(open);
  open->feeder.finish(open->waiting);
  if (can_be_carried(open->tool.action)) {
    finish_path();
  } else {
    apply_waiting_dabs();
  }
  if (is_painted(open->tool.action)) return close_mask_stroke();
  EditTarget target = target_of_open_stroke();
  flush_queue(target, {});
  prune(target, keys_of(open->step));
  // Nodes that pruning lays bare may be out of bounds, and what is redistanced may not be needed.
  const LeafList solved = redistance_touched(target, keys_of(open->step));
  if (!solved.empty()) {
    LeafList pruned;
    EditTarget noted = noting(target, pruned);
    prune(noted, solved);
    redistance_touched(target, std::move(pruned));
  }
  open->report.symmetry = match_images();
  history.make_room();
  StrokeReport report = std::move(open->report);
  if (report.dabs > 0) push_undo(std::move(open->step));
  open.reset();
  return report;
}

/// The levels are as they were: nothing to drop or to solve.
StrokeReport Clay::State::close_mask_stroke() {
  history.make_room();
  StrokeReport report = std::move(open->report);
  if (report.dabs > 0) push_undo(std::move(open->mask_step));
  open.reset();
  return report;
}

void Clay::State::take_back() {
  assert(open);
  restore(open->images);
  restore(open->step);
  restore(open->mask_step);
  open.reset();
}

Result<void> Clay::begin_stroke(const Tool& tool, const StrokeStyle& style) {
  const ChangingCall call(state_->user);
  if (state_->open) return stroke_is_open();
  if (auto ok = validate_brush(tool, style); !ok) return ok;
  if (auto ok = validate_tool_reach(tool, levels()); !ok) return ok;
  state_->open_stroke(tool, style);
  return {};
}

Result<int> Clay::queue_stroke(std::span<const StrokeSample> samples) {
  State& state = *state_;
  const ChangingCall call(state.user);
  if (!state.open) return no_stroke_is_open();
  if (auto ok = validate_samples(samples); !ok) return ok.error();
  if (auto ok = validate_pose_reach(samples, state.open->tool, levels()); !ok) return ok.error();
  const auto& last = state.open->feeder.last();
  if (last && !samples.empty() && samples[0].time_s < last->time_s) {
    return Error{ErrorKind::bad_input,
                 "poses[0]: time runs backwards since the last piece of the stroke"};
  }
  if (auto ok = validate_dab_count(samples, state.open->feeder, state.free_bytes()); !ok) {
    return ok.error();
  }
  try {
    for (const StrokeSample& sample : samples) state.open->feeder.feed(sample, state.open->waiting);
    return waiting_dabs();
  } catch (const std::bad_alloc& fault) {
    state.take_back();
    return out_of_memory(fault, "apply the stroke");
  }
}

Result<int> Clay::extend_stroke(std::span<const StrokeSample> samples) {
  const ChangingCall call(state_->user);
  const Result<int> queued = queue_stroke(samples);
  if (!queued) return queued;
  try {
    state_->apply_waiting_dabs();
    return queued;
  } catch (const std::bad_alloc& fault) {
    state_->take_back();
    return out_of_memory(fault, "apply the stroke");
  }
}

Result<bool> Clay::work_stroke() {
  const ChangingCall call(state_->user);
  if (!state_->open) return no_stroke_is_open();
  if (state_->open->waiting.empty()) return false;
  try {
    state_->apply_next_dab();
    return true;
  } catch (const std::bad_alloc& fault) {
    state_->take_back();
    return out_of_memory(fault, "apply the stroke");
  }
}

int Clay::waiting_dabs() const noexcept {
  return state_->open ? static_cast<int>(state_->open->waiting.size()) : 0;
}

Result<StrokeReport> Clay::end_stroke() {
  const ChangingCall call(state_->user);
  if (!state_->open) return no_stroke_is_open();
  try {
    return state_->close_stroke();
  } catch (const std::bad_alloc& fault) {
    state_->take_back();
    return out_of_memory(fault, "end the stroke");
  }
}

bool Clay::cancel_stroke() {
  const ChangingCall call(state_->user);
  if (!state_->open) return false;
  state_->take_back();
  return true;
}

bool Clay::is_stroke_open() const noexcept { return state_->open.has_value(); }

Result<StrokeReport> Clay::apply(const Stroke& stroke, const Progress& progress) {
  const ChangingCall call(state_->user);
  if (state_->open) return stroke_is_open();
  if (auto ok = validate_stroke(stroke); !ok) return ok.error();
  if (auto ok = validate_tool_reach(stroke.tool, levels()); !ok) return ok.error();
  if (auto ok = validate_pose_reach(stroke.samples, stroke.tool, levels()); !ok) return ok.error();
  if (auto ok =
          validate_dab_count(stroke.samples, DabFeeder(stroke.tool, stroke), state_->free_bytes());
      !ok) {
    return ok.error();
  }
  state_->open_stroke(stroke.tool, stroke);
  try {
    std::vector<Dab> dabs;
    DabFeeder& feeder = state_->open->feeder;
    for (const StrokeSample& sample : stroke.samples) feeder.feed(sample, dabs);
    const bool is_path = is_anchored(stroke.tool.action);
    if (is_path) feeder.finish(dabs);
    const bool is_done =
        is_path ? state_->apply_whole_path(dabs, progress) : state_->apply_dabs(dabs, progress);
    if (is_done) return state_->close_stroke();
    state_->take_back();
    return Error{ErrorKind::interrupted, "interrupted; the stroke was taken back"};
  } catch (const std::bad_alloc& fault) {
    state_->take_back();
    return out_of_memory(fault, "apply the stroke");
  }
}

}  // namespace argil
