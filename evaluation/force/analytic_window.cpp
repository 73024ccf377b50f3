// SPDX-License-Identifier: GPL-3.0-or-later
// A window of a distance in closed form: what the methods read then has no error of the clay in it.
#include "force/analytic_window.h"

#include <cassert>
#include <cmath>

namespace argil::evaluation {

FieldWindow analytic_window(const Distance& distance_mm, const Vec3& center_mm, double reach_mm,
                            double voxel_mm) {
  assert(voxel_mm > 0.0 && reach_mm >= 0.0);
  FieldWindow window;
  FieldWindowView& view = window.view;
  view.voxel_mm = voxel_mm;
  for (std::size_t a = 0; a < 3; ++a) {
    // On the lattice through the origin, as the clay's own nodes are.
    const double low = std::floor((center_mm[a] - reach_mm) / voxel_mm);
    const double high = std::ceil((center_mm[a] + reach_mm) / voxel_mm);
    view.origin_mm[a] = low * voxel_mm;
    view.nodes[a] = static_cast<int>(high - low) + 1;
  }
  window.storage.reserve(view.index(view.nodes[0], 0, 0));
  for (int i = 0; i < view.nodes[0]; ++i) {
    for (int j = 0; j < view.nodes[1]; ++j) {
      for (int k = 0; k < view.nodes[2]; ++k) {
        const Vec3 step{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
        window.storage.push_back(static_cast<float>(distance_mm(view.origin_mm + voxel_mm * step)));
      }
    }
  }
  assert(window.storage.size() == view.index(view.nodes[0], 0, 0));  // x slowest, none left out
  view.distance_mm = window.storage;
  return window;
}

}  // namespace argil::evaluation
