// SPDX-License-Identifier: GPL-3.0-or-later
#include "force/window_field.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace argil::haptics {
namespace {

/// Slope of the field along one axis at a node: central inside, one-sided on a face.
double difference(const FieldWindowView& window, std::array<int, 3> node,
                  std::size_t axis) noexcept {
  assert(node[axis] >= 0 && node[axis] < window.nodes[axis] && window.nodes[axis] >= 2);
  std::array<int, 3> low = node;
  std::array<int, 3> high = node;
  low[axis] = std::max(node[axis] - 1, 0);
  high[axis] = std::min(node[axis] + 1, window.nodes[axis] - 1);
  const double rise = static_cast<double>(window.at(high[0], high[1], high[2])) -
                      static_cast<double>(window.at(low[0], low[1], low[2]));
  return rise / (window.voxel_mm * (high[axis] - low[axis]));
}

/// The cell that a position lies in, and where in it as a fraction of the cell along each axis.
struct CellPosition {
  std::array<int, 3> cell{};
  Vec3 fraction;
};

/// False outside the window.
bool find_cell(const FieldWindowView& window, const Vec3& position_mm, CellPosition& out) noexcept {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double x = (position_mm[axis] - window.origin_mm[axis]) / window.voxel_mm;
    const int last = window.nodes[axis] - 1;
    if (!(x >= 0.0 && x <= last)) return false;  // written so that NaN is outside
    out.cell[axis] = std::min(static_cast<int>(x), last - 1);
    out.fraction[axis] = x - out.cell[axis];
  }
  return true;
}

}  // namespace

Vec3 node_gradient(const FieldWindowView& window, int i, int j, int k) noexcept {
  const std::array<int, 3> node{i, j, k};
  return {difference(window, node, 0), difference(window, node, 1), difference(window, node, 2)};
}

double distance_at(const FieldWindowView& window, const Vec3& position_mm) noexcept {
  CellPosition at;
  if (!find_cell(window, position_mm, at)) return 0.0;
  const auto mix = [](double fraction, double a, double b) { return a + fraction * (b - a); };
  const auto along_z = [&](int di, int dj) {
    const std::array<int, 3>& n = at.cell;
    return mix(at.fraction.z, static_cast<double>(window.at(n[0] + di, n[1] + dj, n[2])),
               static_cast<double>(window.at(n[0] + di, n[1] + dj, n[2] + 1)));
  };
  return mix(at.fraction.x, mix(at.fraction.y, along_z(0, 0), along_z(0, 1)),
             mix(at.fraction.y, along_z(1, 0), along_z(1, 1)));
}

FieldSample sample_field(const FieldWindowView& window, const Vec3& position_mm) noexcept {
  CellPosition at;
  if (!find_cell(window, position_mm, at)) return {};
  FieldSample sample;
  sample.inside = true;
  for (int corner = 0; corner < 8; ++corner) {
    const std::array<int, 3> step{corner >> 2, (corner >> 1) & 1, corner & 1};
    double weight = 1.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      weight *= step[axis] == 1 ? at.fraction[axis] : 1.0 - at.fraction[axis];
    }
    const std::array<int, 3> n{at.cell[0] + step[0], at.cell[1] + step[1], at.cell[2] + step[2]};
    assert(weight >= 0.0 && weight <= 1.0);
    sample.phi_mm += weight * static_cast<double>(window.at(n[0], n[1], n[2]));
    sample.gradient += weight * node_gradient(window, n[0], n[1], n[2]);
  }
  return sample;
}

}  // namespace argil::haptics
