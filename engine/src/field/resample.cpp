// SPDX-License-Identifier: GPL-3.0-or-later
// Catmull-Rom along one axis after the other, straight across creases.
#include "field/resample.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <vector>

namespace argil {
namespace {

constexpr std::size_t kTaps = 4;

int cell_of(int node, double ratio) noexcept { return static_cast<int>(std::floor(node * ratio)); }

void set_places(int low, int high, double ratio, int block_low, std::vector<CurvePlace>& places) {
  places.clear();
  for (int node = low; node <= high; ++node) {
    const int cell = cell_of(node, ratio);
    places.push_back({cell - 1 - block_low, static_cast<float>(node * ratio - cell)});
  }
}

/// Interpolates along the middle index of `in`, seen as [outer][n][inner].
void resample_axis(std::span<const float> in, std::size_t n, std::size_t inner,
                   std::span<const CurvePlace> places, float crease, std::span<float> out) {
  assert(in.size() % (n * inner) == 0 && out.size() == in.size() / n * places.size());
  row_loops().curve_along(
      {in.data(), static_cast<int>(in.size() / (n * inner)), static_cast<int>(n),
       static_cast<int>(inner), places.data(), static_cast<int>(places.size()), crease},
      out.data());
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
              const NodeBox& box, float crease, std::span<float> out, ResampleScratch& scratch) {
  assert(ratio > 0.0 && crease >= 0.0F);
  if (ratio == 1.0) return copy_box(from, from_box, box, out);
  const std::array<int, 3> sides = from_box.sides();
  auto& places = scratch.places;
  std::array<std::size_t, 3> n{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    set_places(box.low[axis], box.high[axis], ratio, from_box.low[axis], places[a]);
    n[a] = static_cast<std::size_t>(sides[a]);
    assert(static_cast<std::size_t>(places[a].back().first) + kTaps <= n[a]);
  }
  assert(from.size() == n[0] * n[1] * n[2]);
  assert(out.size() == places[0].size() * places[1].size() * places[2].size());
  // The axis that has whole planes to add up first, so that most of the work runs along memory.
  scratch.planes.resize(places[0].size() * n[1] * n[2]);
  resample_axis(from, n[0], n[1] * n[2], places[0], crease, scratch.planes);
  scratch.rows.resize(places[0].size() * places[1].size() * n[2]);
  resample_axis(scratch.planes, n[1], n[2], places[1], crease, scratch.rows);
  resample_axis(scratch.rows, n[2], 1, places[2], crease, out);
}

}  // namespace argil
