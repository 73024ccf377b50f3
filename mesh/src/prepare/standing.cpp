// SPDX-License-Identifier: GPL-3.0-or-later
// What an orientation costs: areas and contact exact from the triangles, supports by vertical
// lines.
#include "prepare/standing.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "argil/mesh/compact.h"
#include "argil/mesh/triangle_geometry.h"

#include "prepare/columns.h"
#include "prepare/flat_hull.h"
#include "prepare/section.h"
#include "prepare/sphere.h"

namespace argil::mesh {
namespace {

/// Lines for supports along the diagonal.
constexpr double kLines = 128.0;

/// The overhangs of a mesh, z up, and what holds them.
class Supports {
 public:
  Supports(const TriangleMesh& mesh, const std::vector<double>& exposure, double floor,
           double max_overhang_deg)
      : mesh_(mesh), exposure_(exposure), floor_(floor) {
    assert(max_overhang_deg > 0.0 && max_overhang_deg < 90.0);
    least_ = std::sin(max_overhang_deg * std::numbers::pi / 180.0);
  }

  void measure(double pitch, PrintOrientation& into) {
    is_overhang_.assign(mesh_.triangles.size(), false);
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) add_overhang(t, into);
    if (into.overhang_mm2 == 0.0) return;
    const Columns columns(mesh_, pitch);
    const std::size_t count =
        static_cast<std::size_t>(columns.columns()) * static_cast<std::size_t>(columns.rows());
    for (std::size_t c = 0; c < count; ++c) add_supports(columns.solid(c), pitch * pitch, into);
  }

 private:
  void add_overhang(std::size_t t, PrintOrientation& into) {
    const Corners c = corners_of(mesh_, t);
    if (std::max({c[0].z, c[1].z, c[2].z}) <= floor_) return;
    const Vec3 normal = area_normal(c);
    const double twice = length(normal);
    if (!(-normal.z > least_ * twice)) return;
    is_overhang_[t] = true;
    into.overhang_mm2 += 0.5 * twice;
    into.scars_mm2 += 0.5 * twice * exposure_[t];
  }

  /// Down from each overhang to what it would stand on.
  void add_supports(std::span<const SolidSpan> solid, double area, PrintOrientation& into) const {
    double below = floor_;
    const SolidSpan* under = nullptr;
    for (const SolidSpan& span : solid) {
      if (is_overhang_[span.low_triangle] && span.low > below) {
        into.support_mm3 += area * (span.low - below);
        if (under != nullptr) into.scars_mm2 += area * exposure_[under->high_triangle];
      }
      if (span.high <= floor_) continue;
      below = span.high;
      under = &span;
    }
  }

  const TriangleMesh& mesh_;
  const std::vector<double>& exposure_;
  double floor_;  ///< what is lower stands on the bed or is cut off
  double least_ = 0.0;
  std::vector<bool> is_overhang_;
};

/// What stands on the bed: the section a little above it.
BedContact contact_at(const TriangleMesh& mesh, double z, const Vec3& centre) {
  BedContact contact;
  std::vector<Vec3> ends;
  for (const Triangle& t : mesh.triangles) {
    const auto segment =
        section_of({mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]}, z);
    if (!segment) continue;
    // About the centre, so that far from the origin no digits are lost.
    contact.area_mm2 += 0.5 * cross(segment->from - centre, segment->to - centre).z;
    ends.push_back(segment->from);
  }
  contact.footing_mm = depth_within(flat_hull(std::move(ends)), centre);
  return contact;
}

double cost_of(const PrintOrientation& o, const OrientationWeights& w, double area, double volume,
               double diagonal) {
  const double width = std::sqrt(std::max(0.0, o.contact_mm2));
  const double wanted_footing = 0.05 * o.height_mm;
  const double narrow = std::clamp(1.0 - width / (0.25 * diagonal), 0.0, 1.0);
  const double tips = std::clamp(1.0 - o.footing_mm / wanted_footing, 0.0, 1.0);
  return w.overhang * o.overhang_mm2 / area + w.scars * o.scars_mm2 / area +
         w.support * o.support_mm3 / volume + w.height * o.height_mm / diagonal +
         w.contact * narrow + w.tipping * tips;
}

/// Of each vertex whether it lies on what a camera above sees.
void add_seen(const TriangleMesh& mesh, const Vec3& toward, std::vector<double>& seen,
              std::vector<double>& asked) {
  const TriangleMesh turned = turned_up(mesh, toward);
  const double pitch = length(bounds(turned).size()) / kLines;
  const Columns columns(turned, pitch);
  for (std::size_t t = 0; t < turned.triangles.size(); ++t) {
    const Corners c = corners_of(turned, t);
    const Vec3 normal = area_normal(c);
    // What is seen at a flat angle says little, and its neighbours stand before it.
    constexpr double kFlattest = 0.3;
    if (!(normal.z > kFlattest * length(normal))) continue;
    asked[t] += 1.0;
    const Vec3 at = middle(c);
    const auto solid = columns.solid(columns.nearest(at));
    // The slope within a pitch to the nearest line.
    if (solid.empty() || at.z >= solid.back().high - 3.0 * pitch) seen[t] += 1.0;
  }
}

}  // namespace

Vec3 centre_of_mass(const TriangleMesh& mesh) {
  const Vec3 o = bounds(mesh).center();
  Vec3 sum;
  double six_volumes = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.positions[t[0]] - o;
    const Vec3 b = mesh.positions[t[1]] - o;
    const Vec3 c = mesh.positions[t[2]] - o;
    const double v = dot(a, cross(b, c));
    six_volumes += v;
    sum += v * (a + b + c) / 4.0;
  }
  return six_volumes > 0.0 ? o + sum / six_volumes : o;
}

Quat turn_up(const Vec3& up) noexcept {
  // Half way between both; of opposite ones any turn by half will do.
  if (up.z < -1.0 + 1e-12) return {0.0, 1.0, 0.0, 0.0};
  const Vec3 axis = cross(up, Vec3{0.0, 0.0, 1.0});
  return normalized(Quat{1.0 + up.z, axis.x, axis.y, axis.z});
}

TriangleMesh turned_up(const TriangleMesh& mesh, const Vec3& up) {
  TriangleMesh turned;
  turned.triangles = mesh.triangles;
  turned.positions.reserve(mesh.positions.size());
  const Quat turn = turn_up(up);
  for (const Vec3& p : mesh.positions) turned.positions.push_back(rotate(turn, p));
  return turned;
}

std::vector<double> exposure(const TriangleMesh& mesh, const Pace& pace) {
  constexpr std::size_t kDirections = 48;
  std::vector<double> seen(mesh.triangles.size(), 0.0);
  std::vector<double> asked(mesh.triangles.size(), 0.0);
  for (std::size_t d = 0; d < kDirections; ++d) {
    pace.at(static_cast<double>(d) / kDirections);
    add_seen(mesh, direction_around(d, kDirections), seen, asked);
  }
  for (std::size_t t = 0; t < seen.size(); ++t) seen[t] = asked[t] > 0.0 ? seen[t] / asked[t] : 0.0;
  return seen;
}

StandingPiece::StandingPiece(const TriangleMesh& mesh, const Pace& pace)
    : mesh_(mesh),
      centre_(mesh::centre_of_mass(mesh)),
      area_(surface_area(mesh)),
      volume_(std::max(signed_volume(mesh), std::numeric_limits<double>::min())),
      diagonal_(length(used_bounds(mesh).size())),
      exposure_(exposure(mesh, pace)) {
  assert(!mesh.triangles.empty() && area_ > 0.0);
}

PrintOrientation StandingPiece::measure(const Vec3& up, const OrientationOptions& options) const {
  assert(std::abs(length(up) - 1.0) < 1e-6);
  const TriangleMesh turned = turned_up(mesh_, up);
  const Box3 box = used_bounds(turned);
  PrintOrientation found;
  found.up = up;
  found.height_mm = std::max(0.0, box.size().z - options.cut_mm);
  const BedContact contact = contact_at(
      turned, box.min.z + std::max(options.cut_mm, 0.5 * kOnBedMm), rotate(turn_up(up), centre_));
  found.contact_mm2 = contact.area_mm2;
  found.footing_mm = contact.footing_mm;
  Supports supports(turned, exposure_, box.min.z + std::max(options.cut_mm, kOnBedMm),
                    options.max_overhang_deg);
  supports.measure(diagonal_ / kLines, found);
  found.cost = cost_of(found, options.weights, area_, volume_, diagonal_);
  return found;
}

BedContact bed_contact(const TriangleMesh& mesh, double cut_mm) {
  const double z = used_bounds(mesh).min.z + std::max(cut_mm, 0.5 * kOnBedMm);
  return contact_at(mesh, z, centre_of_mass(mesh));
}

}  // namespace argil::mesh
