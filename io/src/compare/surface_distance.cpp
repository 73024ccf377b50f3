// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/surface_distance.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <string_view>
#include <thread>

#include <tbb/parallel_for.h>

#include "argil/core/closest_on_triangle.h"
#include "argil/engine/mesh_distance.h"
#include "argil/mesh/triangle_geometry.h"

#include "compare/best_first.h"

namespace argil::io {
namespace {

using Closest = MeshDistance::Closest;

/// Of the distance found: far away much of a surface is nearly as far.
constexpr double kSlackShare = 0.02;

/// A triangle and what is closest to its corners.
struct AskedTriangle {
  mesh::Corners corners;
  std::array<Closest, 3> closest;

  double least_mm() const noexcept {
    return std::max({closest[0].distance, closest[1].distance, closest[2].distance});
  }
};

class SurfaceDistance {
 public:
  explicit SurfaceDistance(const TriangleMesh& to)
      : to_(to), distance_(to.positions, to.triangles) {}

  AskedTriangle asked(const mesh::Corners& corners) const {
    AskedTriangle result{corners, {}};
    std::uint32_t hint = kNoTriangle;
    for (std::size_t k = 0; k < 3; ++k) {
      result.closest[k] = closest(corners[k], hint);
      hint = result.closest[k].triangle;
    }
    return result;
  }
  /// No point of the triangle is farther: it is no farther from any one triangle than its corners.
  double most_mm(const AskedTriangle& asked) const;
  /// The greatest distance within the triangle, to `slack_mm`, where it is more than `found_mm`.
  /// `hear()` is called now and then and says whether to stop.
  template <class Hear>
  double refined(const AskedTriangle& asked, double found_mm, double slack_mm,
                 const Hear& hear) const;

 private:
  Closest closest(const Vec3& p, std::uint32_t hint) const {
    return distance_.closest(p, std::numeric_limits<double>::infinity(), hint);
  }

  const TriangleMesh& to_;
  const MeshDistance distance_;
};

double SurfaceDistance::most_mm(const AskedTriangle& asked) const {
  // The middle may be on a triangle that has a corner in common with others only.
  const std::array<std::uint32_t, 4> near{
      asked.closest[0].triangle, asked.closest[1].triangle, asked.closest[2].triangle,
      closest(mesh::middle(asked.corners), asked.closest[0].triangle).triangle};
  double most = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < near.size(); ++n) {
    if (std::find(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(n), near[n]) !=
        near.begin() + static_cast<std::ptrdiff_t>(n)) {
      continue;
    }
    const auto [a, b, c] = mesh::corners_of(to_, near[n]);
    double farthest = 0.0;
    for (const Vec3& p : asked.corners) {
      farthest = std::max(farthest, length(p - closest_on_triangle(p, a, b, c)));
    }
    most = std::min(most, farthest);
  }
  return most;
}

template <class Hear>
double SurfaceDistance::refined(const AskedTriangle& asked, double found_mm, double slack_mm,
                                const Hear& hear) const {
  constexpr std::size_t kAtATime = 4096;  // some tens of milliseconds
  assert(slack_mm > 0.0);
  std::vector<AskedTriangle> open{asked};
  for (std::size_t n = 1; !open.empty(); ++n) {
    if (n % kAtATime == 0 && hear()) break;
    const AskedTriangle now = open.back();
    open.pop_back();
    found_mm = std::max(found_mm, now.least_mm());
    if (most_mm(now) <= found_mm + slack_mm) continue;
    std::size_t longest = 0;
    const auto side = [&](std::size_t k) {
      return length(now.corners[(k + 1) % 3] - now.corners[k]);
    };
    for (std::size_t k = 1; k < 3; ++k) longest = side(k) > side(longest) ? k : longest;
    const std::size_t next = (longest + 1) % 3;
    const Vec3 middle = 0.5 * (now.corners[longest] + now.corners[next]);
    const Closest at_middle = closest(middle, now.closest[longest].triangle);
    for (const std::size_t moved : {longest, next}) {
      open.push_back(now);
      open.back().corners[moved] = middle;
      open.back().closest[moved] = at_middle;
    }
  }
  return found_mm;
}

/// Hears a stop while others work too: only the thread that began may ask, the others see what it
/// heard.
class StopHeard {
 public:
  explicit StopHeard(const Pace& pace) : pace_(pace) {}

  void at(double fraction) {
    now_ = fraction;
    pace_.at(fraction);
  }
  /// Throws Interrupted on the thread that began.
  bool hear() {
    if (std::this_thread::get_id() == owner_) {
      try {
        pace_.at(now_);
      } catch (const Interrupted&) {
        is_stopped_ = true;
        throw;
      }
    }
    return is_stopped_;
  }

 private:
  const Pace& pace_;
  const std::thread::id owner_ = std::this_thread::get_id();
  double now_ = 0.0;
  std::atomic<bool> is_stopped_ = false;
};

}  // namespace

GreatestDistance greatest_distance(const TriangleMesh& from,
                                   const std::vector<std::uint32_t>& triangles,
                                   const TriangleMesh& to, double slack_mm, const Pace& pace) {
  assert(!to.triangles.empty());
  if (triangles.empty()) return {};
  const SurfaceDistance surface(to);
  std::vector<AskedTriangle> asked(triangles.size());
  std::vector<double> most(triangles.size());
  constexpr std::size_t kAtATime = 16'384;
  for (std::size_t begin = 0; begin < triangles.size(); begin += kAtATime) {
    pace.at(0.5 * static_cast<double>(begin) / static_cast<double>(triangles.size()));
    tbb::parallel_for(begin, std::min(begin + kAtATime, triangles.size()), [&](std::size_t n) {
      asked[n] = surface.asked(mesh::corners_of(from, triangles[n]));
      most[n] = surface.most_mm(asked[n]);
    });
  }
  double found = 0.0;
  for (const AskedTriangle& one : asked) found = std::max(found, one.least_mm());
  slack_mm = std::max(slack_mm, kSlackShare * found);
  const double first_most = *std::max_element(most.begin(), most.end());
  if (first_most <= found) return {found, found};
  std::vector<float> bounds;
  for (const double of : most) {
    bounds.push_back(rounded_up(of - slack_mm));
  }
  StopHeard stop(pace);
  const Progress tell = [&](std::string_view, double fraction) {
    stop.at(0.5 + 0.5 * fraction);
    return true;
  };
  const auto refine = [&](std::uint32_t n, double known) {
    return surface.refined(asked[n], known, slack_mm, [&] { return stop.hear(); });
  };
  found = greatest_by_bound(bounds, found, Pace(tell, ""), [&] { return refine; });
  return {found, std::min(first_most, found + slack_mm)};
}

GreatestDistance greatest_distance(const TriangleMesh& from, const TriangleMesh& to,
                                   double slack_mm) {
  std::vector<std::uint32_t> all(from.triangles.size());
  std::iota(all.begin(), all.end(), 0U);
  const Progress nobody;
  return greatest_distance(from, all, to, slack_mm, Pace(nobody, ""));
}

}  // namespace argil::io
