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
  double far_area = 0.0;
  std::int64_t samples = 0;
  RepairPlace farthest;
  double covered_mm3 = 0.0;
  RepairPlace deepest;  ///< of these
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
  struct Found {
    double lost_mm = 0.0;     ///< to the result; 0 where it is within the tolerance or has matter
    double covered_mm = 0.0;  ///< below its surface, where that is within the tolerance
  };
  Found at(const Vec3& p, const Vec3& normal, std::uint32_t& hint) const;

  const TriangleMesh& given_;
  const TriangleMesh& result_;
  const double tolerance_mm_;
  const MeshDistance distance_;
  const WindingNumber winding_;
};

LossSampling::Found LossSampling::at(const Vec3& p, const Vec3& normal, std::uint32_t& hint) const {
  constexpr double kAlike = 0.9;    // what only crosses the surface is not covered by it
  constexpr double kAsGood = 0.02;  // of the tolerance: as good as on the surface
  const auto near = distance_.closest(p, tolerance_mm_, hint);
  hint = near.triangle;
  const bool is_near = near.triangle != kNoTriangle;
  if (is_near && near.distance < kAsGood * tolerance_mm_) return {};
  if (winding_.at(p) > 0.5) {
    if (!is_near) return {};
    const Vec3 above = normalized(mesh::area_normal(mesh::corners_of(result_, near.triangle)));
    return {0.0, dot(above, normal) > kAlike ? near.distance : 0.0};
  }
  if (is_near) return {};
  return {distance_.closest(p, std::numeric_limits<double>::infinity()).distance, 0.0};
}

/// By its area: a sliver counts little.
int splits_of(double area, double step_mm) {
  constexpr int kMostSplits = 64;
  return mesh::splits_for(std::sqrt(2.0 * area), step_mm, kMostSplits);
}

/// Samples a triangle; `far_mm(p)` is 0 where all is well.
template <class FarMm>
void sample(const mesh::Corners& corners, double step_mm, const FarMm& far_mm, AtTriangle& found) {
  const int splits = splits_of(found.area, step_mm);
  std::int64_t far_samples = 0;
  mesh::for_each_sample(splits, [&](const std::array<double, 3>& w) {
    const Vec3 p = w[0] * corners[0] + w[1] * corners[1] + w[2] * corners[2];
    const double distance = far_mm(p);
    ++found.samples;
    far_samples += distance > 0.0 ? 1 : 0;
    if (distance > found.farthest.distance_mm) found.farthest = {p, distance};
  });
  found.far_area =
      found.area * static_cast<double>(far_samples) / static_cast<double>(found.samples);
}

AtTriangle LossSampling::look_at(std::size_t t, bool is_kept) const {
  const mesh::Corners corners = mesh::corners_of(given_, t);
  AtTriangle found;
  found.area = mesh::triangle_area(corners);
  if (is_kept || found.area == 0.0) return found;
  std::uint32_t hint = kNoTriangle;
  const Vec3 normal = normalized(mesh::area_normal(corners));
  double covered = 0.0;
  const auto look = [&](const Vec3& p) {
    const Found here = at(p, normal, hint);
    covered += here.covered_mm;
    if (here.covered_mm > found.deepest.distance_mm) found.deepest = {p, here.covered_mm};
    return here.lost_mm;
  };
  sample(corners, tolerance_mm_, look, found);
  found.covered_mm3 = found.area * covered / static_cast<double>(found.samples);
  return found;
}

/// The farthest first, without those beside one that is named.
std::vector<RepairPlace> places_of(std::vector<RepairPlace> all, double apart_mm) {
  constexpr std::size_t kMostPlaces = 10;
  std::stable_sort(all.begin(), all.end(), [](const RepairPlace& a, const RepairPlace& b) {
    return a.distance_mm > b.distance_mm;
  });
  std::vector<RepairPlace> named;
  for (const RepairPlace& place : all) {
    if (named.size() == kMostPlaces) break;
    const bool is_beside = std::any_of(named.begin(), named.end(), [&](const RepairPlace& other) {
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
    double far_area = 0.0;
    Box3 box;
  };
  std::vector<Part> sums(parts.count);
  for (std::size_t t = 0; t < found.size(); ++t) {
    if (parts.of_triangle[t] == mesh::kNoPart) continue;
    Part& part = sums[parts.of_triangle[t]];
    part.area += found[t].area;
    part.far_area += found[t].far_area;
    for (const std::uint32_t v : whole.triangles[t]) part.box.include(whole.positions[v]);
  }
  return std::count_if(sums.begin(), sums.end(), [&](const Part& part) {
    return part.area > 0.0 && part.far_area >= kAllBut * part.area &&
           length(part.box.size()) > kSpeckTolerances * tolerance_mm;
  });
}

/// Asks the surface of a result that is new whether what was given tells of it.
class GuessSampling {
 public:
  GuessSampling(const TriangleMesh& facing, const TriangleMesh& result, double tolerance_mm,
                bool may_close)
      : result_(result),
        tolerance_mm_(tolerance_mm),
        may_close_(may_close),
        distance_(facing.positions, facing.triangles),
        winding_(facing.positions, facing.triangles, kFarRadii) {}

  AtTriangle look_at(std::size_t t, bool is_given) const;

 private:
  static constexpr double kFarRadii = 4.0;

  /// How far away what was given is, 0 where that is within the tolerance or tells of a surface.
  double guessed_mm(const Vec3& p, std::uint32_t& hint) const;

  const TriangleMesh& result_;
  const double tolerance_mm_;
  const bool may_close_;
  const MeshDistance distance_;
  const WindingNumber winding_;
};

double GuessSampling::guessed_mm(const Vec3& p, std::uint32_t& hint) const {
  constexpr double kDoubt = 0.25;
  const auto near = distance_.closest(p, tolerance_mm_, hint);
  hint = near.triangle;
  if (near.triangle != kNoTriangle) return 0.0;
  if (may_close_ && std::abs(winding_.at(p) - 0.5) <= kDoubt) return 0.0;
  return distance_.closest(p, std::numeric_limits<double>::infinity()).distance;
}

AtTriangle GuessSampling::look_at(std::size_t t, bool is_given) const {
  const mesh::Corners corners = mesh::corners_of(result_, t);
  AtTriangle found;
  found.area = mesh::triangle_area(corners);
  if (is_given || found.area == 0.0) return found;
  std::uint32_t hint = kNoTriangle;
  sample(
      corners, tolerance_mm_, [&](const Vec3& p) { return guessed_mm(p, hint); }, found);
  return found;
}

/// Looks at all triangles, in blocks of so many samples between which it can be stopped.
template <class LookAt>
std::vector<AtTriangle> at_all(const TriangleMesh& mesh, double step_mm, const Pace& pace,
                               const LookAt& look_at) {
  constexpr std::int64_t kAtATime = 1 << 14;
  const std::size_t count = mesh.triangles.size();
  std::vector<AtTriangle> found(count);
  for (std::size_t begin = 0, end = 0; begin < count; begin = end) {
    pace.at(static_cast<double>(begin) / static_cast<double>(count));
    for (std::int64_t samples = 0; end < count && samples < kAtATime; ++end) {
      const std::int64_t splits =
          splits_of(mesh::triangle_area(mesh::corners_of(mesh, end)), step_mm);
      samples += splits * splits;
    }
    tbb::parallel_for(begin, end, [&](std::size_t t) { found[t] = look_at(t); });
  }
  return found;
}

/// Share of the area, samples and places.
template <class Sum>
void sum_up(const std::vector<AtTriangle>& found, Sum& sum) {
  constexpr double kApartTolerances = 10.0;
  double area = 0.0;
  double far_area = 0.0;
  std::vector<RepairPlace> places;
  for (const AtTriangle& at : found) {
    area += at.area;
    far_area += at.far_area;
    sum.samples += at.samples;
    if (at.farthest.distance_mm > 0.0) places.push_back(at.farthest);
  }
  if (places.empty()) return;
  sum.share = far_area / area;
  sum.places = places_of(std::move(places), kApartTolerances * sum.tolerance_mm);
}

}  // namespace

RepairLoss measure_loss(const TriangleMesh& given, const std::vector<bool>& is_kept,
                        const TriangleMesh& result, double tolerance_mm, const Pace& pace) {
  assert(is_kept.size() == given.triangles.size() && tolerance_mm > 0.0);
  const LossSampling sampling(given, result, tolerance_mm);
  const auto found = at_all(given, tolerance_mm, pace,
                            [&](std::size_t t) { return sampling.look_at(t, is_kept[t]); });
  RepairLoss loss;
  loss.tolerance_mm = tolerance_mm;
  sum_up(found, loss);
  if (!loss.places.empty()) loss.parts = count_lost_parts(given, found, tolerance_mm);
  RepairPlace deepest;
  for (const AtTriangle& at : found) {
    loss.covered_mm3 += at.covered_mm3;
    if (at.deepest.distance_mm > deepest.distance_mm) deepest = at.deepest;
  }
  const bool is_much = loss.covered_mm3 > kMostCovered * std::abs(signed_volume(result));
  if (is_much && loss.places.empty()) loss.places.push_back(deepest);
  return loss;
}

RepairGuess measure_guess(const TriangleMesh& facing, const TriangleMesh& result,
                          const std::vector<bool>& is_given, double tolerance_mm, bool may_close,
                          const Pace& pace) {
  assert(is_given.size() == result.triangles.size() && tolerance_mm > 0.0);
  const GuessSampling sampling(facing, result, tolerance_mm, may_close);
  RepairGuess guess;
  guess.tolerance_mm = tolerance_mm;
  sum_up(at_all(result, tolerance_mm, pace,
                [&](std::size_t t) { return sampling.look_at(t, is_given[t]); }),
         guess);
  return guess;
}

}  // namespace argil::io
