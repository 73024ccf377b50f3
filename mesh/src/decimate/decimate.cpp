// SPDX-License-Identifier: GPL-3.0-or-later
// Rounds of collapse, fit and measurement. Around triangles that came out folded or out of bounds
// the fit is taken back first; where that does not help, the vertices of the surface there are
// locked, and the next round begins from the whole surface again.
#include "argil/mesh/decimate.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "argil/core/no_throw.h"
#include "argil/mesh/intersections.h"
#include "argil/mesh/rounding.h"
#include "argil/mesh/triangle_geometry.h"

#include "decimate/collapse_run.h"
#include "decimate/fit_vertices.h"

namespace argil::mesh {
namespace {

/// The radius of a lock doubles each round; before the last it is 16 voxels more than the size of
/// the bad triangle.
constexpr int kMostDecimateRounds = 6;
/// What is in hand between the bound that was asked for and what the steps, the fit and the
/// measurement keep to: the first two look at fewer points than the last.
constexpr double kStepFraction = 0.8;
constexpr double kMeasuredFraction = 0.95;

std::string mm(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g mm", value);
  return text;
}

/// Balls around bad points, to be asked which vertices lie in one.
class Balls {
 public:
  Balls(std::vector<FarPoint> points, double widen_mm) : centres_(std::move(points)) {
    for (FarPoint& p : centres_) widest_ = std::max(widest_, p.size_mm += widen_mm);
    std::sort(centres_.begin(), centres_.end(),
              [](const FarPoint& a, const FarPoint& b) { return a.at_mm.x < b.at_mm.x; });
  }
  bool hold(const Vec3& point) const {
    assert(is_finite(point));
    const auto before = [](const FarPoint& p, double x) { return p.at_mm.x < x; };
    auto p = std::lower_bound(centres_.begin(), centres_.end(), point.x - widest_, before);
    for (; p != centres_.end() && p->at_mm.x <= point.x + widest_; ++p) {
      const Vec3 offset = point - p->at_mm;
      if (dot(offset, offset) <= p->size_mm * p->size_mm) return true;
    }
    return false;
  }

 private:
  std::vector<FarPoint> centres_;  ///< by x
  double widest_ = 0.0;
};

class Rounds {
 public:
  Rounds(const TriangleMesh& surface, const DecimationTarget& target,
         const DecimateOptions& options, const Progress& progress)
      : surface_(surface),
        target_(target),
        options_(options),
        pace_(progress, "decimate"),
        locked_(surface.positions.size(), false) {}

  Result<Decimated> run();

 private:
  Result<void> check_bound();
  Result<void> one_round();
  std::vector<FarPoint> bad_points(const Pace& pace) const;
  std::vector<FarPoint> take_back_fit();
  Pace next_part();
  void lock(std::vector<FarPoint> points);
  Error not_reached() const;

  const TriangleMesh& surface_;
  const DecimationTarget& target_;
  const DecimateOptions& options_;
  Pace pace_;
  double done_ = 0.0;         ///< fraction of the work, as far as can be told
  std::vector<bool> locked_;  ///< of the surface's vertices
  std::vector<Vec3> unfitted_;
  Decimated made_;
};

/// How many rounds it will take nobody knows: each part takes its fraction of what is left. With a
/// bound rounds are many, and half of the time goes into measuring.
Pace Rounds::next_part() {
  const double begin = done_;
  done_ += (options_.max_error_mm > 0.0 ? 0.25 : 0.8) * (1.0 - done_);
  return pace_.part(begin, done_);
}

/// The surface itself must be within the bound, since that is what everything falls back on.
Result<void> Rounds::check_bound() {
  if (options_.max_error_mm <= 0.0) return {};
  std::vector<FarPoint> ignored;
  const double own = target_.error_of(surface_, 0.0, ignored, pace_.part(0.0, 0.0)).max_mm();
  if (own <= kMeasuredFraction * options_.max_error_mm) return {};
  return Error{ErrorKind::bad_input, "no mesh of this clay is within " + mm(options_.max_error_mm) +
                                         ": its own surface is up to " + mm(own) +
                                         " off at sharp edges; allow at least " + mm(1.1 * own) +
                                         ", or resample the clay to a finer voxel"};
}

Result<void> Rounds::one_round() {
  CollapseGoal goal;
  goal.triangles = options_.triangles;
  goal.reach_mm = kStepFraction * options_.max_error_mm;
  auto collapsed = collapse_edges(surface_, target_, goal, locked_, next_part());
  if (!collapsed) return collapsed.error();
  ++made_.report.rounds;
  made_.report.collapses = collapsed.value().steps;
  made_.mesh = std::move(collapsed.value().mesh);
  std::vector<bool> fixed;
  for (const std::uint32_t v : collapsed.value().kept) fixed.push_back(locked_[v]);
  made_.mesh = rounded_to_float(std::move(made_.mesh));
  assert(fixed.size() == made_.mesh.positions.size());
  // After rounding: vertices that are put back here are not rounded again, and the file must hold
  // just these.
  unfitted_ = made_.mesh.positions;
  fit_vertices(made_.mesh, target_, goal.reach_mm, fixed);
  made_.mesh = rounded_to_float(std::move(made_.mesh));
  return {};
}

/// Where the mesh folds, crosses itself or is out of bounds.
std::vector<FarPoint> Rounds::bad_points(const Pace& pace) const {
  const TriangleMesh& mesh = made_.mesh;
  std::vector<FarPoint> points;
  const auto add = [&](std::uint32_t t) {
    const Corners corners = corners_of(mesh, t);
    points.push_back({middle(corners), longest_side(corners)});
  };
  // A triangle without area touches whatever its sides do; it is bad by itself and left out
  // of the pairs.
  const std::vector<std::uint32_t> flat = degenerate_triangles(mesh);
  for (const std::uint32_t t : flat) add(t);
  for (const auto& [a, b] : self_intersections(mesh, flat, pace.part(0.0, 0.1))) {
    add(a);
    add(b);
  }
  if (options_.max_error_mm > 0.0) {
    const double bound = kMeasuredFraction * options_.max_error_mm;
    target_.error_of(mesh, bound, points, pace.part(0.1, 1.0));
  }
  return points;
}

/// Takes the fit back around bad points, ever wider, as long as that helps. The points that are
/// left.
std::vector<FarPoint> Rounds::take_back_fit() {
  constexpr int kMostTries = 3;
  for (int attempt = 0;; ++attempt) {
    std::vector<FarPoint> points = bad_points(next_part());
    if (points.empty() || attempt == kMostTries) return points;
    const Balls balls(points, (1 << attempt) * target_.voxel_mm());
    assert(unfitted_.size() == made_.mesh.positions.size());
    bool changed = false;
    for (std::size_t v = 0; v < unfitted_.size(); ++v) {
      Vec3& p = made_.mesh.positions[v];
      if (p == unfitted_[v] || !balls.hold(p)) continue;
      p = unfitted_[v];
      changed = true;
    }
    if (!changed) return points;
  }
}

/// Keeps the surface as it was around bad points, ever wider with each round.
void Rounds::lock(std::vector<FarPoint> points) {
  constexpr double kWidestVoxels = 2.0;  // wider locks would leave no room for few triangles
  const double voxel_mm = target_.voxel_mm();
  for (FarPoint& p : points) p.size_mm = std::min(p.size_mm, kWidestVoxels * voxel_mm);
  const Balls balls(std::move(points), (1 << (made_.report.rounds - 1)) * voxel_mm);
  for (std::size_t v = 0; v < locked_.size(); ++v) {
    if (balls.hold(surface_.positions[v])) locked_[v] = true;
  }
  made_.report.locked_vertices = std::count(locked_.begin(), locked_.end(), true);
}

Error Rounds::not_reached() const {
  return {ErrorKind::bad_input, "the surface cannot be brought below " +
                                    std::to_string(made_.mesh.triangles.size()) +
                                    " triangles without folding; ask for at least as many"};
}

Result<Decimated> Rounds::run() {
  if (Result<void> possible = check_bound(); !possible) return possible.error();
  for (;;) {
    if (Result<void> round = one_round(); !round) return round.error();
    const auto triangles = static_cast<std::int64_t>(made_.mesh.triangles.size());
    if (options_.max_error_mm <= 0.0 && triangles > options_.triangles) return not_reached();
    std::vector<FarPoint> points = take_back_fit();
    if (points.empty()) return std::move(made_);
    if (made_.report.rounds == kMostDecimateRounds) break;
    lock(std::move(points));
  }
  return Error{ErrorKind::bad_input,
               "removing triangles keeps folding the surface; ask for more triangles or a larger "
               "error, or export the whole surface"};
}

Result<void> check_options(const DecimateOptions& options) {
  const bool has_bound = std::isfinite(options.max_error_mm) && options.max_error_mm > 0.0;
  if (options.max_error_mm != 0.0 && !has_bound) {
    return Error{ErrorKind::bad_input, "the largest error must be a number of mm above 0"};
  }
  if (options.triangles != 0 && options.triangles < 4) {
    return Error{ErrorKind::bad_input, "no closed mesh has " + std::to_string(options.triangles) +
                                           " triangles; ask for at least 4"};
  }
  if (options.triangles > 0 || has_bound) return {};
  return Error{ErrorKind::bad_input, "neither a count of triangles nor a largest error was given"};
}

}  // namespace

Result<Decimated> decimate(const TriangleMesh& surface, const DecimationTarget& target,
                           const DecimateOptions& options, const Progress& progress) {
  if (Result<void> good = check_options(options); !good) return good.error();
  return no_throw("removing triangles",
                  [&] { return Rounds(surface, target, options, progress).run(); });
}

}  // namespace argil::mesh
