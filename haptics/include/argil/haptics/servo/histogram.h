// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace argil::haptics {

/// Counts times without keeping them: bins of 2 % from 10 ns to 10 s, and the exact largest.
///
/// Accuracy  a quantile is at most 2 % too large.
/// Threads   Realtime: `add` by one thread; the rest by the same, or when it has ended.
/// Memory    8 KiB, no heap.
class Histogram {
 public:
  /// Counts one time in microseconds. Below 10 ns, negative times and NaN included, it falls into
  /// the first bin; beyond 10 s into the last.
  void add(double time_us) noexcept {
    ++bins_[bin_of(time_us)];
    ++count_;
    most_us_ = std::max(most_us_, time_us);
  }

  /// The time that the fraction `share` (0 to 1) of all times did not exceed; 0 when there are
  /// none.
  double quantile_us(double share) const noexcept {
    assert(share >= 0.0 && share <= 1.0);
    const auto rank = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(count_)));
    std::uint64_t seen = 0;
    for (std::size_t bin = 0; bin < kBins; ++bin) {
      seen += bins_[bin];
      if (seen >= rank && seen > 0) return std::min(top_of(bin), most_us_);
    }
    return most_us_;
  }
  /// The largest time, exact; 0 when there are none.
  double max_us() const noexcept { return most_us_; }
  std::uint64_t count() const noexcept { return count_; }

 private:
  static constexpr std::size_t kBins = 1024;
  static constexpr double kLeastUs = 0.01;
  static constexpr double kRatio = 1.02;

  /// The bin whose top is the first at or above the time.
  static std::size_t bin_of(double time_us) noexcept {
    if (!(time_us > kLeastUs)) return 0;
    const double bin = std::ceil(std::log(time_us / kLeastUs) / std::log(kRatio));
    return static_cast<std::size_t>(std::min(bin, static_cast<double>(kBins - 1)));
  }
  static double top_of(std::size_t bin) noexcept {
    return kLeastUs * std::pow(kRatio, static_cast<double>(bin));
  }

  std::array<std::uint64_t, kBins> bins_{};
  std::uint64_t count_ = 0;
  double most_us_ = 0.0;
};

}  // namespace argil::haptics
