// SPDX-License-Identifier: GPL-3.0-or-later
// The triangles are cut by half planes across the line; each section becomes heights over the ball
// at places beside the line.
#include "measure/crease_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace argil::evaluation {
namespace {

constexpr int kSections = 400;
constexpr int kPlaces = 161;          ///< of a section
constexpr double kHalfSection = 1.6;  ///< in tool radii
constexpr int kMiddlePlaces = 40;     ///< the deepest is sought this far from the ends
constexpr int kBesideBottom = 3;      ///< places that make 0.06 radii
constexpr double kFar = std::numeric_limits<double>::max();

struct Point {
  double beside;  // of the line, in places
  double depth;
};

class Sections {
 public:
  Sections(const TriangleMesh& mesh, const CreaseLine& line)
      : mesh_(mesh), line_(line), across_(cross(line.normal, line.middle)) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Vec3& at = mesh.positions[mesh.triangles[t][0]];
      if (std::abs(dot(at, line.normal)) < kHalfSection * line.tool_mm && dot(at, line.middle) > 0)
        near_.push_back(t);
    }
  }

  double step_mm() const { return 2.0 * line_.half_angle * line_.ball_mm / kSections; }

  /// The depth at each place, the greatest where there are several.
  std::vector<double> section(int n) const {
    const double angle = line_.half_angle * (2.0 * (n + 0.5) / kSections - 1.0);
    const Vec3 out = std::cos(angle) * line_.middle + std::sin(angle) * across_;
    const Vec3 along = std::cos(angle) * across_ - std::sin(angle) * line_.middle;
    std::vector<double> depth(kPlaces, -kFar);
    for (const std::size_t t : near_) add_triangle(mesh_.triangles[t], out, along, depth);
    return depth;
  }

 private:
  void add_triangle(const Triangle& triangle, const Vec3& out, const Vec3& along,
                    std::vector<double>& depth) const {
    std::array<Vec3, 2> cut;
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3 && count < 2; ++i) {
      const Vec3& a = mesh_.positions[triangle[i]];
      const Vec3& b = mesh_.positions[triangle[(i + 1) % 3]];
      const double from = dot(a, along);
      const double to = dot(b, along);
      if ((from < 0.0) != (to < 0.0)) cut[count++] = a + (from / (from - to)) * (b - a);
    }
    if (count < 2 || dot(cut[0], out) < 0.0) return;
    Point low = point_of(cut[0]);
    Point high = point_of(cut[1]);
    if (low.beside > high.beside) std::swap(low, high);
    const int first = std::max(0, static_cast<int>(std::ceil(low.beside)));
    const int last = std::min(kPlaces - 1, static_cast<int>(std::floor(high.beside)));
    for (int place = first; place <= last; ++place) {
      const double span = high.beside - low.beside;
      const double part = span > 0.0 ? (place - low.beside) / span : 0.0;
      double& at = depth[static_cast<std::size_t>(place)];
      at = std::max(at, low.depth + part * (high.depth - low.depth));
    }
  }

  Point point_of(const Vec3& at) const {
    const double beside = dot(at, line_.normal) / line_.tool_mm;
    return {(beside + kHalfSection) / (2.0 * kHalfSection) * (kPlaces - 1),
            line_.side * (line_.ball_mm - length(at))};
  }

  const TriangleMesh& mesh_;
  CreaseLine line_;
  Vec3 across_;
  std::vector<std::size_t> near_;
};

/// What is left of a row of numbers without the mean of so many to either side.
double rms_less_trend(const std::vector<double>& values, int window) {
  const int count = static_cast<int>(values.size());
  double sum = 0.0;
  int used = 0;
  for (int n = window; n + window < count; ++n, ++used) {
    double mean = 0.0;
    for (int k = n - window; k <= n + window; ++k) mean += values[static_cast<std::size_t>(k)];
    const double off = values[static_cast<std::size_t>(n)] - mean / (2 * window + 1);
    sum += off * off;
  }
  return used > 0 ? std::sqrt(sum / used) : std::nan("");
}

}  // namespace

CreaseShape crease_shape(const TriangleMesh& mesh, const CreaseLine& line) {
  const Sections sections(mesh, line);
  const double place_mm = 2.0 * kHalfSection / (kPlaces - 1) * line.tool_mm;
  CreaseShape mean;
  std::vector<double> bottoms;
  for (int n = 0; n < kSections; ++n) {
    const std::vector<double> depth = sections.section(n);
    const auto deepest =
        std::max_element(depth.begin() + kMiddlePlaces, depth.end() - kMiddlePlaces);
    auto low = deepest;
    auto high = deepest;
    while (low != depth.begin() && *low > 0.5 * *deepest) --low;
    while (high + 1 != depth.end() && *high > 0.5 * *deepest) ++high;
    const double rise = *deepest - 0.5 * (*(deepest - kBesideBottom) + *(deepest + kBesideBottom));
    const auto places = static_cast<double>(high - low);
    mean.depth_mm += *deepest / kSections;
    mean.width_mm += places * place_mm / kSections;
    mean.sharpness += rise * places / (*deepest * kBesideBottom) / kSections;
    bottoms.push_back(*deepest);
  }
  const int window = std::max(3, static_cast<int>(line.tool_mm / sections.step_mm()));
  mean.bottom_rms_mm = rms_less_trend(bottoms, window);
  return mean;
}

}  // namespace argil::evaluation
