// SPDX-License-Identifier: GPL-3.0-or-later
// To a count of triangles by rounds of collapse and fit. Around triangles that came out folded the
// fit is taken back first; where that does not help, the vertices of the surface there are locked,
// and the next round begins from the whole surface again. Within a bound no round is needed: there
// all is proven, and what is not goes back where it is.
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

#include "decimate/balls.h"
#include "decimate/collapse_run.h"
#include "decimate/fit_vertices.h"

namespace argil::mesh {
namespace {

/// The radius of a lock doubles each round; before the last it is 16 voxels more than the size of
/// the bad triangle.
constexpr int kMostDecimateRounds = 6;

std::string mm(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g mm", value);
  return text;
}

Error keeps_folding() {
  return {ErrorKind::bad_input,
          "removing triangles keeps folding the surface; ask for more triangles or a larger "
          "error, or export the whole surface"};
}

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
  Result<void> one_round();
  std::vector<BadPoint> bad_points(const Pace& pace) const;
  std::vector<BadPoint> take_back_fit();
  Pace next_part();
  void lock(std::vector<BadPoint> points);
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

/// How many rounds it will take nobody knows: each part takes its fraction of what is left.
Pace Rounds::next_part() {
  const double begin = done_;
  done_ += 0.8 * (1.0 - done_);
  return pace_.part(begin, done_);
}

Result<void> Rounds::one_round() {
  const Pace pace = next_part();
  auto collapsed =
      collapse_edges(surface_, target_, options_.triangles, locked_, pace.part(0.0, 0.8));
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
  fit_vertices(made_.mesh, target_, fixed, pace.part(0.8, 1.0));
  made_.mesh = rounded_to_float(std::move(made_.mesh));
  return {};
}

/// Where the mesh folds or crosses itself.
std::vector<BadPoint> Rounds::bad_points(const Pace& pace) const {
  const TriangleMesh& mesh = made_.mesh;
  std::vector<BadPoint> points;
  const auto add = [&](std::uint32_t t) {
    const Corners corners = corners_of(mesh, t);
    points.push_back({middle(corners), longest_side(corners)});
  };
  // A triangle without area touches whatever its sides do; it is bad by itself and left out
  // of the pairs.
  const std::vector<std::uint32_t> flat = degenerate_triangles(mesh);
  for (const std::uint32_t t : flat) add(t);
  for (const auto& [a, b] : self_intersections(mesh, flat, pace)) {
    add(a);
    add(b);
  }
  return points;
}

/// Takes the fit back around bad points, ever wider, as long as that helps. The points that are
/// left.
std::vector<BadPoint> Rounds::take_back_fit() {
  constexpr int kMostTakes = 3;
  for (int attempt = 0;; ++attempt) {
    std::vector<BadPoint> points = bad_points(next_part());
    if (points.empty() || attempt == kMostTakes) return points;
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
void Rounds::lock(std::vector<BadPoint> points) {
  constexpr double kWidestVoxels = 2.0;  // wider locks would leave no room for few triangles
  const double voxel_mm = target_.voxel_mm();
  for (BadPoint& p : points) p.size_mm = std::min(p.size_mm, kWidestVoxels * voxel_mm);
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
  for (;;) {
    if (Result<void> round = one_round(); !round) return round.error();
    const auto triangles = static_cast<std::int64_t>(made_.mesh.triangles.size());
    if (triangles > options_.triangles) return not_reached();
    std::vector<BadPoint> points = take_back_fit();
    if (points.empty()) return std::move(made_);
    if (made_.report.rounds == kMostDecimateRounds) break;
    lock(std::move(points));
  }
  return keeps_folding();
}

/// Below this many voxels a proof would look at too many places.
constexpr double kLeastBoundVoxels = 0.05;

/// The surface itself must be within the bound, since that is what everything falls back on.
Error not_within(const DecimationTarget& target, double bound_mm, const Pace& pace) {
  const double own = target.own_error_mm(pace);
  const double least = kLeastBoundVoxels * target.voxel_mm();
  return {ErrorKind::bad_input, "no mesh of this clay can be proven to lie within " + mm(bound_mm) +
                                    ": its own surface is up to " + mm(own) +
                                    " off at sharp edges, and nothing is proven below " +
                                    mm(least) + ", a twentieth of a voxel; allow at least " +
                                    mm(std::max(1.1 * own, least)) +
                                    ", or resample the clay to a finer voxel"};
}

Result<Decimated> decimate_within(const TriangleMesh& surface, const DecimationTarget& target,
                                  const DecimateOptions& options, const Pace& pace) {
  if (options.max_error_mm < kLeastBoundVoxels * target.voxel_mm()) {
    return not_within(target, options.max_error_mm, pace);
  }
  auto made = collapse_within(surface, target, options, pace);
  if (!made) return made.error();
  if (!made.value().is_proven) {
    return not_within(target, options.max_error_mm, pace.part(1.0, 1.0));
  }
  if (made.value().has_folds) return keeps_folding();
  Collapsed& collapsed = made.value().collapsed;
  return Decimated{std::move(collapsed.mesh), {made.value().tries, collapsed.steps, 0}};
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
  return no_throw("removing triangles", [&] {
    if (options.max_error_mm <= 0.0) return Rounds(surface, target, options, progress).run();
    return decimate_within(surface, target, options, Pace(progress, "decimate"));
  });
}

}  // namespace argil::mesh
