// SPDX-License-Identifier: GPL-3.0-or-later
#include "convert/repair_loss.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <tbb/parallel_for.h>

#include "argil/core/winding_number.h"
#include "argil/engine/mesh_distance.h"
#include "argil/mesh/compact.h"
#include "argil/mesh/edges.h"
#include "argil/mesh/triangle_geometry.h"

namespace argil::io {
namespace {

/// What was found at one triangle.
struct AtTriangle {
  double area = 0.0;
  double lost_area = 0.0;
  std::int64_t samples = 0;
  LostPlace farthest;
};

class LossSampling {
 public:
  LossSampling(const TriangleMesh& given, const TriangleMesh& result, double tolerance_mm)
      : given_(given),
        result_(result),
        tolerance_mm_(tolerance_mm),
        distance_(result.positions, result.triangles),
        winding_(result.positions, result.triangles) {}

  AtTriangle look_at(std::size_t t, bool is_kept) const;

 private:
  /// How far away the result is, 0 where it is within the tolerance or has matter.
  double lost_mm(const Vec3& p, std::uint32_t& hint) const;

  const TriangleMesh& given_;
  const TriangleMesh& result_;
  const double tolerance_mm_;
  const MeshDistance distance_;
  const WindingNumber winding_;
};

double LossSampling::lost_mm(const Vec3& p, std::uint32_t& hint) const {
  const auto near = distance_.closest(p, tolerance_mm_, hint);
  hint = near.triangle;
  if (near.triangle != kNoTriangle || winding_.at(p) > 0.5) return 0.0;
  return distance_.closest(p, std::numeric_limits<double>::infinity()).distance;
}

AtTriangle LossSampling::look_at(std::size_t t, bool is_kept) const {
  constexpr int kMostSplits = 64;
  const mesh::Corners corners = mesh::corners_of(given_, t);
  AtTriangle found;
  found.area = 0.5 * length(mesh::area_normal(corners));
  if (is_kept || found.area == 0.0) return found;
  // By its area: a sliver that is lost is little.
  const int splits = mesh::splits_for(std::sqrt(2.0 * found.area), tolerance_mm_, kMostSplits);
  std::uint32_t hint = kNoTriangle;
  std::int64_t lost = 0;
  mesh::for_each_sample(splits, [&](const std::array<double, 3>& w) {
    const Vec3 p = w[0] * corners[0] + w[1] * corners[1] + w[2] * corners[2];
    const double far_mm = lost_mm(p, hint);
    ++found.samples;
    lost += far_mm > 0.0 ? 1 : 0;
    if (far_mm > found.farthest.distance_mm) found.farthest = {p, far_mm};
  });
  found.lost_area = found.area * static_cast<double>(lost) / static_cast<double>(found.samples);
  return found;
}

/// The farthest first, without those beside one that is named.
std::vector<LostPlace> places_of(std::vector<LostPlace> all, double apart_mm) {
  constexpr std::size_t kMostPlaces = 10;
  std::stable_sort(all.begin(), all.end(), [](const LostPlace& a, const LostPlace& b) {
    return a.distance_mm > b.distance_mm;
  });
  std::vector<LostPlace> named;
  for (const LostPlace& place : all) {
    if (named.size() == kMostPlaces) break;
    const bool is_beside = std::any_of(named.begin(), named.end(), [&](const LostPlace& other) {
      return length(other.at_mm - place.at_mm) < apart_mm;
    });
    if (!is_beside) named.push_back(place);
  }
  return named;
}

/// Of nine tenths of whose area nothing is left; not those smaller than a few tolerances.
std::int64_t count_lost_parts(const TriangleMesh& given, const std::vector<AtTriangle>& found,
                              double tolerance_mm) {
  constexpr double kAllBut = 0.9;
  constexpr double kSpeckTolerances = 4.0;
  const TriangleMesh whole = mesh::welded(given);
  const mesh::MeshParts parts = mesh::mesh_parts(whole, mesh::EdgeTable(whole), false);
  struct Part {
    double area = 0.0;
    double lost_area = 0.0;
    Box3 box;
  };
  std::vector<Part> sums(parts.count);
  for (std::size_t t = 0; t < found.size(); ++t) {
    if (parts.of_triangle[t] == mesh::kNoPart) continue;
    Part& part = sums[parts.of_triangle[t]];
    part.area += found[t].area;
    part.lost_area += found[t].lost_area;
    for (const std::uint32_t v : whole.triangles[t]) part.box.include(whole.positions[v]);
  }
  return std::count_if(sums.begin(), sums.end(), [&](const Part& part) {
    return part.area > 0.0 && part.lost_area >= kAllBut * part.area &&
           length(part.box.size()) > kSpeckTolerances * tolerance_mm;
  });
}

}  // namespace

RepairLoss measure_loss(const TriangleMesh& given, const std::vector<bool>& is_kept,
                        const TriangleMesh& result, double tolerance_mm, const Pace& pace) {
  constexpr std::size_t kAtATime = 4096;
  constexpr double kApartTolerances = 10.0;
  assert(is_kept.size() == given.triangles.size() && tolerance_mm > 0.0);
  const LossSampling sampling(given, result, tolerance_mm);
  std::vector<AtTriangle> found(given.triangles.size());
  for (std::size_t begin = 0; begin < found.size(); begin += kAtATime) {
    pace.at(static_cast<double>(begin) / static_cast<double>(found.size()));
    tbb::parallel_for(begin, std::min(begin + kAtATime, found.size()),
                      [&](std::size_t t) { found[t] = sampling.look_at(t, is_kept[t]); });
  }
  RepairLoss loss;
  loss.tolerance_mm = tolerance_mm;
  double area = 0.0;
  double lost_area = 0.0;
  std::vector<LostPlace> places;
  for (const AtTriangle& at : found) {
    area += at.area;
    lost_area += at.lost_area;
    loss.samples += at.samples;
    if (at.farthest.distance_mm > 0.0) places.push_back(at.farthest);
  }
  if (places.empty()) return loss;
  loss.share = lost_area / area;
  loss.parts = count_lost_parts(given, found, tolerance_mm);
  loss.places = places_of(std::move(places), kApartTolerances * tolerance_mm);
  return loss;
}

}  // namespace argil::io
