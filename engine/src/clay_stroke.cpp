// SPDX-License-Identifier: GPL-3.0-or-later
// How a clay changes and is put back: strokes, whole or while they are made, undo and redo.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <new>
#include <sstream>

#include <time.h>

#include "clay_state.h"

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

Result<void> validate_tool_reach(const Tool& tool, const LevelStack& stack) {
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

Error stroke_is_open() {
  return {ErrorKind::bad_input, "a stroke is open; end or cancel it before another"};
}

Error no_stroke_is_open() { return {ErrorKind::bad_input, "no stroke is open; begin one first"}; }

std::vector<std::pair<int, Coord>> keys_of(const UndoStep& step) {
  std::vector<std::pair<int, Coord>> keys;
  keys.reserve(step.size());
  for (const auto& entry : step) keys.push_back(entry.first);
  return keys;
}

std::int64_t bytes_of(const UndoStep& step) {
  constexpr std::size_t kNode = sizeof(UndoStep::value_type) + 4 * sizeof(void*);
  return static_cast<std::int64_t>(step.size() * (kNode + sizeof(LeafValues)));
}

}  // namespace

Error out_of_memory(const char* what) {
  return {ErrorKind::memory,
          std::string("not enough memory to ") + what + "; use a larger voxel or a smaller tool"};
}

Clay::State::State(std::unique_ptr<LevelStack> stack, const ClayOptions& clay_options)
    : options(clay_options), levels(std::move(stack)) {
  static std::atomic<std::uint64_t> next{1};
  identity = next++;
}

SavedLeaf::SavedLeaf(const float* at, float constant) : tile(constant) {
  if (at == nullptr) return;
  values = std::make_unique<LeafValues>();
  std::copy_n(at, kLeafNodes, values->begin());
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

void Clay::State::trim_undo() {
  std::int64_t bytes = 0;
  for (const UndoStep& step : redo) bytes += bytes_of(step);
  for (std::size_t newer = 1; newer <= undo.size(); ++newer) {
    bytes += bytes_of(undo[undo.size() - newer]);
    if (bytes <= undo_limit || newer == 1) continue;
    undo.erase(undo.begin(), undo.end() - static_cast<std::ptrdiff_t>(newer - 1));
    return;
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

EditTarget Clay::State::target_of_open_stroke() {
  LeafSink sink = [this](const LeafChange& change, const float* values, float tile) {
    log_change(change);
    // The first state within the stroke counts.
    open->step.try_emplace({change.level, change.place}, values, tile);
  };
  return {*levels, memory, tolerance_mm(), std::move(sink)};
}

void Clay::State::open_stroke(const Tool& tool, double spacing, const Mirror& mirror) {
  open.emplace(OpenStroke{tool, spacing, DabFeeder(tool, spacing, mirror), {}, {}});
  open->report.level = level_of_tool(*levels, smallest_radius(tool));
}

bool Clay::State::apply_dabs(const std::vector<DabPose>& dabs, const Progress& progress) {
  EditTarget target = target_of_open_stroke();
  StrokeReport& report = open->report;
  double done = 0.0;
  for (const DabPose& pose : dabs) {
    const double start = thread_cpu_ms();
    apply_dab(target, PosedTool(open->tool, pose), open->spacing);
    report.dab_cpu_ms.push_back(thread_cpu_ms() - start);
    ++report.dabs;
    done += 1.0;
    if (progress && !progress("sculpt", done / static_cast<double>(dabs.size()))) return false;
  }
  return true;
}

StrokeReport Clay::State::close_stroke() {
  EditTarget target = target_of_open_stroke();
  for (int pass = 0; pass < kMostRenormalisations; ++pass) {
    if (!renormalise_strayed(target, keys_of(open->step))) break;
  }
  tidy(target, keys_of(open->step));
  StrokeReport report = std::move(open->report);
  if (report.dabs > 0) {
    undo.push_back(std::move(open->step));
    redo.clear();
    trim_undo();
  }
  open.reset();
  return report;
}

void Clay::State::take_back() {
  restore(open->step);
  open.reset();
}

Result<void> Clay::begin_stroke(const Tool& tool, double spacing, const Mirror& mirror) {
  if (state_->open) return stroke_is_open();
  if (auto ok = validate_brush(tool, spacing); !ok) return ok;
  if (auto ok = validate_tool_reach(tool, levels()); !ok) return ok;
  state_->open_stroke(tool, spacing, mirror);
  return {};
}

Result<int> Clay::extend_stroke(std::span<const StrokeSample> samples) {
  State& state = *state_;
  if (!state.open) return no_stroke_is_open();
  if (auto ok = validate_samples(samples); !ok) return ok.error();
  if (auto ok = validate_pose_reach(samples, state.open->tool, levels()); !ok) return ok.error();
  const auto& last = state.open->feeder.last();
  if (last && !samples.empty() && samples[0].time_s < last->time_s) {
    return Error{ErrorKind::bad_input,
                 "poses[0]: time runs backwards since the last piece of the stroke"};
  }
  try {
    std::vector<DabPose> dabs;
    for (const StrokeSample& sample : samples) state.open->feeder.feed(sample, dabs);
    state.apply_dabs(dabs, {});
    return static_cast<int>(dabs.size());
  } catch (const std::bad_alloc&) {
    state.take_back();
    return out_of_memory("apply the stroke");
  }
}

Result<StrokeReport> Clay::end_stroke() {
  if (!state_->open) return no_stroke_is_open();
  try {
    return state_->close_stroke();
  } catch (const std::bad_alloc&) {
    state_->take_back();
    return out_of_memory("end the stroke");
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
  state_->open_stroke(stroke.tool, stroke.spacing, stroke.mirror);
  try {
    if (state_->apply_dabs(dabs_of(stroke), progress)) return state_->close_stroke();
    state_->take_back();
    return Error{ErrorKind::interrupted, "interrupted; the stroke was taken back"};
  } catch (const std::bad_alloc&) {
    state_->take_back();
    return out_of_memory("apply the stroke");
  }
}

int Clay::undo_depth() const noexcept { return static_cast<int>(state_->undo.size()); }

void Clay::limit_undo(std::int64_t bytes) {
  state_->undo_limit = bytes;
  state_->trim_undo();
}

bool Clay::undo() {
  if (state_->open || state_->undo.empty()) return false;
  state_->redo.push_back(state_->exchange(state_->undo.back()));
  state_->undo.pop_back();
  return true;
}

bool Clay::redo() {
  if (state_->open || state_->redo.empty()) return false;
  state_->undo.push_back(state_->exchange(state_->redo.back()));
  state_->redo.pop_back();
  return true;
}

}  // namespace argil
