// SPDX-License-Identifier: GPL-3.0-or-later
// Error and time of each strategy on the same random points near the surface.
#include "normals/rows.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <span>

#include "argil/core/hash.h"

#include "chart/chart.h"
#include "common/machine.h"
#include "common/output.h"
#include "normals/strategy.h"
#include "scene/random.h"

namespace argil::evaluation {
namespace {

constexpr unsigned kNormalSeed = 364;
constexpr double kHalfWidthMm = 75.0;  // within the tables

/// Made from their nearest points, whose normal they keep, so that distance and normal are known:
/// depths are far below the least radius of curvature, 12.7 mm.
std::vector<WavePoint> points_at(double depth_mm, int count) {
  Random random(kNormalSeed);
  std::vector<WavePoint> points;
  for (int n = 0; n < count; ++n) {
    const double x = random.between(-kHalfWidthMm, kHalfWidthMm);
    const double y = random.between(-kHalfWidthMm, kHalfWidthMm);
    WavePoint point = wave_point(x, y);
    point.place_mm -= depth_mm * point.normal;
    points.push_back(point);
  }
  return points;
}

/// Of two unit vectors, exact where it is small.
double small_angle_deg(const Vec3& a, const Vec3& b) {
  return 2.0 * std::asin(std::min(1.0, 0.5 * length(a - b))) * 180.0 / std::numbers::pi;
}

void measure_normal_error(const NormalStrategy& strategy, const std::vector<WavePoint>& points,
                          NormalRow& row) {
  double angles = 0.0;
  double distances = 0.0;
  for (const WavePoint& point : points) {
    const NormalStrategy::Answer answer = strategy.at(point.place_mm);
    const double angle = small_angle_deg(answer.normal, point.normal);
    const double off = std::abs(answer.distance_mm + row.depth_mm);
    angles += angle * angle;
    distances += off * off;
    row.angle_max_deg = std::max(row.angle_max_deg, angle);
    row.distance_max_mm = std::max(row.distance_max_mm, off);
  }
  const double count = static_cast<double>(points.size());
  row.angle_rms_deg = std::sqrt(angles / count);
  row.distance_rms_mm = std::sqrt(distances / count);
}

/// Each place waits for the answer before it, as in a search for the proxy: so calls cannot overlap
/// in the processor, as they do not in a servo.
double pass_ns(const NormalStrategy& strategy, const std::vector<WavePoint>& points) {
  const double before = cli::thread_cpu_us();
  double last = 0.0;
  for (const WavePoint& point : points) {
    const NormalStrategy::Answer answer = strategy.at(point.place_mm + Vec3{0.0 * last, 0.0, 0.0});
    last = answer.normal.z + answer.distance_mm;
  }
  const double passed = cli::thread_cpu_us() - before;
  if (!std::isfinite(last)) return last;  // never, but only a result that is used is computed
  return 1e3 * passed / static_cast<double>(points.size());
}

double median_ns(const NormalStrategy& strategy, const std::vector<WavePoint>& points, int passes) {
  std::vector<double> ns(static_cast<std::size_t>(passes));
  pass_ns(strategy, points);  // warms the caches
  for (double& pass : ns) pass = pass_ns(strategy, points);
  const auto middle = ns.begin() + passes / 2;
  std::nth_element(ns.begin(), middle, ns.end());
  return *middle;
}

/// Four digits: above the noise of sums of doubles. Below 1e-9 is rounding, which differs from
/// library to library.
std::string normals_field(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value < 1e-9 ? 0.0 : value);
  return text;
}

}  // namespace

Result<std::vector<NormalRow>> measure_normals(bool quick, const Progress& progress) {
  const auto strategies = normal_strategies(quick);
  const int count = quick ? 4000 : 40000;
  std::vector<NormalRow> rows;
  double done = 0.0;
  for (const double depth : kNormalDepthsMm) {
    const std::vector<WavePoint> points = points_at(depth, count);
    for (const auto& strategy : strategies) {
      const double all = static_cast<double>(strategies.size() * std::size(kNormalDepthsMm));
      if (auto go_on = tell(progress, "normals", done / all); !go_on) return go_on.error();
      NormalRow row{strategy->family(), strategy->setting(), depth, 0, 0, 0, 0, 0, 0};
      row.bytes = strategy->bytes();
      measure_normal_error(*strategy, points, row);
      row.ns = median_ns(*strategy, points, quick ? 3 : 15);
      rows.push_back(std::move(row));
      done += 1.0;
    }
  }
  return rows;
}

std::string normals_csv(const std::vector<NormalRow>& rows) {
  Hash64 digest;
  std::string lines;
  for (const NormalRow& row : rows) {
    std::string results = row.strategy + "," + cli::number(row.setting) + "," +
                          cli::number(row.depth_mm) + "," + normals_field(row.angle_rms_deg) + "," +
                          normals_field(row.angle_max_deg) + "," +
                          normals_field(row.distance_rms_mm) + "," +
                          normals_field(row.distance_max_mm) + "," + std::to_string(row.bytes);
    digest.update(std::as_bytes(std::span(results)));
    lines += results + "," + normals_field(row.ns) + "\n";
  }
  return "# Distance and normal of waves of 50 mm, 5 mm high; " + cli::machine_name() + "; seed " +
         std::to_string(kNormalSeed) + "; hash " + cli::hex(digest.digest()) +
         " over all columns but the time\n"
         "strategy,setting,depth_mm,angle_rms_deg,angle_max_deg,distance_rms_mm,distance_max_mm,"
         "bytes,ns\n" +
         lines;
}

}  // namespace argil::evaluation
