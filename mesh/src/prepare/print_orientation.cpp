// SPDX-License-Identifier: GPL-3.0-or-later
// The search for the cheapest orientations: many candidates on a coarse copy, the best refined, and
// measured again on the mesh itself.
#include "argil/mesh/print_orientation.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include <tbb/parallel_for.h>

#include "argil/mesh/compact.h"
#include "argil/mesh/triangle_geometry.h"

#include "prepare/resting.h"
#include "prepare/sphere.h"
#include "prepare/standing.h"

namespace argil::mesh {
namespace {

constexpr std::size_t kAround = 200;    ///< directions all around
constexpr std::size_t kFacings = 32;    ///< largest facings
constexpr std::size_t kRefined = 12;    ///< candidates that are refined
constexpr double kApartCosine = 0.906;  ///< of 25 degrees
constexpr double kSameCosine = 0.9998;  ///< of one degree

/// The mesh with its vertices joined in the cells of a grid: closed where it was, small parts gone.
TriangleMesh coarse_copy(const TriangleMesh& mesh, double cell) {
  using Cell = std::array<std::int64_t, 3>;
  const Vec3 low = bounds(mesh).min;
  std::map<Cell, std::uint32_t> numbers;
  std::vector<double> counts;
  TriangleMesh coarse;
  std::vector<std::uint32_t> number_of;
  number_of.reserve(mesh.positions.size());
  for (const Vec3& p : mesh.positions) {
    Cell at{};
    for (std::size_t a = 0; a < 3; ++a) {
      at[a] = static_cast<std::int64_t>(std::floor((p[a] - low[a]) / cell));
    }
    const auto next = static_cast<std::uint32_t>(coarse.positions.size());
    const auto [found, is_new] = numbers.emplace(at, next);
    if (is_new) {
      coarse.positions.emplace_back();
      counts.push_back(0.0);
    }
    coarse.positions[found->second] += p;
    counts[found->second] += 1.0;
    number_of.push_back(found->second);
  }
  for (std::size_t v = 0; v < counts.size(); ++v) coarse.positions[v] *= 1.0 / counts[v];
  for (const Triangle& t : mesh.triangles) {
    const Triangle to{number_of[t[0]], number_of[t[1]], number_of[t[2]]};
    if (to[0] != to[1] && to[1] != to[2] && to[2] != to[0]) coarse.triangles.push_back(to);
  }
  return coarse;
}

/// Opposite to the directions that most of the surface faces: those sides down.
std::vector<Vec3> largest_facings(const TriangleMesh& mesh) {
  std::map<std::array<int, 3>, Vec3> bins;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 normal = area_normal(corners_of(mesh, t));
    const Vec3 n = normalized(normal);
    constexpr double kBins = 10.0;  // some 6 degrees
    bins[{static_cast<int>(std::lround(kBins * n.x)), static_cast<int>(std::lround(kBins * n.y)),
          static_cast<int>(std::lround(kBins * n.z))}] += normal;
  }
  std::vector<Vec3> sums;
  for (const auto& [bin, sum] : bins) sums.push_back(sum);
  std::stable_sort(sums.begin(), sums.end(),
                   [](const Vec3& a, const Vec3& b) { return dot(a, a) > dot(b, b); });
  std::vector<Vec3> ups;
  for (const Vec3& sum : sums) {
    if (ups.size() < kFacings && length(sum) > 0.0) ups.push_back(-normalized(sum));
  }
  return ups;
}

void add_if_new(std::vector<Vec3>& ups, const Vec3& up) {
  for (const Vec3& other : ups) {
    if (dot(other, up) > kSameCosine) return;
  }
  ups.push_back(up);
}

class Search {
 public:
  Search(const StandingPiece& piece, const OrientationOptions& options)
      : piece_(piece), options_(options) {}

  std::vector<Vec3> candidates() const;
  std::vector<PrintOrientation> measured(const std::vector<Vec3>& ups, const Pace& pace) const;
  PrintOrientation refined(PrintOrientation from) const;

 private:
  const StandingPiece& piece_;
  const OrientationOptions& options_;
};

std::vector<Vec3> Search::candidates() const {
  const TriangleMesh& mesh = piece_.mesh();
  // As it stands first: of equal ones it wins.
  std::vector<Vec3> ups{{0.0, 0.0, 1.0}};
  for (const Vec3& up : largest_facings(mesh)) add_if_new(ups, up);
  for (std::size_t i = 0; i < kAround; ++i) add_if_new(ups, direction_around(i, kAround));
  const std::vector<Vec3> put_down = ups;
  std::vector<Vec3> rested(put_down.size());
  tbb::parallel_for(std::size_t{0}, put_down.size(), [&](std::size_t i) {
    rested[i] = rested_up(mesh.positions, piece_.centre_of_mass(), put_down[i]);
  });
  for (const Vec3& up : rested) add_if_new(ups, up);
  return ups;
}

std::vector<PrintOrientation> Search::measured(const std::vector<Vec3>& ups,
                                               const Pace& pace) const {
  constexpr std::size_t kAtOnce = 16;
  std::vector<PrintOrientation> found(ups.size());
  for (std::size_t first = 0; first < ups.size(); first += kAtOnce) {
    pace.at(static_cast<double>(first) / static_cast<double>(ups.size()));
    tbb::parallel_for(first, std::min(first + kAtOnce, ups.size()),
                      [&](std::size_t i) { found[i] = piece_.measure(ups[i], options_); });
  }
  return found;
}

/// Steps to the cheapest of six neighbours, half as far when none is cheaper.
PrintOrientation Search::refined(PrintOrientation best) const {
  constexpr double kFirstStep = 0.14;  // 8 degrees
  constexpr double kLastStep = 0.017;
  constexpr std::array<std::pair<double, double>, 6> kSides{
      {{1.0, 0.0}, {0.5, 0.866}, {-0.5, 0.866}, {-1.0, 0.0}, {-0.5, -0.866}, {0.5, -0.866}}};
  for (double step = kFirstStep; step > kLastStep;) {
    const Vec3 any = std::abs(best.up.x) < 0.6 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
    const Vec3 u = normalized(cross(best.up, any));
    const Vec3 v = cross(best.up, u);
    const PrintOrientation from = best;
    for (const auto& [x, y] : kSides) {
      const PrintOrientation at =
          piece_.measure(normalized(from.up + step * (x * u + y * v)), options_);
      if (at.cost < best.cost) best = at;
    }
    if (!(best.cost < from.cost)) step *= 0.5;
  }
  return best;
}

void sort_by_cost(std::vector<PrintOrientation>& found) {
  std::stable_sort(
      found.begin(), found.end(),
      [](const PrintOrientation& a, const PrintOrientation& b) { return a.cost < b.cost; });
}

/// The first `count` that are that far from all before them.
std::vector<PrintOrientation> apart(const std::vector<PrintOrientation>& sorted,
                                    std::size_t count) {
  std::vector<PrintOrientation> kept;
  for (const PrintOrientation& each : sorted) {
    const bool is_near = std::any_of(kept.begin(), kept.end(), [&](const PrintOrientation& other) {
      return dot(other.up, each.up) > kApartCosine;
    });
    if (!is_near && kept.size() < count) kept.push_back(each);
  }
  return kept;
}

std::vector<Vec3> ups_of(const std::vector<PrintOrientation>& found) {
  std::vector<Vec3> ups;
  for (const PrintOrientation& each : found) ups.push_back(each.up);
  return ups;
}

}  // namespace

std::vector<PrintOrientation> best_orientations(const TriangleMesh& mesh,
                                                const OrientationOptions& options,
                                                std::size_t count, const Pace& pace) {
  assert(count >= 1 && !mesh.triangles.empty());
  constexpr double kCells = 80.0;
  constexpr std::size_t kFewTriangles = 25'000;
  const TriangleMesh coarse = mesh.triangles.size() <= kFewTriangles
                                  ? compacted(mesh)
                                  : coarse_copy(mesh, length(bounds(mesh).size()) / kCells);
  const StandingPiece rough(coarse, pace.part(0.0, 0.1));
  const Search search(rough, options);
  std::vector<PrintOrientation> found = search.measured(search.candidates(), pace.part(0.1, 0.5));
  sort_by_cost(found);
  std::vector<PrintOrientation> best = apart(found, kRefined);
  // Before refinement too: flat sides of the mesh itself are exact, those of the copy nearly.
  std::vector<PrintOrientation> refined(best.size());
  pace.at(0.5);
  tbb::parallel_for(std::size_t{0}, best.size(),
                    [&](std::size_t i) { refined[i] = search.refined(best[i]); });
  best.insert(best.end(), refined.begin(), refined.end());
  const StandingPiece whole(mesh, pace.part(0.7, 0.8));
  const Search final_search(whole, options);
  std::vector<Vec3> ups = ups_of(best);
  for (std::size_t i = 0; i < best.size(); ++i) {
    ups.push_back(rested_up(mesh.positions, whole.centre_of_mass(), best[i].up));
  }
  found = final_search.measured(ups, pace.part(0.8, 1.0));
  sort_by_cost(found);
  return apart(found, count);
}

PrintOrientation orientation_at(const TriangleMesh& mesh, const Vec3& up,
                                const OrientationOptions& options, const Pace& pace) {
  return StandingPiece(mesh, pace).measure(up, options);
}

Vec3 laid_flat(const TriangleMesh& mesh, const Vec3& up) {
  return rested_up(mesh.positions, centre_of_mass(mesh), up);
}

}  // namespace argil::mesh
