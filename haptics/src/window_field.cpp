// SPDX-License-Identifier: GPL-3.0-or-later
#include "window_field.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace argil::haptics {
namespace {

double difference(const FieldWindowView& window, std::array<int, 3> node,
                  std::size_t axis) noexcept {
  std::array<int, 3> low = node;
  std::array<int, 3> high = node;
  low[axis] = std::max(node[axis] - 1, 0);
  high[axis] = std::min(node[axis] + 1, window.nodes[axis] - 1);
  const double rise = static_cast<double>(window.at(high[0], high[1], high[2])) -
                      static_cast<double>(window.at(low[0], low[1], low[2]));
  return rise / (window.voxel_mm * (high[axis] - low[axis]));
}

/// The cell that a place lies in, and where in it.
struct CellPlace {
  std::array<int, 3> cell{};
  Vec3 share;
};

/// False outside the window.
bool find_cell(const FieldWindowView& window, const Vec3& place_mm, CellPlace& out) noexcept {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double x = (place_mm[axis] - window.origin_mm[axis]) / window.voxel_mm;
    const int last = window.nodes[axis] - 1;
    if (!(x >= 0.0 && x <= last)) return false;  // written so that NaN is outside
    out.cell[axis] = std::min(static_cast<int>(x), last - 1);
    out.share[axis] = x - out.cell[axis];
  }
  return true;
}

}  // namespace

Vec3 node_gradient(const FieldWindowView& window, int i, int j, int k) noexcept {
  const std::array<int, 3> node{i, j, k};
  return {difference(window, node, 0), difference(window, node, 1), difference(window, node, 2)};
}

double distance_at(const FieldWindowView& window, const Vec3& place_mm) noexcept {
  CellPlace place;
  if (!find_cell(window, place_mm, place)) return 0.0;
  const auto mix = [](double share, double a, double b) { return a + share * (b - a); };
  const auto along_z = [&](int di, int dj) {
    const std::array<int, 3>& n = place.cell;
    return mix(place.share.z, static_cast<double>(window.at(n[0] + di, n[1] + dj, n[2])),
               static_cast<double>(window.at(n[0] + di, n[1] + dj, n[2] + 1)));
  };
  return mix(place.share.x, mix(place.share.y, along_z(0, 0), along_z(0, 1)),
             mix(place.share.y, along_z(1, 0), along_z(1, 1)));
}

FieldSample sample_field(const FieldWindowView& window, const Vec3& place_mm) noexcept {
  CellPlace place;
  if (!find_cell(window, place_mm, place)) return {};
  FieldSample sample;
  sample.inside = true;
  for (int corner = 0; corner < 8; ++corner) {
    const std::array<int, 3> step{corner >> 2, (corner >> 1) & 1, corner & 1};
    double weight = 1.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      weight *= step[axis] == 1 ? place.share[axis] : 1.0 - place.share[axis];
    }
    const std::array<int, 3> n{place.cell[0] + step[0], place.cell[1] + step[1],
                               place.cell[2] + step[2]};
    sample.phi_mm += weight * static_cast<double>(window.at(n[0], n[1], n[2]));
    sample.gradient += weight * node_gradient(window, n[0], n[1], n[2]);
  }
  return sample;
}

}  // namespace argil::haptics
