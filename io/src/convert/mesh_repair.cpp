// SPDX-License-Identifier: GPL-3.0-or-later
// Repairs a mesh: by mending its surface where that is enough, else by way of a level set, which
// has an inside and an outside whatever the triangles were.
#include "argil/io/mesh_repair.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "argil/core/no_throw.h"
#include "argil/core/pace.h"
#include "argil/engine/import.h"
#include "argil/engine/surface.h"
#include "argil/mesh/collapse_folded.h"
#include "argil/mesh/compact.h"
#include "argil/mesh/rounding.h"
#include "argil/mesh/small_components.h"

#include "compare/surface_distance.h"
#include "convert/repair_loss.h"

namespace argil::io {
namespace {

/// The field's voxel: so many of them on the surface take a few seconds; along the largest side,
/// what a thin piece gets and what a bulky one gets at least.
constexpr double kSurfaceNodes = 220'000.0;
constexpr double kLeastVoxelsAlong = 220.0;
constexpr double kMostVoxelsAlong = 512.0;

/// Where so many holes are left, the field has so many fewer nodes.
constexpr std::int64_t kManyHoles = 16;
constexpr double kShareWithGaps = 0.15;
/// And where a few long rims are, beside which all nodes ask.
constexpr double kShareWithRims = 0.35;

/// Smaller than a cube of so many voxels are what triangles that close nothing leave here and
/// there.
constexpr double kSpeckVoxels = 4.0;

/// What mending the surface left undone, and what all of it changed.
class Repair {
 public:
  Repair(const TriangleMesh& input, const RepairOptions& options, const Progress& progress)
      : input_(mesh::rounded_to_float(input)), options_(options), progress_(progress) {}

  Result<RepairedMesh> run();

 private:
  std::int64_t given_holes() const {
    return report_.closing.holes_left + report_.closing.holes_closed - report_.coned_holes;
  }
  double voxel_mm(const TriangleMesh& from) const;
  Result<void> rebuild(const TriangleMesh& from);
  Result<void> rebuild_what_was_lost();
  void compare(const Pace& pace);
  void measure_change(const Pace& pace);
  void note_given_volume();

  const TriangleMesh input_;
  const RepairOptions& options_;
  const Progress& progress_;
  TriangleMesh mesh_;
  TriangleMesh facing_;           ///< MendedMesh::facing
  bool is_contradicted_ = false;  ///< surface is where the winding of `facing_` says there is none
  RepairReport report_;
};

double Repair::voxel_mm(const TriangleMesh& from) const {
  if (options_.voxel_mm > 0.0) return options_.voxel_mm;
  assert(!input_.triangles.empty());
  const Vec3 sides = mesh::used_bounds(input_).size();
  const double largest = std::max({sides.x, sides.y, sides.z});
  // Each of the nodes beside triangles that do not meet asks all of them which side it is on.
  const mesh::CloseReport& closing = report_.closing;
  const std::int64_t holes = &from == &facing_ ? given_holes() : closing.holes_left;
  const double share = holes > kManyHoles  ? kShareWithGaps
                       : &from == &facing_ ? kShareWithRims
                                           : 1.0;
  const double usual =
      std::clamp(std::sqrt(surface_area(from) / (share * kSurfaceNodes)),
                 largest / kMostVoxelsAlong, largest / (std::sqrt(share) * kLeastVoxelsAlong));
  return std::clamp(usual, kLeastVoxelMm, kMostVoxelMm);
}

/// Whether all triangles lie in the plane of the largest, so that nothing is inside.
bool is_flat(const TriangleMesh& mesh) {
  constexpr double kMostOff = 1e-9;  // of the diagonal
  Vec3 normal;
  Vec3 origin;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3& p = mesh.positions[a];
    const Vec3 twice = cross(mesh.positions[b] - p, mesh.positions[c] - p);
    if (length(twice) <= length(normal)) continue;
    normal = twice;
    origin = p;
  }
  normal = normalized(normal);
  const double most = kMostOff * length(mesh::used_bounds(mesh).size());
  return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
    return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) {
      return std::abs(dot(mesh.positions[v] - origin, normal)) <= most;
    });
  });
}

Result<void> Repair::rebuild(const TriangleMesh& from) {
  if (is_flat(from)) {
    return Error{ErrorKind::bad_input,
                 "the mesh is flat: it encloses nothing; give it a thickness with --thicken"};
  }
  const double voxel = voxel_mm(from);
  auto imported = import_mesh(from, {.voxel_mm = voxel}, progress_);
  if (!imported) return imported.error();
  report_.path = RepairPath::field;
  report_.voxel_mm = voxel;
  mesh_ = extract_surface(imported.value().clay);
  mesh_.normals.clear();
  mesh::drop_small_components(mesh_, kSpeckVoxels * voxel);
  mesh_ = mesh::rounded_to_float(std::move(mesh_));
  report_.verdict = mesh::check_and_collapse_folded(mesh_, std::numeric_limits<double>::infinity(),
                                                    Pace(progress_, "check"));
  return {};
}

/// Corners by their positions, the first one the least, so that equal triangles compare equal.
std::array<std::array<double, 3>, 3> positions_of(const TriangleMesh& mesh, const Triangle& t) {
  std::array<std::array<double, 3>, 3> positions;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3& p = mesh.positions[t[k]];
    positions[k] = {p.x, p.y, p.z};
  }
  std::rotate(positions.begin(), std::min_element(positions.begin(), positions.end()),
              positions.end());
  return positions;
}

/// Which triangles of `of` are in `other`, by their positions, since repair renumbers the vertices;
/// with `is_turned_too` also the other way round.
std::vector<bool> found_in(const TriangleMesh& other, const TriangleMesh& of, bool is_turned_too) {
  std::vector<std::array<std::array<double, 3>, 3>> sorted;
  sorted.reserve(other.triangles.size());
  for (const Triangle& t : other.triangles) {
    sorted.push_back(positions_of(other, t));
    if (is_turned_too) sorted.push_back(positions_of(other, {t[0], t[2], t[1]}));
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<bool> is_found;
  is_found.reserve(of.triangles.size());
  for (const Triangle& t : of.triangles) {
    is_found.push_back(std::binary_search(sorted.begin(), sorted.end(), positions_of(of, t)));
  }
  return is_found;
}

double largest_of(const Vec3& sides) { return std::max({sides.x, sides.y, sides.z}); }

void Repair::measure_change(const Pace& pace) {
  constexpr double kSlack = 1e-4;      // of the largest side
  constexpr double kTolerance = 5e-3;  // the same
  constexpr double kVoxels = 1.5;      // edges that a level set rounds off
  pace.at(0.0);
  report_.given_size_mm = mesh::used_bounds(input_).size();
  const double side = largest_of(report_.given_size_mm);
  const std::vector<bool> is_old = found_in(input_, mesh_, false);
  std::vector<std::uint32_t> changed;
  for (std::uint32_t t = 0; t < is_old.size(); ++t) {
    if (!is_old[t]) changed.push_back(t);
  }
  report_.kept_triangles = static_cast<std::int64_t>(is_old.size() - changed.size());
  const GreatestDistance change =
      greatest_distance(mesh_, changed, input_, kSlack * side, pace.part(0.0, 0.4));
  report_.max_change_mm = change.at_most_mm;
  report_.max_change_slack_mm = change.at_most_mm - change.at_least_mm;
  const double tolerance = std::max(kTolerance * side, kVoxels * report_.voxel_mm);
  // Whoever chooses a voxel is content with the edges that it leaves. Else those of a level set
  // count a little earlier, since what was given may be off itself.
  constexpr double kOfField = 0.8;
  const double usual = kTolerance * side * (report_.path == RepairPath::field ? kOfField : 1.0);
  const double least_loss = options_.voxel_mm > 0.0 ? tolerance : usual;
  pace.at(0.4);
  const std::vector<bool> is_kept = found_in(mesh_, input_, true);
  pace.at(0.4);
  report_.loss = measure_loss(input_, is_kept, mesh_, least_loss, pace.part(0.4, 0.7));
  pace.at(0.7);
  report_.guess = measure_guess(facing_, mesh_, is_old, tolerance, true, pace.part(0.7, 0.9));
  is_contradicted_ = report_.guessed_too_much();
  const double farthest = RepairLoss::kMostTolerances * tolerance;
  // What a level set adds far from all that was given closes an opening, but nobody knows how.
  if (!is_contradicted_ && report_.path == RepairPath::field && report_.max_change_mm > farthest) {
    report_.guess = measure_guess(facing_, mesh_, is_old, farthest, false, pace.part(0.9, 1.0));
  }
}

/// As `mend` found it. What crosses or faces both ways has a volume that nobody can tell so simply.
void Repair::note_given_volume() {
  const mesh::CloseReport& closing = report_.closing;
  const bool is_plain =
      closing.boundary_edges + closing.nonmanifold_edges == 0 &&
      closing.parts_flipped + closing.turned_triangles == 0 && report_.crossings == 0 &&
      report_.united_parts == 0 && report_.interior_faces == 0 &&
      closing.dropped_triangles + report_.dropped_fins + report_.dropped_sheets == 0 &&
      report_.thickened_sheets == 0 && report_.coned_holes == 0 &&
      closing.parts <= report_.verdict.components;
  if (is_plain) report_.given_volume_mm3 = signed_volume(input_);
}

void Repair::compare(const Pace& pace) {
  if (report_.path == RepairPath::nothing) {
    report_.kept_triangles = static_cast<std::int64_t>(mesh_.triangles.size());
    report_.given_size_mm = mesh::used_bounds(input_).size();
  } else {
    measure_change(pace);
  }
  note_given_volume();
}

double farthest_place_mm(const RepairReport& report) {
  double farthest = 0.0;
  for (const auto* places : {&report.loss.places, &report.guess.places}) {
    if (!places->empty()) farthest = std::max(farthest, places->front().distance_mm);
  }
  return farthest;
}

/// Where mending lost or guessed something, a level set may do better: it tells the inside of
/// triangles that close nothing.
Result<void> Repair::rebuild_what_was_lost() {
  TriangleMesh mended = mesh_;
  const RepairReport mended_report = report_;
  const TriangleMesh& from = is_contradicted_ && given_holes() <= kManyHoles ? facing_ : input_;
  if (auto made = rebuild(from); !made) {
    if (made.error().kind == ErrorKind::interrupted) return made.error();
    mesh_ = std::move(mended);
    report_ = mended_report;
    return {};
  }
  compare(Pace(progress_, "compare"));
  const bool is_doubtful = report_.lost_too_much() || report_.guessed_too_much();
  const bool is_better =
      !is_doubtful || farthest_place_mm(report_) < farthest_place_mm(mended_report);
  if (!report_.verdict.printable || !is_better) {
    mesh_ = std::move(mended);
    report_ = mended_report;
  }
  return {};
}

Result<RepairedMesh> Repair::run() {
  auto mended = mesh::mend_mesh(input_, options_.thickening, progress_);
  if (!mended) return mended.error();
  mesh_ = std::move(mended.value().mesh);
  facing_ = std::move(mended.value().facing);
  static_cast<mesh::MendReport&>(report_) = std::move(mended.value().report);
  if (report_.is_changed) report_.path = RepairPath::local;
  if (!report_.verdict.printable) {
    const TriangleMesh from = mesh_.triangles.empty() ? input_ : mesh_;
    if (auto made = rebuild(from); !made) return made.error();
  }
  compare(Pace(progress_, "compare"));
  const bool is_coned = report_.coned_holes > 0 && report_.path == RepairPath::local;
  // With more holes a level set of what was given takes as long as all else together.
  const bool can_ask_given = is_contradicted_ && given_holes() <= kManyHoles;
  if (can_ask_given || (is_coned && report_.lost_too_much())) {
    if (auto tried = rebuild_what_was_lost(); !tried) return tried.error();
  }
  return RepairedMesh{std::move(mesh_), std::move(report_)};
}

}  // namespace

bool RepairReport::covered_too_much() const noexcept {
  return loss.covered_mm3 > kMostCovered * std::abs(verdict.volume_mm3);
}

bool RepairReport::lost_too_much() const noexcept {
  const bool lost_volume =
      given_volume_mm3 && std::abs(verdict.volume_mm3 - *given_volume_mm3) >
                              RepairLoss::kMostShare * std::abs(*given_volume_mm3);
  // Of a level set nothing is as it was: all that it lost beyond the tolerance counts.
  const double deep_tolerances = path == RepairPath::field ? 1.0 : RepairLoss::kMostTolerances;
  const bool is_deep =
      !loss.places.empty() && loss.places.front().distance_mm > deep_tolerances * loss.tolerance_mm;
  return loss.parts > 0 || loss.share > RepairLoss::kMostShare || is_deep || lost_volume ||
         covered_too_much();
}

Result<RepairedMesh> repair_mesh(const TriangleMesh& mesh_mm, const RepairOptions& options,
                                 const Progress& progress) {
  if (!(options.voxel_mm >= 0.0)) {
    return Error{ErrorKind::bad_input, "the voxel is " + std::to_string(options.voxel_mm) +
                                           " mm; must be greater than 0, or 0 for the usual one"};
  }
  return no_throw("repairing the mesh", [&] { return Repair(mesh_mm, options, progress).run(); });
}

}  // namespace argil::io
