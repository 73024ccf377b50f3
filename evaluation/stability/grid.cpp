// SPDX-License-Identifier: GPL-3.0-or-later
// A geometric grid of stiffness, and the search on it for the first that fails.
#include "stability/grid.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "common/output.h"

namespace argil::evaluation {
namespace {

constexpr double kLeast = 20.0;
constexpr double kMost = 60000.0;

/// The lowest index that fails as `first_failures` says, or none.
std::optional<int> first_where(int start, int last, int stride,
                               const std::function<bool(int)>& fails) {
  assert(0 <= start && start <= last && stride > 0);
  int quiet = start;
  int failing = start;
  if (fails(start)) {
    while (failing > 0) {
      quiet = std::max(0, failing - stride);
      if (!fails(quiet)) break;
      failing = quiet;
    }
    if (failing == 0) return 0;
  } else {
    while (true) {
      if (quiet == last) return std::nullopt;
      failing = std::min(last, quiet + stride);
      if (fails(failing)) break;
      quiet = failing;
    }
  }
  for (int i = quiet + 1; i < failing; ++i) {
    if (fails(i)) return i;
  }
  return failing;
}

}  // namespace

std::vector<double> spread(double least, double most, int count) {
  assert(least > 0.0 && least < most && count > 1);
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    values.push_back(least * std::pow(most / least, static_cast<double>(i) / (count - 1)));
  }
  return values;
}

StiffnessGrid::StiffnessGrid(double ratio)
    : ratio_(ratio), count_(1 + static_cast<int>(std::log(kMost / kLeast) / std::log(ratio))) {
  assert(ratio > 1.0);
}

double StiffnessGrid::at(int i) const {
  assert(i >= 0 && i < count_);
  // From the top down, so that the stiffest is the same on every grid.
  return kMost * std::pow(ratio_, i - (count_ - 1));
}

int StiffnessGrid::nearest(double n_per_m) const {
  assert(n_per_m > 0.0);
  const double below_top = std::log(kMost / n_per_m) / std::log(ratio_);
  return std::clamp(count_ - 1 - static_cast<int>(std::lround(below_top)), 0, count_ - 1);
}

FirstFailures first_failures(const StiffnessGrid& grid, double guess_n_per_m, int stride,
                             const std::function<haptics::Verdict(double)>& judge) {
  std::vector<std::optional<haptics::Verdict>> known(static_cast<std::size_t>(grid.count()));
  const auto verdict = [&](int i) {
    // A hold takes long to simulate, so the two searches share what was judged.
    auto& found = known[static_cast<std::size_t>(i)];
    if (!found) found = judge(grid.at(i));
    return *found;
  };
  const int start = grid.nearest(guess_n_per_m);
  const int last = grid.count() - 1;
  FirstFailures found;
  if (const auto i = first_where(start, last, stride, [&](int n) {
        return verdict(n) == haptics::Verdict::limit_cycle;
      })) {
    found.cycle = grid.at(*i);
  }
  if (const auto i = first_where(start, last, stride,
                                 [&](int n) { return verdict(n) != haptics::Verdict::quiet; })) {
    found.not_quiet = grid.at(*i);
    found.verdict = verdict(*i);
  }
  return found;
}

std::string stiffness_text(const std::optional<double>& n_per_m) {
  return n_per_m ? cli::number(std::round(*n_per_m)) : ">= " + cli::number(kMost);
}

}  // namespace argil::evaluation
