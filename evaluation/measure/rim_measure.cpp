// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/rim_measure.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace argil::evaluation {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kAngles = 2000;
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// The circle's frame: its axis, two directions across it, and where it lies.
struct RimFrame {
  Vec3 axis;
  Vec3 u;
  Vec3 v;
  double along_mm;
  double radius_mm;

  explicit RimFrame(const RimCase& rim) {
    const double d = length(rim.tool_at_mm);
    axis = rim.tool_at_mm / d;
    along_mm = (d * d + rim.ball_mm * rim.ball_mm - rim.tool_mm * rim.tool_mm) / (2.0 * d);
    radius_mm = std::sqrt(rim.ball_mm * rim.ball_mm - along_mm * along_mm);
    u = normalized(cross(axis, std::abs(axis.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
    v = cross(axis, u);
  }
  double distance(const Vec3& p) const {
    const double z = dot(p, axis);
    return std::hypot(z - along_mm, length(p - z * axis) - radius_mm);
  }
  double angle(const Vec3& p) const { return std::atan2(dot(p, v), dot(p, u)); }
};

/// The distance from the surface that is left.
double distance_from_exact(const RimCase& rim, const RimFrame& frame, const Vec3& p) {
  double nearest = frame.distance(p);
  const Vec3 from_tool = p - rim.tool_at_mm;
  const Vec3 on_ball = p * (rim.ball_mm / length(p));
  const Vec3 on_tool = rim.tool_at_mm + from_tool * (rim.tool_mm / length(from_tool));
  if (length(on_ball - rim.tool_at_mm) >= rim.tool_mm) {
    nearest = std::min(nearest, std::abs(length(p) - rim.ball_mm));
  }
  const bool is_in_ball = length(on_tool) <= rim.ball_mm;
  if (is_in_ball == rim.is_carved) {
    nearest = std::min(nearest, std::abs(length(from_tool) - rim.tool_mm));
  }
  return nearest;
}

using Corners = std::array<Vec3, 3>;

std::vector<Corners> triangles_near(const TriangleMesh& mesh, const RimFrame& frame, double reach) {
  std::vector<Corners> near;
  for (const auto& t : mesh.triangles) {
    const Corners c{mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
    const double size = std::max({length(c[0] - c[1]), length(c[1] - c[2]), length(c[2] - c[0])});
    if (frame.distance((c[0] + c[1] + c[2]) / 3.0) <= reach + size) near.push_back(c);
  }
  return near;
}

/// Points spread evenly over all triangles.
double surface_rms(const std::vector<Corners>& near, const RimCase& rim, const RimFrame& frame,
                   double voxel) {
  double sum = 0.0;
  int count = 0;
  for (const Corners& c : near) {
    const double area = 0.5 * length(cross(c[1] - c[0], c[2] - c[0]));
    const int samples = std::max(1, static_cast<int>(400.0 * area / (voxel * voxel)));
    for (int k = 0; k < samples; ++k) {
      double x = std::fmod(0.5 + k * 0.7548776662466927, 1.0);
      double y = std::fmod(0.5 + k * 0.5698402909980532, 1.0);
      if (x + y > 1.0) {
        x = 1.0 - x;
        y = 1.0 - y;
      }
      const Vec3 p = c[0] + x * (c[1] - c[0]) + y * (c[2] - c[0]);
      if (frame.distance(p) >= 2.0 * voxel) continue;
      const double off = distance_from_exact(rim, frame, p);
      sum += off * off;
      ++count;
    }
  }
  assert(count > 0);
  return std::sqrt(sum / count);
}

/// The triangles that each half plane about the axis may meet.
std::vector<std::vector<std::size_t>> by_angle(const std::vector<Corners>& near,
                                               const RimFrame& frame) {
  std::vector<std::vector<std::size_t>> bins(kAngles);
  const double step = 2.0 * kPi / kAngles;
  for (std::size_t n = 0; n < near.size(); ++n) {
    const double first = frame.angle(near[n][0]);
    double least = 0.0;
    double most = 0.0;
    for (const Vec3& p : near[n]) {
      const double turn = std::remainder(frame.angle(p) - first, 2.0 * kPi);
      least = std::min(least, turn);
      most = std::max(most, turn);
    }
    const int last = static_cast<int>(std::ceil((first + most) / step));
    for (int k = static_cast<int>(std::floor((first + least) / step)); k <= last; ++k) {
      bins[static_cast<std::size_t>((k % kAngles + kAngles) % kAngles)].push_back(n);
    }
  }
  return bins;
}

}  // namespace

double RimMeasure::mean() const {
  double sum = 0.0;
  for (const double each : beyond) sum += each;
  return sum / static_cast<double>(beyond.size());
}

double RimMeasure::serration_rms() const {
  const double middle = mean();
  double sum = 0.0;
  for (const double each : beyond) sum += (each - middle) * (each - middle);
  return std::sqrt(sum / static_cast<double>(beyond.size()));
}

RimMeasure measure_rim(const TriangleMesh& mesh, const RimCase& rim, double voxel_mm) {
  const RimFrame frame(rim);
  const double reach = 3.0 * voxel_mm;
  const std::vector<Corners> near = triangles_near(mesh, frame, reach);
  RimMeasure measured;
  measured.surface_rms = surface_rms(near, rim, frame, voxel_mm);
  const auto bins = by_angle(near, frame);
  for (int k = 0; k < kAngles; ++k) {
    const double turn = 2.0 * kPi * k / kAngles;
    const Vec3 out = frame.u * std::cos(turn) + frame.v * std::sin(turn);
    const Vec3 across = cross(frame.axis, out);
    const Vec3 at = frame.axis * frame.along_mm + out * frame.radius_mm;
    const double sign = rim.is_carved ? -1.0 : 1.0;
    const Vec3 sum = normalized(at) + sign * normalized(at - rim.tool_at_mm);
    const Vec3 bisector = normalized(sum) * -sign;  // out of a cut's edge, into an added one's
    double most = -std::numeric_limits<double>::infinity();
    for (const std::size_t n : bins[static_cast<std::size_t>(k)]) {
      for (std::size_t q = 0; q < 3; ++q) {
        const Vec3& a = near[n][q];
        const Vec3& b = near[n][(q + 1) % 3];
        const double da = dot(a, across);
        const double db = dot(b, across);
        if ((da < 0.0) == (db < 0.0)) continue;
        const Vec3 p = a + (b - a) * (da / (da - db));
        if (dot(p, out) < 0.0 || frame.distance(p) > reach) continue;
        most = std::max(most, dot(p - at, bisector));
      }
    }
    measured.beyond.push_back(std::isfinite(most) ? most : kUnknown);  // NaN fails every bound
  }
  return measured;
}

}  // namespace argil::evaluation
