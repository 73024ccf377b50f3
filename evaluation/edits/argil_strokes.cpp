// SPDX-License-Identifier: GPL-3.0-or-later
// The strokes of the chart as Argil makes them, all included: the edit of all levels, the record
// for undo, the surface with its normals after each dab, and the end of the stroke.
#include "edits/argil_strokes.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

#include "argil/engine/pick.h"

#include "common/machine.h"
#include "common/output.h"

namespace argil::evaluation {
namespace {

/// What takes so long is timed once: it is not by chance.
constexpr double kEnoughS = 2.0;

void keep_least(const StrokeTime& time, bool is_first, StrokeTime& least) {
  least.wall_ms = is_first ? time.wall_ms : std::min(least.wall_ms, time.wall_ms);
  least.cpu_ms = is_first ? time.cpu_ms : std::min(least.cpu_ms, time.cpu_ms);
}

}  // namespace

ArgilBench::ArgilBench(const BumpyBall& ball, Clay clay) : ball_(ball), clay_(std::move(clay)) {
  surface_.update(clay_);
  vertices_ = surface_.weld().positions;
  vertices_.shrink_to_fit();
}

Result<void> ArgilBench::time(const StrokePlan& plan, Action action, int repeats, EditRow& row) {
  assert(repeats > 0);
  const Stroke whole = argil_stroke(plan, action);
  const cli::Stopwatch spent;
  for (int run = 0; run == 0 || (run < repeats && spent.seconds() < kEnoughS); ++run) {
    auto few = stroke(whole, kShortDabs);
    if (!few) return few.error();
    undo();
    auto many = stroke(whole, kLongDabs);
    if (!many) return many.error();
    row.moved_mm = moved_mm(plan);
    undo();
    keep_least(few.value(), run == 0, row.times.short_stroke);
    keep_least(many.value(), run == 0, row.times.long_stroke);
  }
  return {};
}

Result<TriangleMesh> ArgilBench::result_of(const StrokePlan& plan, Action action) {
  // At once, where an anchored tool need not begin anew with each dab: the bits are the same.
  if (auto made = clay_.apply(argil_stroke(plan, action)); !made) return made.error();
  surface_.update(clay_);
  TriangleMesh result = surface_.weld();
  undo();
  return result;
}

std::int64_t ArgilBench::covered_by(const StrokePlan& plan, Action action) const {
  const Stroke first = argil_stroke(plan, action);
  const Vec3 at = first.samples[0].position_mm;
  const double radius = smallest_radius(first.tool);
  return std::count_if(vertices_.begin(), vertices_.end(),
                       [&](const Vec3& p) { return dot(p - at, p - at) < radius * radius; });
}

Result<StrokeTime> ArgilBench::stroke(const Stroke& stroke, int dabs) {
  assert(dabs > 0 && static_cast<std::size_t>(dabs) <= stroke.samples.size());
  const cli::Stopwatch wall;
  const double cpu_us = cli::process_cpu_us();
  if (auto begun = clay_.begin_stroke(stroke.tool, stroke); !begun) return begun.error();
  for (int i = 0; i < dabs; ++i) {
    const auto made = clay_.extend_stroke({&stroke.samples[static_cast<std::size_t>(i)], 1});
    if (!made) return made.error();
    if (made.value() != 1) return Error{ErrorKind::internal, "a sample did not make one dab"};
    surface_.update(clay_);
  }
  if (auto ended = clay_.end_stroke(); !ended) return ended.error();
  surface_.update(clay_);
  return StrokeTime{1e3 * wall.seconds(), 1e-3 * (cli::process_cpu_us() - cpu_us)};
}

/// How far the surface lies from where it was, on rays from outside to the dabs.
double ArgilBench::moved_mm(const StrokePlan& plan) const {
  double farthest = 0.0;
  for (const Vec3& point : plan.points) {
    const auto hit = pick(clay_, {3.0 * point, -normalized(point)});
    if (!hit || !hit.value()) continue;
    farthest = std::max(farthest, std::abs(ball_.distance(hit.value()->point_mm)));
  }
  return farthest;
}

void ArgilBench::undo() {
  clay_.undo();
  surface_.update(clay_);
}

}  // namespace argil::evaluation
