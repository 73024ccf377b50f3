// SPDX-License-Identifier: GPL-3.0-or-later
// The distance to z = a sin(kx) sin(ky), which has no closed form.
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "scene/distance.h"

namespace argil::evaluation {
namespace {

/// The unit cell of the field, all lengths in wavelengths: the surface repeats in x and y, turning
/// by half a period turns it upside down.
class RoughTable {
 public:
  explicit RoughTable(double amplitude);
  double operator()(const Vec3& p) const;

 private:
  static constexpr int kAcross = 80;        ///< nodes along one wavelength
  static constexpr double kHeight = 1.25;   ///< the table reaches this high and deep
  static constexpr int kRow = kAcross + 1;  ///< the last repeats the first
  static constexpr int kLayers = static_cast<int>(2.0 * kHeight * kAcross) + 1;

  static std::size_t index(std::size_t x, std::size_t y, std::size_t z) {
    return (x * kRow + y) * kLayers + z;
  }
  void mirror();
  double height(double x, double y) const;
  std::array<double, 2> step_to_foot(const Vec3& p, double x, double y) const;
  double to_foot(const Vec3& p, double x, double y) const;
  double solved(const Vec3& p) const;
  double from_crest(const Vec3& p) const;

  double amplitude_;
  double crest_curvature_;
  std::vector<float> value_;
};

constexpr double kRoughTurn = 2.0 * std::numbers::pi;

RoughTable::RoughTable(double amplitude)
    : amplitude_(amplitude),
      crest_curvature_(amplitude * kRoughTurn * kRoughTurn),
      value_(static_cast<std::size_t>(kRow) * kRow * kLayers) {
  // x <= y, both from -1/4 to 1/4, suffice: the rest is mirrored at the crests and troughs.
  constexpr int kQuarter = kAcross / 4;
  const auto at = [](int i) { return static_cast<std::size_t>((i + kAcross) % kAcross); };
  for (int x = -kQuarter; x <= kQuarter; ++x) {
    for (int y = x; y <= kQuarter; ++y) {
      for (int z = 0; z < kLayers; ++z) {
        const Vec3 p{x / double{kAcross}, y / double{kAcross}, z / double{kAcross} - kHeight};
        const auto value = static_cast<float>(solved(p));
        const auto layer = static_cast<std::size_t>(z);
        value_[index(at(x), at(y), layer)] = value_[index(at(y), at(x), layer)] = value;
      }
    }
  }
  mirror();
}

/// Fills the cell from the quarter that the constructor solved.
void RoughTable::mirror() {
  constexpr std::size_t kQuarter = kAcross / 4;
  const auto unique = [](std::size_t i) {
    if (i >= kAcross) return i - kAcross;
    return i > kQuarter && i < 3 * kQuarter ? (kAcross + kAcross / 2 - i) % kAcross : i;
  };
  for (std::size_t x = 0; x < kRow; ++x) {
    for (std::size_t y = 0; y < kRow; ++y) {
      for (std::size_t z = 0; z < kLayers; ++z) {
        value_[index(x, y, z)] = value_[index(unique(x), unique(y), z)];
      }
    }
  }
}

double RoughTable::height(double x, double y) const {
  return amplitude_ * std::sin(kRoughTurn * x) * std::sin(kRoughTurn * y);
}

/// Newton's step toward the foot, or where the distance is no bowl a fifth of its slope.
std::array<double, 2> RoughTable::step_to_foot(const Vec3& p, double x, double y) const {
  constexpr double kShortened = 0.2;
  const double sx = std::sin(kRoughTurn * x), cx = std::cos(kRoughTurn * x);
  const double sy = std::sin(kRoughTurn * y), cy = std::cos(kRoughTurn * y);
  const double rise = amplitude_ * sx * sy - p.z;
  const double slope_x = amplitude_ * kRoughTurn * cx * sy,
               slope_y = amplitude_ * kRoughTurn * sx * cy;
  const double gx = x - p.x + rise * slope_x, gy = y - p.y + rise * slope_y;
  const double bend = rise * crest_curvature_ * sx * sy;
  const double xx = 1.0 + slope_x * slope_x - bend;
  const double yy = 1.0 + slope_y * slope_y - bend;
  const double xy = slope_x * slope_y + rise * crest_curvature_ * cx * cy;
  // The Hessian of half the squared distance. Where it is not positive definite Newton's
  // step would climb.
  const double det = xx * yy - xy * xy;
  if (!(det > 0.0 && xx > 0.0)) return {kShortened * gx, kShortened * gy};
  return {(yy * gx - xy * gy) / det, (xx * gy - xy * gx) / det};
}

/// Distance to the foot that damped Newton steps find from (x, y).
double RoughTable::to_foot(const Vec3& p, double x, double y) const {
  const auto squared = [&](double at_x, double at_y) {
    const double rise = height(at_x, at_y) - p.z;
    return (at_x - p.x) * (at_x - p.x) + (at_y - p.y) * (at_y - p.y) + rise * rise;
  };
  constexpr int kSteps = 12;
  constexpr int kHalvings = 6;
  constexpr double kConverged = 1e-10;
  double best = squared(x, y);
  for (int step = 0; step < kSteps; ++step) {
    std::array<double, 2> d = step_to_foot(p, x, y);
    double next = squared(x - d[0], y - d[1]);
    for (int half = 0; half < kHalvings && next > best; ++half) {
      d = {0.5 * d[0], 0.5 * d[1]};
      next = squared(x - d[0], y - d[1]);
    }
    if (next >= best) break;
    const bool converged = best - next < kConverged;
    best = next;
    x -= d[0];
    y -= d[1];
    if (converged) break;
  }
  return std::sqrt(best);
}

/// The least over several starts: feet lie near the point's own column or toward the nearest
/// crests.
double RoughTable::solved(const Vec3& p) const {
  double least = std::numeric_limits<double>::infinity();
  for (const double dx : {-0.25, 0.0, 0.25}) {
    for (const double dy : {-0.25, 0.0, 0.25}) {
      least = std::min(least, to_foot(p, p.x + dx, p.y + dy));
    }
  }
  return p.z >= height(p.x, p.y) ? least : -least;
}

/// Above the table the foot is so near a crest that the surface is its paraboloid; below, a
/// trough's, which the same surface upside down has half a wavelength on.
double RoughTable::from_crest(const Vec3& p) const {
  const double x = p.z > 0.0 ? p.x : p.x + 0.5;
  // Crests lie at (1/4, 1/4) and (3/4, 3/4) of every cell.
  const double from_x = x - 0.25 - std::floor(x - 0.25);
  const double from_y = p.y - 0.25 - std::floor(p.y - 0.25);
  const auto squared = [](double dx, double dy) { return dx * dx + dy * dy; };
  const auto nearer = [](double d) { return std::min(d, 1.0 - d); };
  const double aside = std::sqrt(
      std::min(squared(nearer(from_x), nearer(from_y)), squared(from_x - 0.5, from_y - 0.5)));
  const double above = std::abs(p.z) - amplitude_;
  // Where the distance is stationary, but for the cube of the foot, which is near the crest.
  const double foot = aside / (1.0 + crest_curvature_ * above);
  const double drop = 0.5 * crest_curvature_ * foot * foot;
  return std::copysign(std::sqrt(squared(aside - foot, above + drop)), p.z);
}

double RoughTable::operator()(const Vec3& p) const {
  if (std::abs(p.z) >= kHeight) return from_crest(p);
  const std::array<double, 3> at{(p.x - std::floor(p.x)) * kAcross,
                                 (p.y - std::floor(p.y)) * kAcross, (p.z + kHeight) * kAcross};
  const auto x = std::min<std::size_t>(static_cast<std::size_t>(at[0]), kAcross - 1);
  const auto y = std::min<std::size_t>(static_cast<std::size_t>(at[1]), kAcross - 1);
  const auto z = std::min<std::size_t>(static_cast<std::size_t>(at[2]), kLayers - 2);
  const double fx = at[0] - static_cast<double>(x);
  const double fy = at[1] - static_cast<double>(y);
  const double fz = at[2] - static_cast<double>(z);
  const auto column = [&](std::size_t i, std::size_t j) {
    const float* v = value_.data() + index(i, j, z);
    return static_cast<double>(v[0]) + fz * static_cast<double>(v[1] - v[0]);
  };
  const double low = column(x, y) + fy * (column(x, y + 1) - column(x, y));
  const double high = column(x + 1, y) + fy * (column(x + 1, y + 1) - column(x + 1, y));
  return low + fx * (high - low);
}

}  // namespace

Distance rough_box(double half_side_mm, double depth_mm, double amplitude_mm,
                   double wavelength_mm) {
  assert(half_side_mm > 0.0 && depth_mm > 0.0 && wavelength_mm > 0.0);
  const auto table = std::make_shared<const RoughTable>(amplitude_mm / wavelength_mm);
  const double half_depth = depth_mm;  // reaches as far above z = 0, where the table decides
  const Distance sides = box({half_side_mm, half_side_mm, half_depth}, 0.0);
  return [=](const Vec3& p) {
    return std::max(wavelength_mm * (*table)(p / wavelength_mm), sides(p));
  };
}

}  // namespace argil::evaluation
