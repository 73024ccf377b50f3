// SPDX-License-Identifier: GPL-3.0-or-later
#include "force/law_table.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace argil::haptics {
namespace {

/// Half width of the filter in voxels.
constexpr double kFilterReach = 2.0;

double cubic_convolution(double s) noexcept {
  const double x = std::abs(s);
  if (x < 1.0) return (1.5 * x - 2.5) * x * x + 1.0;
  return x < 2.0 ? ((-0.5 * x + 2.5) * x - 4.0) * x + 2.0 : 0.0;
}

/// What is tabulated: a function of the density u and its derivative by the distance.
struct Sample {
  double value = 0.0;
  double slope_per_mm = 0.0;
};

/// Gauss-Legendre over one stretch on which filter and law are both smooth.
template <class Function>
Sample integrate_stretch(const Function& function, double phi_mm, double voxel_mm, double from,
                         double to) {
  constexpr std::array<double, 3> kNode{0.2386191860831969, 0.6612093864662645, 0.9324695142031521};
  constexpr std::array<double, 3> kWeight{0.4679139345726910, 0.3607615730481386,
                                          0.1713244923791704};
  assert(from < to && from >= -kFilterReach && to <= kFilterReach);
  const double middle = 0.5 * (from + to);
  const double half = 0.5 * (to - from);
  Sample sum;
  for (std::size_t n = 0; n < 6; ++n) {
    const double s = middle + half * (n < 3 ? kNode[n] : -kNode[n - 3]);
    const double weight = half * kWeight[n % 3] * cubic_convolution(s);
    const Sample here = function(phi_mm + s * voxel_mm);
    sum.value += weight * here.value;
    sum.slope_per_mm += weight * here.slope_per_mm;
  }
  return sum;
}

/// The law convolved with the filter at one distance, stretch by stretch between kinks of either.
template <class Function>
Sample filtered(const ContactLaw& law, const Function& function, double phi_mm, double voxel_mm) {
  const double outer = (law.skin_mm() - phi_mm) / voxel_mm;  // the kinks of the law
  const double inner = outer - law.clamp_density() * law.skin_mm() / voxel_mm;
  const auto inside = [](double s) { return std::clamp(s, -kFilterReach, kFilterReach); };
  std::array<double, 7> end{-2.0, -1.0, 0.0, 1.0, 2.0, inside(outer), inside(inner)};
  std::sort(end.begin(), end.end());
  Sample sum;
  for (std::size_t n = 0; n + 1 < end.size(); ++n) {
    if (end[n + 1] <= end[n]) continue;
    const Sample part = integrate_stretch(function, phi_mm, voxel_mm, end[n], end[n + 1]);
    sum.value += part.value;
    sum.slope_per_mm += part.slope_per_mm;
  }
  return sum;
}

/// Cubic Hermite pieces between 33 filtered samples.
template <class Function>
LawTable tabulate(const ContactLaw& law, const Function& function, double voxel_mm) {
  assert(voxel_mm > 0.0);
  const double outermost = law.skin_mm() + kFilterReach * voxel_mm;
  const double innermost = law.skin_mm() * (1.0 - law.clamp_density()) - kFilterReach * voxel_mm;
  // The first piece holds the straight line inside, the last one zero: both hold beyond it.
  const double step = (outermost - innermost) / (kLawSegments - 2);
  assert(step > 0.0);
  LawTable table;
  table.low_mm = innermost - step;
  table.per_mm = 1.0 / step;
  Sample left = filtered(law, function, table.low_mm, voxel_mm);
  for (std::size_t n = 0; n < kLawSegments; ++n) {
    const bool last = n + 1 == kLawSegments;
    const double phi_mm = table.low_mm + step * static_cast<double>(n + 1);
    const Sample right = last ? Sample{} : filtered(law, function, phi_mm, voxel_mm);
    if (last) left = {};
    const double rise = right.value - left.value;
    const double slope_left = step * left.slope_per_mm;
    const double slope_right = step * right.slope_per_mm;
    table.coefficient[0][n] = static_cast<float>(left.value);
    table.coefficient[1][n] = static_cast<float>(slope_left);
    table.coefficient[2][n] = static_cast<float>(3.0 * rise - 2.0 * slope_left - slope_right);
    table.coefficient[3][n] = static_cast<float>(slope_left + slope_right - 2.0 * rise);
    left = right;
  }
  table.coefficient[2][0] = table.coefficient[3][0] = 0.0F;  // rounding only; it stays straight
  return table;
}

}  // namespace

double LawTable::at(double phi_mm) const noexcept {
  assert(per_mm > 0.0);
  const double x = (phi_mm - low_mm) * per_mm;
  const auto n = static_cast<std::size_t>(std::clamp(x, 0.0, kLawSegments - 1.0));
  const double s = std::min(x - static_cast<double>(n), 1.0);
  const auto c = [&](std::size_t power) { return static_cast<double>(coefficient[power][n]); };
  return ((c(3) * s + c(2)) * s + c(1)) * s + c(0);
}

LawTable filtered_potential(const ContactLaw& law, double voxel_mm) noexcept {
  const auto potential = [&](double phi_mm) {
    const double u = law.density(phi_mm);
    return Sample{law.potential_nmm(u), -law.force_n(u)};
  };
  return tabulate(law, potential, voxel_mm);
}

LawTable filtered_pressure(const ContactLaw& law, double voxel_mm) noexcept {
  const auto pressure = [&](double phi_mm) {
    const double u = law.density(phi_mm);
    return Sample{law.force_n(u), -law.force_rate_n_per_mm(u)};
  };
  return tabulate(law, pressure, voxel_mm);
}

}  // namespace argil::haptics
