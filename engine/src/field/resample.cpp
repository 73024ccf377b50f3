// SPDX-License-Identifier: GPL-3.0-or-later
// Catmull-Rom along one axis after the other. The four weights of a node depend on one coordinate
// at a time, so they are found once for each plane, row and column.
#include "field/resample.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <vector>

namespace argil {
namespace {

constexpr std::size_t kTaps = 4;

/// What one node along an axis takes from its four neighbours.
struct Taps {
  std::size_t first = 0;  ///< index of the first of the four in the block
  std::array<float, kTaps> weight{};
};

int cell_of(int node, double ratio) noexcept { return static_cast<int>(std::floor(node * ratio)); }

/// The weights of Keys, a = -1/2, as polynomials in t.
std::vector<Taps> taps_along(int low, int high, double ratio, int block_low) {
  std::vector<Taps> taps;
  taps.reserve(static_cast<std::size_t>(high - low) + 1);
  for (int node = low; node <= high; ++node) {
    const int cell = cell_of(node, ratio);
    const double t = node * ratio - cell;
    Taps at;
    at.first = static_cast<std::size_t>(cell - 1 - block_low);
    at.weight = {static_cast<float>(0.5 * t * (t * (2.0 - t) - 1.0)),
                 static_cast<float>(0.5 * (t * t * (3.0 * t - 5.0) + 2.0)),
                 static_cast<float>(0.5 * t * (t * (4.0 - 3.0 * t) + 1.0)),
                 static_cast<float>(0.5 * t * t * (t - 1.0))};
    taps.push_back(at);
  }
  return taps;
}

/// Interpolates along the middle index of `in`, seen as [outer][n][inner].
void resample_axis(std::span<const float> in, std::size_t n, std::size_t inner,
                   const std::vector<Taps>& taps, std::span<float> out) {
  assert(in.size() % (n * inner) == 0 && out.size() == in.size() / n * taps.size());
  const std::size_t outer = in.size() / (n * inner);
  float* to = out.data();
  for (std::size_t o = 0; o < outer; ++o) {
    for (const Taps& at : taps) {
      const float* from = in.data() + (o * n + at.first) * inner;
      for (std::size_t i = 0; i < inner; ++i) {
        *to++ = at.weight[0] * from[i] + at.weight[1] * from[i + inner] +
                at.weight[2] * from[i + 2 * inner] + at.weight[3] * from[i + 3 * inner];
      }
    }
  }
}

/// What all four taps come to where all nodes coincide.
void copy_box(std::span<const float> from, const NodeBox& from_box, const NodeBox& box,
              std::span<float> out) {
  const std::array<int, 3> n = from_box.sides();
  const auto row = static_cast<std::size_t>(box.sides()[2]);
  float* to = out.data();
  for (int x = box.low.x(); x <= box.high.x(); ++x) {
    for (int y = box.low.y(); y <= box.high.y(); ++y) {
      const Coord at = Coord(x, y, box.low.z()) - from_box.low;
      const auto first = static_cast<std::size_t>((at.x() * n[1] + at.y()) * n[2] + at.z());
      to = std::copy_n(&from[first], row, to);
    }
  }
}

}  // namespace

NodeBox resample_support(const NodeBox& box, double ratio) noexcept {
  NodeBox support;
  for (int axis = 0; axis < 3; ++axis) {
    support.low[axis] = cell_of(box.low[axis], ratio) - 1;
    support.high[axis] = cell_of(box.high[axis], ratio) + 2;
  }
  return support;
}

void resample(std::span<const float> from, const NodeBox& from_box, double ratio,
              const NodeBox& box, std::span<float> out, ResampleScratch& scratch) {
  assert(ratio > 0.0);
  if (ratio == 1.0) return copy_box(from, from_box, box, out);
  const std::array<int, 3> sides = from_box.sides();
  std::array<std::vector<Taps>, 3> taps;
  std::array<std::size_t, 3> n{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    taps[a] = taps_along(box.low[axis], box.high[axis], ratio, from_box.low[axis]);
    n[a] = static_cast<std::size_t>(sides[a]);
    assert(taps[a].back().first + kTaps <= n[a]);
  }
  assert(from.size() == n[0] * n[1] * n[2]);
  assert(out.size() == taps[0].size() * taps[1].size() * taps[2].size());
  // The axis that has whole planes to add up first, so that most of the work runs along memory.
  scratch.planes.resize(taps[0].size() * n[1] * n[2]);
  resample_axis(from, n[0], n[1] * n[2], taps[0], scratch.planes);
  scratch.rows.resize(taps[0].size() * taps[1].size() * n[2]);
  resample_axis(scratch.planes, n[1], n[2], taps[1], scratch.rows);
  resample_axis(scratch.rows, n[2], 1, taps[2], out);
}

}  // namespace argil
