// SPDX-License-Identifier: GPL-3.0-or-later
// How a clay changes and is put back: strokes, whole or while they are made, undo and redo.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <new>
#include <sstream>
#include <utility>

#include <time.h>

#include "clay_state.h"
#include "dab.h"
#include "settle.h"

namespace argil {
namespace {

/// 10 MB. Half of it is more than any dab changes.
constexpr std::size_t kMostLoggedChanges = std::size_t{1} << 16;

/// A tool may span at most this many voxels of the coarsest level from its centre: beyond, the clay
/// has no level coarse enough to write it at in bounded time.
constexpr double kLargestToolVoxels = 128.0;

/// Passes until nothing strays; each spreads by one leaf at most, and two or three are usual.
constexpr int kMostRenormalisations = 8;

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

/// Before they are made: a long way of a small tool is more dabs than memory holds.
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

Error no_stroke_is_open() { return {ErrorKind::bad_input, "no stroke is open; begin one first"}; }

/// False when nothing strayed.
bool renormalise_all_strayed(EditTarget& target, const UndoStep& step) {
  int passes = 0;
  while (passes < kMostRenormalisations && renormalise_strayed(target, keys_of(step))) ++passes;
  return passes > 0;
}

std::uint64_t new_identity() {
  static std::atomic<std::uint64_t> next{1};
  return next++;
}

}  // namespace

Error stroke_is_open() {
  return {ErrorKind::bad_input, "a stroke is open; end or cancel it before another"};
}

Clay::State::State(std::unique_ptr<LevelStack> stack, const ClayOptions& clay_options)
    : options(clay_options), levels(std::move(stack)) {
  identity = new_identity();
}

void Clay::State::log_change(const LeafChange& change) {
  if (changes.size() >= kMostLoggedChanges) {
    // The newer half stays: who looks after every dab never misses one.
    constexpr std::size_t kOld = kMostLoggedChanges / 2;
    changes.erase(changes.begin(), changes.begin() + kOld);
    forgotten += kOld;
  }
  changes.push_back(change);
}

void Clay::State::restore(const UndoStep& step) {
  for (const auto& [key, saved] : step) {
    const auto& [level, place] = key;
    LeafChange change{level, place};
    if (const VdbLeaf* leaf = levels->leaf(level, place); leaf != nullptr && saved.values) {
      change = change_of_values(level, place, leaf->buffer().data(), saved.values->data());
    }
    log_change(change);
    if (saved.values) {
      levels->set_leaf(level, place, saved.values->data());
    } else {
      levels->erase_leaf(level, place, saved.tile);
    }
  }
}

UndoStep Clay::State::exchange(const UndoStep& step) {
  UndoStep inverse;
  for (const auto& [key, saved] : step) {
    const auto& [level, place] = key;
    const VdbLeaf* leaf = levels->leaf(level, place);
    inverse.emplace(key, SavedLeaf(leaf != nullptr ? leaf->buffer().data() : nullptr,
                                   levels->grid(level).tree().getValue(place)));
  }
  restore(step);
  return inverse;
}

void Clay::State::restore(const MaskStep& step) {
  if (step.empty()) return;
  Mask& mask = levels->mask_to_change();
  for (const auto& [place, saved] : step) {
    if (saved.values) {
      mask.put(place, *saved.values);
    } else {
      mask.put(place, saved.tile);
    }
  }
  levels->drop_mask_of_nothing();
}

MaskStep Clay::State::exchange(const MaskStep& step) {
  MaskStep inverse;
  const Mask nothing(1.0, 0.0F);
  const Mask& mask = levels->mask() != nullptr ? *levels->mask() : nothing;
  for (const auto& entry : step) {
    const Coord& place = entry.first;
    inverse.emplace(place, SavedLeaf(mask.leaf(place), mask.constant(place)));
  }
  restore(step);
  return inverse;
}

FormerLevels Clay::State::replace_levels(FormerLevels by) {
  FormerLevels former{std::move(levels), options};
  levels = std::move(by.levels);
  options = by.options;
  identity = new_identity();
  forgotten += changes.size() + 1;
  changes.clear();
  return former;
}

UndoEntry Clay::State::swap_back(UndoEntry& entry) {
  if (auto* step = std::get_if<UndoStep>(&entry)) return exchange(*step);
  if (auto* step = std::get_if<MaskStep>(&entry)) return exchange(*step);
  if (auto* former = std::get_if<FormerMask>(&entry)) {
    return FormerMask{levels->exchange_mask(std::move(former->mask))};
  }
  return replace_levels(std::move(std::get<FormerLevels>(entry)));
}

void Clay::State::push_undo(UndoEntry entry) {
  history.push(std::move(entry));
  history.trim(limits.undo_bytes);
}

EditTarget Clay::State::target_into(UndoStep& step) {
  LeafSink sink = [this, &step](const LeafChange& change, const float* values, float tile) {
    log_change(change);
    // The first state within the step counts.
    step.try_emplace({change.level, change.place}, values, tile);
  };
  return {*levels, memory, tolerance_mm(), std::move(sink), free_bytes()};
}

EditTarget Clay::State::target_of_open_stroke() {
  EditTarget target = target_into(open->step);
  target.unsettled = &open->unsettled;
  target.mask_sink = [this](const Coord& place, const float* values, float constant) {
    open->mask_step.try_emplace(place, values, constant);
  };
  return target;
}

void Clay::State::open_stroke(const Tool& tool, const StrokeStyle& style) {
  open.emplace(OpenStroke{tool, DabFeeder(tool, style), {}, {}, {}, {}, {}, {}, {}});
  open->report.level = level_of_tool(*levels, smallest_radius(tool));
}

bool Clay::State::apply_dabs(const std::vector<Dab>& dabs, const Progress& progress) {
  if (dabs.empty()) return true;
  if (is_anchored(open->tool.action)) return apply_anchored(dabs, progress);
  EditTarget target = target_of_open_stroke();
  StrokeReport& report = open->report;
  const std::size_t images = open->feeder.images();
  for (std::size_t first = 0; first < dabs.size(); first += images) {
    const double start = thread_cpu_ms();
    apply_dab(target, open->tool, std::span(dabs).subspan(first, images));
    // A dab's images share its work.
    const double ms = (thread_cpu_ms() - start) / static_cast<double>(images);
    report.dab_cpu_ms.insert(report.dab_cpu_ms.end(), images, ms);
    report.dabs += static_cast<int>(images);
    const double done = static_cast<double>(first + images) / static_cast<double>(dabs.size());
    if (progress && !progress("sculpt", done)) return false;
  }
  return true;
}

/// The levels go back to the stroke's start, and all of the way is applied: what was moved before
/// leaves no trace, so that a stroke in pieces ends as it does in one.
bool Clay::State::apply_anchored(const std::vector<Dab>& dabs, const Progress& progress) {
  if (progress && !progress("sculpt", 0.0)) return false;
  const double start = thread_cpu_ms();
  open->way.insert(open->way.end(), dabs.begin(), dabs.end());
  restore(open->step);
  EditTarget target = target_of_open_stroke();
  apply_way(target, open->tool, open->way, open->feeder.images());
  StrokeReport& report = open->report;
  const double ms = (thread_cpu_ms() - start) / static_cast<double>(dabs.size());
  report.dab_cpu_ms.insert(report.dab_cpu_ms.end(), dabs.size(), ms);
  report.dabs += static_cast<int>(dabs.size());
  return !progress || progress("sculpt", 1.0);
}

void Clay::State::apply_next_dab() {
  std::vector<Dab>& waiting = open->waiting;
  const std::size_t count = is_anchored(open->tool.action) ? waiting.size() : open->feeder.images();
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
  open->feeder.finish(open->waiting);
  apply_waiting_dabs();
  if (open->tool.action == Action::mask) return close_mask_stroke();
  EditTarget target = target_of_open_stroke();
  settle(target, {});
  // Nodes that a drop lays bare may stray, and what is solved anew may no longer be needed.
  tidy(target, keys_of(open->step));
  if (renormalise_all_strayed(target, open->step)) {
    tidy(target, keys_of(open->step));
    renormalise_all_strayed(target, open->step);
  }
  open->report.symmetry = match_images();
  StrokeReport report = std::move(open->report);
  if (report.dabs > 0) push_undo(std::move(open->step));
  open.reset();
  return report;
}

/// The levels are as they were: nothing to drop or to solve.
StrokeReport Clay::State::close_mask_stroke() {
  StrokeReport report = std::move(open->report);
  if (report.dabs > 0) push_undo(std::move(open->mask_step));
  open.reset();
  return report;
}

void Clay::State::take_back() {
  restore(open->images);
  restore(open->step);
  restore(open->mask_step);
  open.reset();
}

Result<void> Clay::begin_stroke(const Tool& tool, const StrokeStyle& style) {
  if (state_->open) return stroke_is_open();
  if (auto ok = validate_brush(tool, style); !ok) return ok;
  if (auto ok = validate_tool_reach(tool, levels()); !ok) return ok;
  state_->open_stroke(tool, style);
  return {};
}

Result<int> Clay::queue_stroke(std::span<const StrokeSample> samples) {
  State& state = *state_;
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
  if (!state_->open) return no_stroke_is_open();
  try {
    return state_->close_stroke();
  } catch (const std::bad_alloc& fault) {
    state_->take_back();
    return out_of_memory(fault, "end the stroke");
  }
}

bool Clay::cancel_stroke() {
  if (!state_->open) return false;
  state_->take_back();
  return true;
}

bool Clay::is_stroke_open() const noexcept { return state_->open.has_value(); }

Result<StrokeReport> Clay::apply(const Stroke& stroke, const Progress& progress) {
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
    for (const StrokeSample& sample : stroke.samples) state_->open->feeder.feed(sample, dabs);
    if (state_->apply_dabs(dabs, progress)) return state_->close_stroke();
    state_->take_back();
    return Error{ErrorKind::interrupted, "interrupted; the stroke was taken back"};
  } catch (const std::bad_alloc& fault) {
    state_->take_back();
    return out_of_memory(fault, "apply the stroke");
  }
}

int Clay::undo_depth() const noexcept { return static_cast<int>(state_->history.undo_depth()); }

bool Clay::undo() {
  History& history = state_->history;
  if (state_->open || !history.has_undo()) return false;
  history.undone(state_->swap_back(history.next_undo()));
  return true;
}

bool Clay::redo() {
  History& history = state_->history;
  if (state_->open || !history.has_redo()) return false;
  history.redone(state_->swap_back(history.next_redo()));
  return true;
}

}  // namespace argil
