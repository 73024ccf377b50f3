// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/ripple.h"

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace argil::evaluation {
namespace {

constexpr double kPointsPerReach2 = 30.0;  ///< over an area of reach_mm squared
constexpr std::size_t kTerms = 6;          ///< of a paraboloid: 1, x, y, x^2, xy, y^2
constexpr int kLeastPoints = 12;           ///< that one is fitted to
constexpr double kSameSide = 0.3;  ///< cosine to the normal of what counts as the surface there

struct SurfaceSample {
  Vec3 at;
  Vec3 normal;
};

/// Evenly over the triangles: what a small one is short of a point is handed on to the next.
std::vector<SurfaceSample> samples_of(const TriangleMesh& mesh, double per_mm2) {
  std::vector<SurfaceSample> samples;
  double due = 0.5;
  std::int64_t count = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3& a = mesh.positions[t[0]];
    const Vec3 ab = mesh.positions[t[1]] - a;
    const Vec3 ac = mesh.positions[t[2]] - a;
    const Vec3 twice = cross(ab, ac);
    const double area = 0.5 * length(twice);
    if (!(area > 0.0)) continue;
    due += area * per_mm2;
    while (due >= 1.0) {
      due -= 1.0;
      double x = std::fmod(0.5 + static_cast<double>(count) * 0.7548776662466927, 1.0);
      double y = std::fmod(0.5 + static_cast<double>(count) * 0.5698402909980532, 1.0);
      if (x + y > 1.0) {
        x = 1.0 - x;
        y = 1.0 - y;
      }
      samples.push_back({a + x * ab + y * ac, twice / (2.0 * area)});
      ++count;
    }
  }
  return samples;
}

/// The samples by cells as large as the reach.
class SampleGrid {
 public:
  SampleGrid(const std::vector<SurfaceSample>& samples, double cell_mm) : cell_mm_(cell_mm) {
    for (std::size_t i = 0; i < samples.size(); ++i)
      cells_[key_of(cell_of(samples[i].at))].push_back(i);
  }

  template <class Visit>
  void for_near(const Vec3& at, const Visit& visit) const {
    const Cell middle = cell_of(at);
    for (std::int64_t x = -1; x <= 1; ++x) {
      for (std::int64_t y = -1; y <= 1; ++y) {
        for (std::int64_t z = -1; z <= 1; ++z) {
          const auto found = cells_.find(key_of({middle[0] + x, middle[1] + y, middle[2] + z}));
          if (found == cells_.end()) continue;
          for (const std::size_t i : found->second) visit(i);
        }
      }
    }
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  Cell cell_of(const Vec3& p) const {
    Cell cell{};
    for (std::size_t a = 0; a < 3; ++a)
      cell[a] = static_cast<std::int64_t>(std::floor(p[a] / cell_mm_));
    return cell;
  }
  static std::int64_t key_of(const Cell& cell) {
    constexpr std::int64_t kSide = std::int64_t{1} << 20;
    return (cell[0] * kSide + cell[1]) * kSide + cell[2];
  }

  double cell_mm_;
  std::unordered_map<std::int64_t, std::vector<std::size_t>> cells_;
};

/// Least squares by the normal equations, which suffice for values about 1.
class ParaboloidFit {
 public:
  void add(double x, double y, double height) {
    const std::array<double, kTerms> terms{1.0, x, y, x * x, x * y, y * y};
    for (std::size_t i = 0; i < kTerms; ++i) {
      for (std::size_t j = 0; j < kTerms; ++j) matrix_[i][j] += terms[i] * terms[j];
      matrix_[i][kTerms] += terms[i] * height;
    }
    ++count_;
  }
  bool is_enough() const { return count_ >= kLeastPoints; }

  /// The height of the paraboloid at its origin.
  double at_origin() {
    // The matrix is positive definite where the points do not lie on a conic; what is left of a
    // pivot otherwise is rounding.
    for (std::size_t k = kTerms; k-- > 0;) {
      if (!(matrix_[k][k] > 1e-12)) return 0.0;
      for (std::size_t i = 0; i < k; ++i) {
        const double part = matrix_[i][k] / matrix_[k][k];
        for (std::size_t j = 0; j < k; ++j) matrix_[i][j] -= part * matrix_[k][j];
        matrix_[i][kTerms] -= part * matrix_[k][kTerms];
      }
    }
    return matrix_[0][kTerms] / matrix_[0][0];
  }

 private:
  std::array<std::array<double, kTerms + 1>, kTerms> matrix_{};
  int count_ = 0;
};

}  // namespace

double ripple_rms(const TriangleMesh& mesh, double reach_mm,
                  const std::function<bool(const Vec3&)>& is_looked_at) {
  assert(reach_mm > 0.0);
  const auto samples = samples_of(mesh, kPointsPerReach2 / (reach_mm * reach_mm));
  const SampleGrid grid(samples, reach_mm);
  double sum = 0.0;
  std::int64_t count = 0;
  for (const SurfaceSample& middle : samples) {
    if (!is_looked_at(middle.at)) continue;
    const Vec3 side = std::abs(middle.normal.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 u = normalized(cross(middle.normal, side));
    const Vec3 v = cross(middle.normal, u);
    ParaboloidFit fit;
    grid.for_near(middle.at, [&](std::size_t i) {
      const Vec3 off = (samples[i].at - middle.at) / reach_mm;
      if (dot(off, off) > 1.0 || dot(samples[i].normal, middle.normal) < kSameSide) return;
      fit.add(dot(off, u), dot(off, v), dot(off, middle.normal));
    });
    if (!fit.is_enough()) continue;
    const double height = fit.at_origin() * reach_mm;
    sum += height * height;
    ++count;
  }
  return count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0.0;
}

}  // namespace argil::evaluation
