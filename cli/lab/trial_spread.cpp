// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/trial_spread.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "lab/trial.h"

namespace argil::cli::lab {
namespace {

double median_of(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  return quantile_of(values, 0.5);
}

}  // namespace

double quantile_of(const std::vector<double>& sorted, double part) {
  assert(!sorted.empty() && part >= 0.0 && part <= 1.0);
  const double at = part * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (at - std::floor(at)) * (sorted[above] - sorted[below]);
}

MedianInterval median_interval(const std::vector<std::vector<double>>& groups, std::uint64_t seed) {
  constexpr int kDrawn = 4000;
  constexpr double kOutside = 0.025;  // at either end
  std::vector<double> values;
  for (const auto& group : groups) values.insert(values.end(), group.begin(), group.end());
  assert(!values.empty());
  std::vector<double> medians;
  medians.reserve(kDrawn);
  std::uint64_t random = seed;
  for (int n = 0; n < kDrawn; ++n) {
    std::vector<double> drawn;
    drawn.reserve(values.size());
    for (const auto& group : groups) {
      for (std::size_t i = 0; i < group.size(); ++i) {
        random = mixed(random);
        drawn.push_back(group[static_cast<std::size_t>(random % group.size())]);
      }
    }
    medians.push_back(median_of(drawn));
  }
  std::sort(medians.begin(), medians.end());
  return {median_of(values), quantile_of(medians, kOutside), quantile_of(medians, 1.0 - kOutside)};
}

}  // namespace argil::cli::lab
