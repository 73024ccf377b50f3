// SPDX-License-Identifier: GPL-3.0-or-later
#include "chart/analytic_window.h"

#include <cmath>

namespace argil::cli::chart {
AnalyticWindow analytic_window(const Distance& distance_mm, const Vec3& center_mm, double reach_mm,
                               double voxel_mm) {
  AnalyticWindow window;
  window.view.voxel_mm = voxel_mm;
  for (std::size_t a = 0; a < 3; ++a) {
    const double low = std::floor((center_mm[a] - reach_mm) / voxel_mm);
    window.view.origin_mm[a] = low * voxel_mm;
    window.view.nodes[a] =
        static_cast<int>(std::ceil((center_mm[a] + reach_mm) / voxel_mm) - low) + 1;
  }
  const auto& n = window.view.nodes;
  window.values.reserve(static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1]) *
                        static_cast<std::size_t>(n[2]));
  for (int i = 0; i < n[0]; ++i) {
    for (int j = 0; j < n[1]; ++j) {
      for (int k = 0; k < n[2]; ++k) {
        const Vec3 step{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
        window.values.push_back(
            static_cast<float>(distance_mm(window.view.origin_mm + voxel_mm * step)));
      }
    }
  }
  window.view.distance_mm = window.values;
  return window;
}

}  // namespace argil::cli::chart
