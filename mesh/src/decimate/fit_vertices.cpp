// SPDX-License-Identifier: GPL-3.0-or-later
#include "decimate/fit_vertices.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "argil/mesh/triangle_geometry.h"

#include "decimate/quadric.h"

namespace argil::mesh {
namespace {

constexpr int kSweeps = 4;
constexpr int kMostFitSplits = 8;

/// What the samples of one triangle ask of its corners: each corner's step minimises a quadric.
struct Wishes {
  std::array<Quadric, 3> corner;
};

/// Runs `work(begin, end)` over pieces of all that is to be done, and hears an interruption between
/// some of them.
template <class Work>
void in_fit_pieces(std::size_t count, const Pace& pace, const Work& work) {
  constexpr std::size_t kPiece = 1024;
  constexpr std::size_t kAtATime = 32 * kPiece;  // some 100 ms where they ask the field
  for (std::size_t first = 0; first < count; first += kAtATime) {
    pace.at(static_cast<double>(first) / static_cast<double>(count));
    const tbb::blocked_range<std::size_t> range(first, std::min(count, first + kAtATime), kPiece);
    tbb::parallel_for(range, [&](const auto& r) { work(r.begin(), r.end()); });
  }
}

class Fit {
 public:
  Fit(TriangleMesh& mesh, const DecimationTarget& target, const std::vector<bool>& fixed)
      : mesh_(mesh), target_(target), fixed_(fixed) {
    assert(fixed.size() == mesh.positions.size());
    find_triangles_around();
  }
  void sweep(const Pace& pace);

 private:
  void find_triangles_around();
  void ask_field(const Pace& pace);
  Wishes wishes_of(const Triangle& t, DistanceProbe& field) const;
  std::vector<Vec3> moved(const Pace& pace) const;
  void keep_shape(std::vector<Vec3>& moved, const Pace& pace) const;
  bool is_worse(std::size_t t, const std::vector<Vec3>& moved) const;

  TriangleMesh& mesh_;
  const DecimationTarget& target_;
  const std::vector<bool>& fixed_;
  std::vector<std::uint32_t> first_;    ///< of each vertex into corners_
  std::vector<std::uint32_t> corners_;  ///< 3 t + k, by vertex, ascending
  std::vector<Wishes> wishes_;
};

void Fit::find_triangles_around() {
  first_.assign(mesh_.positions.size() + 1, 0);
  for (const Triangle& t : mesh_.triangles) {
    for (const std::uint32_t v : t) ++first_[v + 1];
  }
  for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
  corners_.resize(3 * mesh_.triangles.size());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t c = 0; c < corners_.size(); ++c) {
    corners_[next[mesh_.triangles[c / 3][c % 3]]++] = c;
  }
  assert(first_.back() == corners_.size());
}

Wishes Fit::wishes_of(const Triangle& t, DistanceProbe& field) const {
  const Vec3& a = mesh_.positions[t[0]];
  const Vec3& b = mesh_.positions[t[1]];
  const Vec3& c = mesh_.positions[t[2]];
  const double step_mm = 1.5 * field.value((a + b + c) / 3.0).voxel_mm;
  const int n = std::max(2, splits_for(longest_side(a, b, c), step_mm, kMostFitSplits));
  const double area = 0.5 * length(cross(b - a, c - a)) / (n * n);
  // What the samples say nothing of, along the surface, shall not move.
  constexpr double kStay = 0.05;
  Wishes wishes;
  for_each_sample(n, [&](const std::array<double, 3>& w) {
    const FieldValue at = field.value(w[0] * a + w[1] * b + w[2] * c);
    const double steepness = length(at.gradient);
    // At a medial axis the gradient vanishes and points nowhere.
    if (steepness < 0.25) return;
    const Vec3 normal = at.gradient / steepness;
    // As a distance: where the field is less steep than one it says too little.
    const double off = at.distance_mm / steepness;
    for (std::size_t k = 0; k < 3; ++k) {
      wishes.corner[k].add_plane(normal, -off * normal, area * w[k], 0.0);
      wishes.corner[k].add_plane(Vec3{}, Vec3{}, area * w[k], kStay);
    }
  });
  return wishes;
}

void Fit::ask_field(const Pace& pace) {
  wishes_.resize(mesh_.triangles.size());
  in_fit_pieces(wishes_.size(), pace, [&](std::size_t begin, std::size_t end) {
    const std::unique_ptr<DistanceProbe> field = target_.probe();
    for (std::size_t t = begin; t < end; ++t) {
      const Triangle& tri = mesh_.triangles[t];
      const bool stays = std::all_of(tri.begin(), tri.end(),
                                     [&](std::uint32_t v) { return static_cast<bool>(fixed_[v]); });
      if (!stays) wishes_[t] = wishes_of(tri, *field);
    }
  });
}

std::vector<Vec3> Fit::moved(const Pace& pace) const {
  // Must stay below 2: up to there a step still lowers the quadric that bounds the error.
  constexpr double kOverRelaxed = 1.6;
  std::vector<Vec3> to = mesh_.positions;
  in_fit_pieces(to.size(), pace, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      if (fixed_[v]) continue;
      Quadric sum;
      // Gathered by vertex and not added up by triangle: one order of summation for any
      // number of threads.
      for (std::uint32_t i = first_[v]; i < first_[v + 1]; ++i) {
        sum += wishes_[corners_[i] / 3].corner[corners_[i] % 3];
      }
      if (const std::optional<Vec3> step = sum.least()) to[v] += kOverRelaxed * *step;
    }
  });
  return to;
}

/// Whether a triangle turns over or shrinks to a needle.
bool Fit::is_worse(std::size_t t, const std::vector<Vec3>& moved) const {
  // It may turn by up to 60 degrees. Its shape is twice its area over its longest side squared,
  // 0.87 for an equilateral one.
  constexpr double kLeastCosine = 0.5;
  constexpr double kLeastShape = 0.02;
  const Triangle& tri = mesh_.triangles[t];
  const auto normal = [&](const std::vector<Vec3>& p) {
    return cross(p[tri[1]] - p[tri[0]], p[tri[2]] - p[tri[0]]);
  };
  const Vec3 before = normal(mesh_.positions);
  const Vec3 after = normal(moved);
  const double area = length(after);
  if (!(dot(before, after) > kLeastCosine * area * length(before))) return true;
  const double side = longest_side(moved[tri[0]], moved[tri[1]], moved[tri[2]]);
  return area < kLeastShape * side * side && area < length(before);
}

/// Takes back the corners of triangles that became worse until none is.
void Fit::keep_shape(std::vector<Vec3>& moved, const Pace& pace) const {
  std::vector<std::uint8_t> worse(mesh_.triangles.size(), 1);
  // What goes back may make a neighbour worse. This ends, since every pass puts a vertex
  // back for good.
  for (bool again = true; again;) {
    in_fit_pieces(worse.size(), pace, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) {
        const Triangle& tri = mesh_.triangles[t];
        const bool has_moved = std::any_of(tri.begin(), tri.end(), [&](std::uint32_t v) {
          return moved[v] != mesh_.positions[v];
        });
        worse[t] = has_moved && is_worse(t, moved) ? 1 : 0;
      }
    });
    again = false;
    for (std::size_t t = 0; t < worse.size(); ++t) {
      if (worse[t] == 0) continue;
      again = true;
      for (const std::uint32_t v : mesh_.triangles[t]) moved[v] = mesh_.positions[v];
    }
  }
}

void Fit::sweep(const Pace& pace) {
  ask_field(pace.part(0.0, 0.8));
  std::vector<Vec3> to = moved(pace.part(0.8, 0.9));
  // How often it goes over all of them is not known before.
  keep_shape(to, pace.part(0.9, 0.9));
  assert(to.size() == mesh_.positions.size());
  mesh_.positions = std::move(to);
}

}  // namespace

void fit_vertices(TriangleMesh& mesh, const DecimationTarget& target,
                  const std::vector<bool>& fixed, const Pace& pace) {
  Fit fit(mesh, target, fixed);
  for (int i = 0; i < kSweeps; ++i) {
    fit.sweep(pace.part(static_cast<double>(i) / kSweeps, (i + 1.0) / kSweeps));
  }
}

}  // namespace argil::mesh
