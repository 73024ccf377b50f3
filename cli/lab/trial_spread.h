// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

namespace argil::cli::lab {

/// Between the two values nearest to it in order, linearly.
///
/// Shapes  sorted: ascending, at least one; part: 0 to 1.
double quantile_of(const std::vector<double>& sorted, double part);

/// A median, and between which two it would lie 95 times of a hundred if such values were drawn
/// anew.
struct MedianInterval {
  double median = 0.0;
  double low = 0.0;
  double high = 0.0;
};

/// Of all values together, drawn anew within each group: 4000 times, each as often as it has
/// values.
///
/// Shapes       groups: at least one value in all; empty ones count for nothing.
/// Determinism  same values and seed: same bits.
/// Source       B. Efron, "Bootstrap methods: another look at the jackknife", Annals of Statistics
/// 7
///              (1979); percentiles, by groups, since the hands of a study are not drawn.
MedianInterval median_interval(const std::vector<std::vector<double>>& groups, std::uint64_t seed);

}  // namespace argil::cli::lab
