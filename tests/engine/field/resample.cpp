// SPDX-License-Identifier: GPL-3.0-or-later
#include "field/resample.h"

#include <cmath>
#include <cstdlib>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

namespace argil {
namespace {

using ResampledField = std::function<double(double, double, double)>;

std::vector<float> nodes_of_field(const ResampledField& field, const NodeBox& box, double spacing) {
  std::vector<float> values;
  for (int x = box.low.x(); x <= box.high.x(); ++x) {
    for (int y = box.low.y(); y <= box.high.y(); ++y) {
      for (int z = box.low.z(); z <= box.high.z(); ++z) {
        values.push_back(static_cast<float>(field(spacing * x, spacing * y, spacing * z)));
      }
    }
  }
  return values;
}

/// The greatest error at the nodes of a lattice of that spacing, of one of spacing 1.
double worst_resampled(const ResampledField& field, double ratio) {
  const NodeBox box{Coord(-9, -7, -11), Coord(6, 9, 8)};
  const NodeBox support = resample_support(box, ratio);
  std::vector<float> out(box.count());
  ResampleScratch scratch;
  resample(nodes_of_field(field, support, 1.0), support, ratio, box,
           static_cast<float>(kCreasedVoxels), out, scratch);
  const std::vector<float> wanted = nodes_of_field(field, box, ratio);
  double worst = 0.0;
  for (std::size_t n = 0; n < out.size(); ++n) {
    worst = std::max(worst, static_cast<double>(std::abs(out[n] - wanted[n])));
  }
  return worst;
}

TEST(Resample, IsExactForQuadrics) {
  const ResampledField quadric = [](double x, double y, double z) {
    return 0.01 * (x * x - 2.0 * y * y + x * z) + 0.3 * y - z + 2.0;
  };
  for (const double ratio : {0.25, 0.5, 0.65, 1.0, 1.3})
    EXPECT_LT(worst_resampled(quadric, ratio), 1e-5);
}

/// A tap beyond a crease would ring by an eighth of what the slope jumps there.
TEST(Resample, DoesNotRingBesideACrease) {
  for (const double ratio : {0.25, 0.5}) {
    const ResampledField sheet = [](double, double y, double) { return std::abs(y) - 1.0; };
    EXPECT_LT(worst_resampled(sheet, ratio), 0.01) << "nodes every " << ratio;
    const ResampledField edge = [](double x, double, double z) {
      return std::max(x - 2.0, z + 1.0);
    };
    EXPECT_LT(worst_resampled(edge, ratio), 0.26) << "nodes every " << ratio;
  }
}

}  // namespace
}  // namespace argil
