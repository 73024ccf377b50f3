// SPDX-License-Identifier: GPL-3.0-or-later
// The window knows where its own surface is and which way it faces; over the plane that touches it
// there the finest surface is a height, and what a smoothing as wide as a voxel of the window takes
// off that height is the detail that the window has lost.
#include "window/detail_patch.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>
#include <vector>

#include "argil/engine/field_sampler.h"

namespace argil {
namespace {

constexpr int kPatchSide = SurfaceDetail::kSide;
using Heights = std::array<float, kPatchSide * kPatchSide>;

/// Distance and gradient between the nodes of a window; nothing outside it.
std::optional<FieldValue> value_in(const FieldWindowView& window, const Vec3& place) {
  const Vec3 in_nodes = (place - window.origin_mm) / window.voxel_mm;
  std::array<int, 3> low{};
  Vec3 fraction;
  for (std::size_t a = 0; a < 3; ++a) {
    const double at = in_nodes[a];
    if (!(at >= 0.0 && at < window.nodes[a] - 1)) return std::nullopt;
    low[a] = static_cast<int>(at);
    fraction[a] = at - low[a];
  }
  std::array<float, 8> corners{};
  for (int n = 0; n < 8; ++n) {
    corners[static_cast<std::size_t>(n)] =
        window.at(low[0] + (n >> 2), low[1] + (n >> 1 & 1), low[2] + (n & 1));
  }
  const Trilinear cell(corners);
  return FieldValue{cell.value(fraction), cell.slope(fraction) / window.voxel_mm, window.voxel_mm};
}

/// The surface's point nearest to a place as the window has it, and the normal there.
struct Foot {
  Vec3 place_mm;
  Vec3 normal;
};
std::optional<Foot> foot_in(const FieldWindowView& window, const Vec3& place) {
  constexpr int kSteps = 4;
  constexpr double kLeastSlope = 0.2;
  Foot foot{place, {}};
  for (int n = 0; n < kSteps; ++n) {
    const std::optional<FieldValue> at = value_in(window, foot.place_mm);
    if (!at || length(at->gradient) < kLeastSlope) return std::nullopt;
    foot.normal = normalized(at->gradient);
    foot.place_mm -= at->distance_mm * foot.normal;
  }
  return foot;
}

/// Heights of the finest surface over the plane, bounded where it leaves it.
void measure_heights(const Clay& clay, double most_mm, SurfaceDetail& detail) {
  constexpr int kSteps = 3;
  FieldSampler sampler(clay);
  for (int i = 0; i < kPatchSide; ++i) {
    for (int j = 0; j < kPatchSide; ++j) {
      const Vec3 node = detail.origin_mm + i * detail.step_x_mm + j * detail.step_y_mm;
      double height = 0.0;
      for (int n = 0; n < kSteps; ++n) {
        height -= sampler.distance_mm(node + height * detail.normal);
        height = std::clamp(height, -most_mm, most_mm);
      }
      detail.height_mm[static_cast<std::size_t>(i * kPatchSide + j)] = static_cast<float>(height);
    }
  }
}

/// Takes off the plane of least squares, which would count as detail at the patch's edges.
void take_off_plane(Heights& heights) {
  constexpr double kMiddle = 0.5 * (kPatchSide - 1);
  double mean = 0.0;
  double rise_x = 0.0;
  double rise_y = 0.0;
  double square = 0.0;
  const auto each = [](const auto& visit) {
    for (int i = 0; i < kPatchSide; ++i) {
      for (int j = 0; j < kPatchSide; ++j) {
        visit(static_cast<std::size_t>(i * kPatchSide + j), i - kMiddle, j - kMiddle);
      }
    }
  };
  each([&](std::size_t n, double x, double y) {
    const double height = static_cast<double>(heights[n]);
    mean += height;
    rise_x += x * height;
    rise_y += y * height;
    square += x * x;
  });
  mean /= kPatchSide * kPatchSide;
  each([&](std::size_t n, double x, double y) {
    heights[n] -= static_cast<float>(mean + (rise_x * x + rise_y * y) / square);
  });
}

/// One pass of a Gaussian of this standard deviation in nodes, along one side of the patch; at the
/// edges the weights that are left count.
Heights smoothed_along(const Heights& heights, int stride, double deviation) {
  const int reach = std::min(kPatchSide - 1, static_cast<int>(std::ceil(3.0 * deviation)));
  std::vector<double> weights;
  for (int n = 0; n <= reach; ++n)
    weights.push_back(std::exp(-0.5 * n * n / (deviation * deviation)));
  Heights smooth{};
  const int other = kPatchSide + 1 - stride;  // the stride along the other side
  for (int line = 0; line < kPatchSide; ++line) {
    for (int at = 0; at < kPatchSide; ++at) {
      double sum = 0.0;
      double weight = 0.0;
      for (int n = std::max(0, at - reach); n <= std::min(kPatchSide - 1, at + reach); ++n) {
        const double w = weights[static_cast<std::size_t>(std::abs(n - at))];
        sum +=
            w * static_cast<double>(heights[static_cast<std::size_t>(line * other + n * stride)]);
        weight += w;
      }
      smooth[static_cast<std::size_t>(line * other + at * stride)] =
          static_cast<float>(sum / weight);
    }
  }
  return smooth;
}

/// Twice, which leaves nothing of a surface that only bends.
void keep_detail(double voxel_nodes, Heights& heights) {
  take_off_plane(heights);
  for (int pass = 0; pass < 2; ++pass) {
    const Heights smooth =
        smoothed_along(smoothed_along(heights, 1, voxel_nodes), kPatchSide, voxel_nodes);
    for (std::size_t n = 0; n < heights.size(); ++n) heights[n] -= smooth[n];
  }
}

}  // namespace

SurfaceDetail read_detail(const Clay& clay, const FieldWindowView& window, const Vec3& place_mm) {
  SurfaceDetail detail;
  const double step = clay.options().voxel_mm;
  assert(step > 0.0 && window.voxel_mm > 0.0);
  if (!(window.voxel_mm > step)) return detail;
  const std::optional<Foot> foot = foot_in(window, place_mm);
  if (!foot) return detail;
  detail.normal = foot->normal;
  // Beside the axis that it leans away from most.
  const Vec3& n = foot->normal;
  const Vec3 axis = std::abs(n.x) < 0.6 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
  detail.step_x_mm = step * normalized(cross(n, axis));
  detail.step_y_mm = cross(n, detail.step_x_mm);
  detail.origin_mm =
      foot->place_mm - (0.5 * (kPatchSide - 1)) * (detail.step_x_mm + detail.step_y_mm);
  measure_heights(clay, 2.0 * window.voxel_mm, detail);
  keep_detail(window.voxel_mm / step, detail.height_mm);
  detail.is_known = true;
  return detail;
}

}  // namespace argil
