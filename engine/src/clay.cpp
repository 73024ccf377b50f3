// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/engine/clay.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <new>
#include <sstream>

#include <tbb/parallel_for.h>
#include <time.h>

#include "argil/core/hash.h"

#include "brush.h"
#include "clay_changes.h"
#include "coarsen.h"
#include "edit.h"
#include "level_stack.h"

namespace argil {
namespace {

constexpr std::size_t kMostLoggedChanges = std::size_t{1} << 20;

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

template <class T>
std::span<const std::byte> bytes_of(const T* data, std::size_t count) {
  return std::as_bytes(std::span(data, count));
}

std::uint64_t hash_leaf(const VdbLeaf& leaf) {
  Hash64 hash;
  const std::array<std::int32_t, 3> origin{leaf.origin().x(), leaf.origin().y(), leaf.origin().z()};
  hash.update(bytes_of(origin.data(), origin.size()));
  hash.update(bytes_of(leaf.buffer().data(), kLeafNodes));
  for (openvdb::Index word = 0; word < VdbLeaf::NodeMaskType::WORD_COUNT; ++word) {
    const auto bits = leaf.getValueMask().getWord<openvdb::Index64>(word);
    hash.update(bytes_of(&bits, 1));
  }
  return hash.digest();
}

Result<void> validate_options(const ClayOptions& options) {
  std::ostringstream message;
  if (!std::isfinite(options.voxel_mm) || options.voxel_mm <= 0.0) {
    message << "voxel_mm is " << options.voxel_mm << "; must be a finite number greater than 0";
  } else if (!(options.tolerance_voxels >= 0.01 && options.tolerance_voxels <= 0.5)) {
    message << "tolerance_voxels is " << options.tolerance_voxels << "; must be from 0.01 to 0.5";
  } else {
    return {};
  }
  return Error{ErrorKind::bad_input, message.str()};
}

Result<void> validate_size(double size_mm, const ClayOptions& options, const char* name) {
  const double most = kMaxNode * options.voxel_mm;
  if (std::isfinite(size_mm) && size_mm >= 8.0 * options.voxel_mm && size_mm <= most) return {};
  std::ostringstream message;
  message << name << " is " << size_mm << " mm; with a voxel of " << options.voxel_mm
          << " mm it must be from " << 8.0 * options.voxel_mm << " to " << most << " mm";
  return Error{ErrorKind::bad_input, message.str()};
}

Result<void> validate_bounds(const Box3& bounds_mm, const ClayOptions& options) {
  const double least = 8.0 * options.voxel_mm;
  const double most = kMaxNode * options.voxel_mm;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double low = bounds_mm.min[axis];
    const double high = bounds_mm.max[axis];
    if (high - low >= least && low >= -most && high <= most) continue;  // false for NaN
    std::ostringstream message;
    message << "bounds_mm reaches from " << low << " to " << high << " mm along axis " << axis
            << "; with a voxel of " << options.voxel_mm << " mm it must be at least " << least
            << " mm wide and stay within " << most << " mm of the origin";
    return Error{ErrorKind::bad_input, message.str()};
  }
  return {};
}

Error out_of_memory(const char* what) {
  return {ErrorKind::memory,
          std::string("not enough memory to ") + what + "; use a larger voxel or a smaller tool"};
}

}  // namespace

/// One undo step: every leaf the stroke touched, as it was before.
using UndoStep = std::map<std::pair<int, Coord>, SavedLeaf>;

struct Clay::State {
  State(std::unique_ptr<LevelStack> stack, const ClayOptions& clay_options)
      : options(clay_options), levels(std::move(stack)) {
    static std::atomic<std::uint64_t> next{1};
    identity = next++;
  }

  double tolerance_mm() const { return options.tolerance_voxels * options.voxel_mm; }

  void log_change(int level, const Coord& place) {
    if (changes.size() >= kMostLoggedChanges) {
      forgotten += changes.size();
      changes.clear();
    }
    changes.push_back({level, place});
  }

  /// Puts the leaves of a step back and returns the step that undoes that.
  UndoStep exchange(const UndoStep& step) {
    UndoStep inverse;
    for (const auto& [key, saved] : step) {
      const auto& [level, place] = key;
      SavedLeaf now{level, place, levels->grid(level).tree().getValue(place), nullptr};
      if (const VdbLeaf* leaf = levels->leaf(level, place)) {
        now.values = std::make_unique<LeafValues>();
        std::copy_n(leaf->buffer().data(), kLeafNodes, now.values->begin());
      }
      inverse.emplace(key, std::move(now));
    }
    for (const auto& [key, saved] : step) {
      if (saved.values) {
        levels->set_leaf(saved.level, saved.place, saved.values->data());
      } else {
        levels->erase_leaf(saved.level, saved.place, saved.tile);
      }
      log_change(saved.level, saved.place);
    }
    return inverse;
  }

  ClayOptions options;
  std::unique_ptr<LevelStack> levels;
  std::vector<UndoStep> undo;
  std::vector<UndoStep> redo;
  std::uint64_t identity = 0;
  std::uint64_t forgotten = 0;  ///< changes no longer in the log
  std::vector<LeafChange> changes;
};

Clay::Clay(std::unique_ptr<State> state) : state_(std::move(state)) {}
Clay::Clay(Clay&&) noexcept = default;
Clay& Clay::operator=(Clay&&) noexcept = default;
Clay::~Clay() = default;

Clay Clay::from_levels(std::unique_ptr<LevelStack> levels, const ClayOptions& options) {
  return Clay(std::make_unique<State>(std::move(levels), options));
}

Result<Clay> Clay::ball(double radius_mm, const ClayOptions& options) {
  if (auto ok = validate_options(options); !ok) return ok.error();
  if (auto ok = validate_size(radius_mm, options, "radius_mm"); !ok) return ok.error();
  Box3 box;
  box.include(Vec3{-radius_mm, -radius_mm, -radius_mm});
  box.include(Vec3{radius_mm, radius_mm, radius_mm});
  return from_distance([=](const Vec3& p) { return length(p) - radius_mm; }, box, options);
}

Result<Clay> Clay::block(const Vec3& size_mm, const ClayOptions& options) {
  if (auto ok = validate_options(options); !ok) return ok.error();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (auto ok = validate_size(size_mm[axis], options, "size_mm"); !ok) return ok.error();
  }
  const Vec3 half = size_mm * 0.5;
  const auto distance = [half](const Vec3& p) {
    const Vec3 d{std::abs(p.x) - half.x, std::abs(p.y) - half.y, std::abs(p.z) - half.z};
    const Vec3 out{std::max(d.x, 0.0), std::max(d.y, 0.0), std::max(d.z, 0.0)};
    return length(out) + std::min(0.0, std::max({d.x, d.y, d.z}));
  };
  Box3 box;
  box.include(-half);
  box.include(half);
  return from_distance(distance, box, options);
}

Result<Clay> Clay::from_distance(const std::function<double(const Vec3&)>& distance_mm,
                                 const Box3& bounds_mm, const ClayOptions& options) {
  if (auto ok = validate_options(options); !ok) return ok.error();
  if (auto ok = validate_bounds(bounds_mm, options); !ok) return ok.error();
  if (!distance_mm) return Error{ErrorKind::bad_input, "no formula for the distance was given"};
  std::atomic<bool> finite{true};
  const auto checked = [&](const Vec3& place) {
    const double distance = distance_mm(place);
    if (std::isfinite(distance)) return distance;
    finite.store(false, std::memory_order_relaxed);
    return 0.0;
  };
  try {
    auto stack = stack_from_distance(checked, bounds_mm, options);
    if (finite.load()) return from_levels(std::move(stack), options);
    return Error{
        ErrorKind::bad_input,
        "the distance is not a finite number somewhere within the bounds; mend the formula"};
  } catch (const std::bad_alloc&) {
    return out_of_memory("make the clay");
  }
}

const ClayOptions& Clay::options() const noexcept { return state_->options; }
int Clay::level_count() const noexcept { return state_->levels->count(); }
const LevelStack& Clay::levels() const noexcept { return *state_->levels; }
int Clay::undo_depth() const noexcept { return static_cast<int>(state_->undo.size()); }

std::vector<LevelStats> Clay::level_stats() const {
  std::vector<LevelStats> stats;
  for (int level = 0; level < level_count(); ++level) {
    const auto& tree = levels().grid(level).tree();
    stats.push_back(
        {level, levels().voxel_mm(level), static_cast<std::int64_t>(tree.activeVoxelCount()),
         static_cast<std::int64_t>(tree.leafCount()), static_cast<std::int64_t>(tree.memUsage())});
  }
  return stats;
}

std::uint64_t Clay::hash() const {
  Hash64 hash;
  for (int level = 0; level < level_count(); ++level) {
    const double voxel = levels().voxel_mm(level);
    hash.update(bytes_of(&voxel, 1));
    const std::vector<Coord> places = levels().sorted_places(level);
    std::vector<std::uint64_t> leaf_hash(places.size());
    tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t n) {
      leaf_hash[n] = hash_leaf(*levels().leaf(level, places[n]));
    });
    hash.update(bytes_of(leaf_hash.data(), leaf_hash.size()));
  }
  return hash.digest();
}

double Clay::distance_at(const Vec3& point_mm) const {
  const LevelStack& stack = levels();
  for (int level = 0; level < stack.count(); ++level) {
    const double h = stack.voxel_mm(level);
    const Vec3 at = point_mm / h;
    const Vec3 low{std::floor(at.x), std::floor(at.y), std::floor(at.z)};
    if (!(std::abs(low.x) < 1e9 && std::abs(low.y) < 1e9 && std::abs(low.z) < 1e9)) break;
    const Coord node(static_cast<int>(low.x), static_cast<int>(low.y), static_cast<int>(low.z));
    if (level < stack.top() && !stack.has_leaf(level, node)) continue;
    const Vec3 t = at - low;
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      const int i = corner >> 2;
      const int j = (corner >> 1) & 1;
      const int k = corner & 1;
      const double weight = (i ? t.x : 1.0 - t.x) * (j ? t.y : 1.0 - t.y) * (k ? t.z : 1.0 - t.z);
      sum += weight * static_cast<double>(stack.node_value(level, node.offsetBy(i, j, k)));
    }
    return sum;
  }
  return static_cast<double>(stack.band_mm(stack.top()));
}

Box3 Clay::bounds_mm() const {
  Box3 box;
  for (int level = 0; level < level_count(); ++level) {
    const double h = levels().voxel_mm(level);
    for (auto leaf = levels().grid(level).tree().cbeginLeaf(); leaf; ++leaf) {
      for (auto value = leaf->cbeginValueOn(); value; ++value) {
        if (*value >= static_cast<float>(h)) continue;
        const Coord node = value.getCoord();
        box.include({h * node.x(), h * node.y(), h * node.z()});
      }
    }
  }
  return box;
}

namespace {

Result<void> validate_reach(const Stroke& stroke, const LevelStack& stack) {
  const double radius = largest_radius(stroke.tool);
  const double most_radius = kLargestToolVoxels * stack.voxel_mm(stack.top());
  std::ostringstream message;
  if (radius > most_radius) {
    message << "radius_mm is " << radius << "; for a clay of this size it may be at most "
            << most_radius;
    return Error{ErrorKind::bad_input, message.str()};
  }
  const double most = (kMaxNode - 64) * stack.voxel_mm(0) - radius;
  for (std::size_t i = 0; i < stroke.samples.size(); ++i) {
    const Vec3& p = stroke.samples[i].position_mm;
    const double reach = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    if (reach <= most) continue;
    message << "poses[" << i << "]: a coordinate of " << reach
            << " mm is out of reach; with this voxel size at most " << most << " mm";
    return Error{ErrorKind::bad_input, message.str()};
  }
  return {};
}

std::vector<std::pair<int, Coord>> keys_of(const UndoStep& step) {
  std::vector<std::pair<int, Coord>> keys;
  keys.reserve(step.size());
  for (const auto& entry : step) keys.push_back(entry.first);
  return keys;
}

}  // namespace

Result<StrokeReport> Clay::apply(const Stroke& stroke, const Progress& progress) {
  if (auto ok = validate_stroke(stroke); !ok) return ok.error();
  if (auto ok = validate_reach(stroke, levels()); !ok) return ok.error();
  State& state = *state_;
  UndoStep step;
  const LeafSink sink = [&](SavedLeaf saved) {
    state.log_change(saved.level, saved.place);
    const auto key = std::make_pair(saved.level, saved.place);
    step.try_emplace(key, std::move(saved));  // the first state within the stroke counts
  };
  StrokeReport report;
  report.level = level_of_tool(*state.levels, smallest_radius(stroke.tool));
  try {
    const std::vector<DabPose> dabs = dabs_of(stroke);
    for (const DabPose& pose : dabs) {
      const double start = thread_cpu_ms();
      apply_dab(*state.levels, PosedTool(stroke.tool, pose), stroke.spacing, state.tolerance_mm(),
                sink);
      report.dab_cpu_ms.push_back(thread_cpu_ms() - start);
      ++report.dabs;
      if (progress && !progress("sculpt", static_cast<double>(report.dabs) /
                                              static_cast<double>(dabs.size()))) {
        state.exchange(step);
        return Error{ErrorKind::interrupted, "interrupted; the stroke was taken back"};
      }
    }
    for (int pass = 0; pass < kMostRenormalisations; ++pass) {
      if (!renormalise_strayed(*state.levels, keys_of(step), state.tolerance_mm(), sink)) break;
    }
    tidy(*state.levels, keys_of(step), state.tolerance_mm(), sink);
  } catch (const std::bad_alloc&) {
    state.exchange(step);
    return out_of_memory("apply the stroke");
  }
  state.undo.push_back(std::move(step));
  state.redo.clear();
  return report;
}

bool Clay::undo() {
  if (state_->undo.empty()) return false;
  state_->redo.push_back(state_->exchange(state_->undo.back()));
  state_->undo.pop_back();
  return true;
}

bool Clay::redo() {
  if (state_->redo.empty()) return false;
  state_->undo.push_back(state_->exchange(state_->redo.back()));
  state_->redo.pop_back();
  return true;
}

std::uint64_t identity(const Clay& clay) { return clay.change_log().identity; }
std::uint64_t revision(const Clay& clay) { return clay.change_log().revision; }

std::optional<std::vector<LeafChange>> changes_since(const Clay& clay, std::uint64_t since) {
  const ChangeLog log = clay.change_log();
  const std::uint64_t forgotten = log.revision - log.changes->size();
  if (since < forgotten) return std::nullopt;
  std::vector<LeafChange> changes(
      log.changes->begin() + static_cast<std::ptrdiff_t>(since - forgotten), log.changes->end());
  std::sort(changes.begin(), changes.end());
  changes.erase(std::unique(changes.begin(), changes.end()), changes.end());
  return changes;
}

ChangeLog Clay::change_log() const noexcept {
  return {state_->identity, state_->forgotten + state_->changes.size(), &state_->changes};
}

}  // namespace argil
