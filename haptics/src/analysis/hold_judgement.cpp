// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/analysis/hold_judgement.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <vector>

namespace argil::haptics {
namespace {

/// What is left of one coordinate after its least-squares line.
std::vector<double> detrended(std::span<const Vec3> series, std::size_t axis) {
  assert(series.size() >= 3 && axis < 3);
  const auto count = static_cast<double>(series.size());
  const double middle = 0.5 * (count - 1.0);
  double mean = 0.0;
  double slope = 0.0;
  double spread = 0.0;
  for (std::size_t n = 0; n < series.size(); ++n) {
    const double t = static_cast<double>(n) - middle;
    mean += series[n][axis] / count;
    slope += series[n][axis] * t;
    spread += t * t;
  }
  slope /= spread;
  std::vector<double> rest(series.size());
  for (std::size_t n = 0; n < series.size(); ++n) {
    rest[n] = series[n][axis] - mean - slope * (static_cast<double>(n) - middle);
  }
  return rest;
}

double peak_to_peak(const std::vector<double>& values) {
  assert(!values.empty());
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return *most - *least;
}

/// From the first rise through zero to the last.
double frequency(const std::vector<double>& values, double period_s) {
  std::size_t first = 0;
  std::size_t last = 0;
  int rises = 0;
  for (std::size_t n = 1; n < values.size(); ++n) {
    if (values[n - 1] > 0.0 || values[n] <= 0.0) continue;
    if (rises++ == 0) first = n;
    last = n;
  }
  return rises < 2 ? 0.0 : (rises - 1) / (static_cast<double>(last - first) * period_s);
}

}  // namespace

const char* verdict_name(Verdict verdict) noexcept {
  switch (verdict) {
    case Verdict::quiet:
      return "quiet";
    case Verdict::buzz:
      return "buzz";
    case Verdict::limit_cycle:
      return "limit_cycle";
    case Verdict::gives:
      return "gives";
    case Verdict::unfinished:
      break;
  }
  return "unfinished";
}

HoldJudgement judge_hold(std::span<const Vec3> position_mm, std::span<const Vec3> force_n,
                         double period_s) {
  assert(position_mm.size() == force_n.size() && position_mm.size() >= 3 && period_s > 0.0);
  HoldJudgement found;
  double work_nmm = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::vector<double> position = detrended(position_mm, axis);
    const double swing = peak_to_peak(position);
    if (swing > found.position_pp_mm) {
      found.position_pp_mm = swing;
      found.frequency_hz = frequency(position, period_s);
    }
    found.force_pp_n = std::max(found.force_pp_n, peak_to_peak(detrended(force_n, axis)));
    for (std::size_t n = 0; n + 1 < position.size(); ++n) {
      work_nmm += force_n[n][axis] * (position[n + 1] - position[n]);
    }
  }
  found.work_mw = work_nmm / (static_cast<double>(position_mm.size() - 1) * period_s);
  if (found.position_pp_mm > kLimitCycleMm) {
    found.verdict = Verdict::limit_cycle;
  } else if (found.force_pp_n > kBuzzN) {
    found.verdict = Verdict::buzz;
  }
  return found;
}

}  // namespace argil::haptics
