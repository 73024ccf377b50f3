// SPDX-License-Identifier: GPL-3.0-or-later
// How much a method's error changes while the tool slides through the cells of its lattice.
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <span>

#include "force/station.h"

namespace argil::evaluation {

using haptics::ForceLaw;
using haptics::ForceTool;

namespace {

constexpr int kRippleSteps = 16;
constexpr double kCells = 3.0;
constexpr double kRippleDepth = 0.5;  // of the radius
constexpr int kAcross = 20;  // of the reference, which only has to be smooth along the path

/// The error along the path less its mean, root mean square and peak to peak, relative.
void add_ripple(const std::vector<Vec3>& error, double mean_force_n, Tally& tally) {
  assert(!error.empty() && mean_force_n > 0.0);
  const auto count = static_cast<double>(error.size());
  Vec3 mean;
  for (const Vec3& e : error) mean += e / count;
  double squares = 0.0;
  double widest = 0.0;
  for (const Vec3& a : error) {
    squares += dot(a - mean, a - mean) / count;
    for (const Vec3& b : error) widest = std::max(widest, length(a - b));
  }
  tally.ripple_rms.push_back(std::sqrt(squares) / mean_force_n);
  tally.ripple_pp.push_back(widest / mean_force_n);
}

}  // namespace

/// A straight path of a few cells of one lattice, with the reference all along, so that what a
/// method adds is its own.
struct ForceStation::Path {
  Path(const ForceStation& station, const ForceTool& middle, const Vec3& along, double spacing_mm);

  std::vector<ForceTool> poses;
  std::vector<Reference> truth;
  Windows windows;
};

ForceStation::Path::Path(const ForceStation& station, const ForceTool& middle, const Vec3& along,
                         double spacing_mm)
    : windows(station.scene_, middle, station.material(0), 0.5 * kCells * spacing_mm) {
  const Scene& scene = station.scene_;
  for (int step = 0; step < kRippleSteps; ++step) {
    const double cells = kCells * (static_cast<double>(step) / (kRippleSteps - 1) - 0.5);
    // Cells of the method's own lattice, so that each method slides over the same number of
    // its cells.
    ForceTool pose = middle;
    pose.position_mm += cells * spacing_mm * along;
    truth.push_back(
        reference_force(scene.distance, scene.probe_mm, pose, station.material(0), kAcross));
    poses.push_back(pose);
  }
}

/// What one method adds along its path, for each exponent.
Result<void> ForceStation::slide(std::size_t method, Path& path, std::span<ForceRow> rows) const {
  auto read = path.windows.of(methods_[method]);
  if (!read) return read.error();
  const FieldWindowView* window = read.value();
  const double floor_n = kFloorFraction * material(0).surface_force_n;
  for (std::size_t e = 0; e < kExponents.size(); ++e) {
    const Query& query = queries_[method * kExponents.size() + e];
    std::vector<Vec3> error;
    double force_n = 0.0;
    for (std::size_t i = 0; i < path.poses.size(); ++i) {
      const Vec3& truth = truth_for(methods_[method], path.truth[i], e).force_n;
      const Answer answer = window != nullptr ? query.ask(*window, path.poses[i])
                                              : query.ask(scene_.distance, path.poses[i]);
      error.push_back(answer.wrench.force_n - truth);
      force_n += length(truth) / kRippleSteps;
    }
    add_ripple(error, std::max(force_n, floor_n), rows[e].tally);
  }
  return {};
}

Result<void> ForceStation::measure_ripple(std::vector<ForceRow>& rows) {
  Vec3 normal;
  const ForceTool middle = pose_at(kRippleDepth, normal);
  assert(rows.size() == methods_.size() * kExponents.size());  // before any row is dropped
  const Vec3 along = normalized(cross(normal, random_.direction()));
  std::map<double, Path> paths;  // by spacing
  for (std::size_t m = 0; m < methods_.size(); ++m) {
    const Method& method = methods_[m];
    if (!is_measured(method, middle) || is_dense(method) || method.quadrature == Quadrature::fine)
      continue;
    const double spacing = spacing_mm(methods_[m], middle);
    auto path = paths.find(spacing);
    if (path == paths.end()) {
      path = paths.try_emplace(spacing, *this, middle, along, spacing).first;
    }
    const std::span<ForceRow> own(rows.data() + m * kExponents.size(), kExponents.size());
    if (auto done = slide(m, path->second, own); !done) return done.error();
  }
  return {};
}

}  // namespace argil::evaluation
