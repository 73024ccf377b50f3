// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "argil/haptics/analysis/hold_judgement.h"

namespace argil::evaluation {

/// `count` numbers, two at least, a constant ratio apart and rising, both ends among them.
std::vector<double> spread(double least, double most, int count);

/// Stiffnesses a constant ratio apart, from about 20 to exactly 60000 N/m.
class StiffnessGrid {
 public:
  /// `ratio` above 1.
  explicit StiffnessGrid(double ratio);
  double at(int i) const;
  int count() const { return count_; }
  int nearest(double n_per_m) const;

 private:
  double ratio_;
  int count_;
};

/// The first stiffness at which a hold is not quiet, and the first at which it is a limit cycle.
struct FirstFailures {
  std::optional<double> not_quiet;                     ///< none: quiet up to the stiffest
  haptics::Verdict verdict = haptics::Verdict::quiet;  ///< at not_quiet
  std::optional<double> cycle;
};

/// Looks for both from `guess_n_per_m` on: in strides of `stride` steps, down while it fails and up
/// until it does, then step by step between the last two. What fails between two strides of a
/// quiet stretch is not seen.
FirstFailures first_failures(const StiffnessGrid& grid, double guess_n_per_m, int stride,
                             const std::function<haptics::Verdict(double)>& judge);

/// As the files write it: the number, or ">= 60000".
std::string stiffness_text(const std::optional<double>& n_per_m);

}  // namespace argil::evaluation
