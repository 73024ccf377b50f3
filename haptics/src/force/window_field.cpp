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

/// Of the four nodes around a fraction of a cell, and how they change with it.
struct CubicWeights {
  std::array<double, 4> value;
  std::array<double, 4> slope;
};

CubicWeights cubic_weights(double t) noexcept {
  const double t2 = t * t;
  const double t3 = t2 * t;
  return {{0.5 * (-t3 + 2.0 * t2 - t), 0.5 * (3.0 * t3 - 5.0 * t2 + 2.0),
           0.5 * (-3.0 * t3 + 4.0 * t2 + t), 0.5 * (t3 - t2)},
          {0.5 * (-3.0 * t2 + 4.0 * t - 1.0), 0.5 * (9.0 * t2 - 10.0 * t),
           0.5 * (-9.0 * t2 + 8.0 * t + 1.0), 0.5 * (3.0 * t2 - 2.0 * t)}};
}

}  // namespace

Vec3 node_gradient(const FieldWindowView& window, int i, int j, int k) noexcept {
  const std::array<int, 3> node{i, j, k};
  return {difference(window, node, 0), difference(window, node, 1), difference(window, node, 2)};
}

bool is_inside(const FieldWindowView& window, const Vec3& position_mm) noexcept {
  CellPosition at;
  return find_cell(window, position_mm, at);
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

FieldSample sample_cubic(const FieldWindowView& window, const Vec3& position_mm) noexcept {
  CellPosition at;
  if (!find_cell(window, position_mm, at)) return {};
  std::array<CubicWeights, 3> weights;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (at.cell[axis] < 1 || at.cell[axis] + 2 >= window.nodes[axis]) return {};
    weights[axis] = cubic_weights(at.fraction[axis]);
  }
  FieldSample sample;
  sample.inside = true;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      double value = 0.0;
      double slope = 0.0;
      for (std::size_t k = 0; k < 4; ++k) {
        const double node = static_cast<double>(window.at(at.cell[0] - 1 + static_cast<int>(i),
                                                          at.cell[1] - 1 + static_cast<int>(j),
                                                          at.cell[2] - 1 + static_cast<int>(k)));
        value += weights[2].value[k] * node;
        slope += weights[2].slope[k] * node;
      }
      sample.phi_mm += weights[0].value[i] * weights[1].value[j] * value;
      sample.gradient += Vec3{weights[0].slope[i] * weights[1].value[j] * value,
                              weights[0].value[i] * weights[1].slope[j] * value,
                              weights[0].value[i] * weights[1].value[j] * slope};
    }
  }
  sample.gradient = sample.gradient / window.voxel_mm;
  return sample;
}

}  // namespace argil::haptics
