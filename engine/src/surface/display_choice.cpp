// SPDX-License-Identifier: GPL-3.0-or-later
// Levels are chosen from the finest up: what a level shows requires leaves of the next coarser one.
#include "surface/display_choice.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>

#include "field/bad_input.h"
#include "field/nesting.h"

namespace argil {
namespace {

constexpr std::uint8_t kRequired = 0x80;  // else the bits of Needs count levels
constexpr std::uint8_t kHeight = 0x7f;

/// The distances from the eye at which a level's leaves change: shown ones are hidden beyond
/// `hide`, hidden ones are shown again nearer than `show`. Squares; below 0 for no distance at all.
struct ShowDistances {
  double hide = 0.0;
  double show = 0.0;
};

/// The square of the distance at which a voxel spans so many pixels.
double distance_of(const DisplayView& view, double voxel_mm, double pixels) {
  const double rest = voxel_mm / pixels - view.pixel_mm;
  if (rest < 0.0) return -1.0;
  if (!(view.pixel_rad > 0.0)) return std::numeric_limits<double>::infinity();
  const double distance = rest / view.pixel_rad;
  return distance * distance;
}

ShowDistances show_distances(const DisplayView& view, double voxel_mm) {
  return {distance_of(view, voxel_mm, view.voxel_pixels),
          distance_of(view, voxel_mm, view.voxel_pixels * (1.0 + view.hysteresis))};
}

/// The square of the distance within which all that a leaf requires is shown for its own size: it
/// touches the leaf, so it is farther by a leaf's diagonal at most.
double supported_within(const DisplayView& view, double voxel_mm) {
  constexpr double kDiagonal = 14.0;  // above 8 sqrt(3)
  const double rest =
      std::sqrt(std::max(show_distances(view, 2.0 * voxel_mm).show, 0.0)) - kDiagonal * voxel_mm;
  return rest > 0.0 ? rest * rest : -1.0;
}

/// From the eye to the nearest point of a leaf's cells.
double squared_distance(const Vec3& eye, const Coord& origin, double voxel_mm) {
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = origin[axis] * voxel_mm;
    const double at = eye[static_cast<std::size_t>(axis)];
    const double off = std::max({low - at, at - (low + kLeafSide * voxel_mm), 0.0});
    sum += off * off;
  }
  return sum;
}

Result<void> view_out_of_range(const char* name, double value, const char* range) {
  return bad_input(std::string("display view '") + name + "' is " + number_text(value) +
                   "; it must be " + range);
}

}  // namespace

Result<void> validate_view(const DisplayView& view) {
  const auto in = [](double value, double least, double most) {
    return value >= least && value <= most;
  };
  constexpr double kMost = std::numeric_limits<double>::max();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!in(view.eye_mm[axis], -1e12, 1e12)) {
      return view_out_of_range("eye_mm", view.eye_mm[axis], "-1e12 to 1e12 in each coordinate");
    }
  }
  if (!in(view.pixel_rad, 0.0, kMost)) {
    return view_out_of_range("pixel_rad", view.pixel_rad, "finite and not below 0");
  }
  if (!in(view.pixel_mm, 0.0, kMost)) {
    return view_out_of_range("pixel_mm", view.pixel_mm, "finite and not below 0");
  }
  if (!(view.pixel_rad + view.pixel_mm > 0.0)) {
    return view_out_of_range("pixel_rad", view.pixel_rad, "above 0 where pixel_mm is 0");
  }
  if (!in(view.voxel_pixels, 0.1, 100.0)) {
    return view_out_of_range("voxel_pixels", view.voxel_pixels, "0.1 to 100");
  }
  if (!in(view.hysteresis, 0.0, 1.0)) {
    return view_out_of_range("hysteresis", view.hysteresis, "0 to 1");
  }
  if (view.coarser < 1 || view.coarser > 32) {
    return view_out_of_range("coarser", view.coarser, "1 to 32");
  }
  return {};
}

void DisplayChoice::show_all(const LevelStack& stack) {
  levels_.clear();
  levels_.resize(static_cast<std::size_t>(stack.count()));
  for (int level = 0; level < stack.count(); ++level) {
    Level& here = levels_[static_cast<std::size_t>(level)];
    here.voxel_mm = stack.voxel_mm(level);
    for (auto leaf = stack.grid(level).tree().cbeginLeaf(); leaf; ++leaf) {
      here.leaves.at(leaf->origin()) = State::shown;
    }
  }
}

void DisplayChoice::set(const LeafKey& at, State to) {
  assert(at.level >= 0 && static_cast<std::size_t>(at.level) < levels_.size());
  Level& level = levels_[static_cast<std::size_t>(at.level)];
  State& state = level.leaves.at(at.origin);
  level.hidden += (to == State::hidden ? 1 : 0) - (state == State::hidden ? 1 : 0);
  state = to;
}

bool DisplayChoice::follow(const LevelStack& stack, std::span<const LeafChange> changes) {
  assert(levels_.size() == static_cast<std::size_t>(stack.count()));
  bool any = false;
  for (const LeafChange& change : changes) {
    if (!change.is_whole) continue;
    const LeafMap<State>& leaves = levels_[static_cast<std::size_t>(change.level)].leaves;
    const bool is_there = stack.has_leaf(change.level, change.origin);
    if (is_there == (leaves.get(change.origin) != State::absent)) continue;
    const State come = change.level + 1 < stack.count() ? State::hidden : State::shown;
    set(change.where(), is_there ? come : State::absent);
    any = true;
  }
  return any;
}

std::vector<LeafKey> DisplayChoice::choose(const std::optional<DisplayView>& view) {
  assert(!view || validate_view(*view));
  std::vector<LeafKey> flips;
  Needs needs;
  for (int level = 0; level + 1 < static_cast<int>(levels_.size()); ++level) {
    const Level& here = levels_[static_cast<std::size_t>(level)];
    if (!view) {
      if (here.hidden == 0) continue;
      here.leaves.for_each([&](const Coord& origin, State state) {
        if (state == State::hidden) flips.push_back({level, origin});
      });
      continue;
    }
    Needs next;
    choose_level(level, *view, needs, next, flips);
    needs = std::move(next);
  }
  for (const LeafKey& at : flips) set(at, shows(at) ? State::hidden : State::shown);
  return flips;
}

void DisplayChoice::choose_level(int level, const DisplayView& view, Needs& needs, Needs& next,
                                 std::vector<LeafKey>& flips) const {
  const Level& here = levels_[static_cast<std::size_t>(level)];
  const ShowDistances reach = show_distances(view, here.voxel_mm);
  const double supported = supported_within(view, here.voxel_mm);
  here.leaves.for_each([&](const Coord& origin, State state) {
    const std::uint8_t need = needs.at(origin);
    const double square = squared_distance(view.eye_mm, origin, here.voxel_mm);
    const bool is_shown = (need & kRequired) != 0 || (need & kHeight) >= view.coarser ||
                          square <= (state == State::hidden ? reach.show : reach.hide);
    if (is_shown != (state == State::shown)) flips.push_back({level, origin});
    std::uint8_t& parent = next.at(leaf_origin(coarser(origin)));
    const int height = std::max(parent & kHeight, (need & kHeight) + 1);
    parent = static_cast<std::uint8_t>((parent & kRequired) | height);
    if (!is_shown || square <= supported) return;
    for_each_required_parent(origin, [&](const Coord& coarse) { next.at(coarse) |= kRequired; });
  });
}

std::int64_t DisplayChoice::hidden_count() const noexcept {
  std::int64_t count = 0;
  for (const Level& level : levels_) count += level.hidden;
  return count;
}

int DisplayChoice::coarsest_hidden() const noexcept {
  auto level = static_cast<int>(levels_.size()) - 1;
  while (level >= 0 && levels_[static_cast<std::size_t>(level)].hidden == 0) --level;
  return level;
}

std::int64_t DisplayChoice::bytes() const noexcept {
  std::int64_t bytes = 0;
  for (const Level& level : levels_) bytes += level.leaves.bytes();
  return bytes;
}

}  // namespace argil
