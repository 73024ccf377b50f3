// SPDX-License-Identifier: GPL-3.0-or-later
// What one leaf's points say of its layers where the field is no plane: beside creases, around
// edges and balls. Lengths are in voxels.
#include "feet/layer_feet.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include <gtest/gtest.h>

#include "argil/core/vec3.h"

namespace argil {
namespace {

using LeafFormula = std::function<double(const Vec3&)>;

/// About the middle of the leaf, as a level's band holds it.
LeafAndFaces leaf_of(const LeafFormula& distance) {
  constexpr double kBand = kHalfWidthVoxels;
  LeafAndFaces values{};
  std::size_t n = 0;
  for (int i = -1; i <= kLeafSide; ++i) {
    for (int j = -1; j <= kLeafSide; ++j) {
      for (int k = -1; k <= kLeafSide; ++k) {
        const Vec3 at{i - 3.5, j - 3.5, k - 3.5};
        values[n++] = static_cast<float>(std::clamp(distance(at), -kBand, kBand));
      }
    }
  }
  return values;
}

struct PlacedFoot {
  Vec3 place;  ///< about the middle of the leaf
  Vec3 normal;
  double bend;
};

std::vector<PlacedFoot> feet_of(const LayerFeet& layer) {
  std::vector<PlacedFoot> feet;
  for (int n = 0; n < layer.count(); ++n) {
    const auto of = [&](int field) { return static_cast<double>(layer.field(field)[n]); };
    if (of(LayerFeet::kX) >= static_cast<double>(kNowhere)) continue;
    feet.push_back({{of(LayerFeet::kX) - 3.5, of(LayerFeet::kY) - 3.5, of(LayerFeet::kZ) - 3.5},
                    {of(LayerFeet::kNormalX), of(LayerFeet::kNormalY), of(LayerFeet::kNormalZ)},
                    of(LayerFeet::kBend)});
  }
  return feet;
}

/// Two unit normals at right angles, any way round.
struct Faces {
  Vec3 a;
  Vec3 b;
};

Faces random_faces(std::mt19937& random) {
  std::normal_distribution<double> any;
  const Vec3 a = normalized(Vec3{any(random), any(random), any(random)});
  const Vec3 b = normalized(cross(a, Vec3{any(random), any(random), any(random)}));
  return {a, b};
}

/// Inside an edge the nearest point jumps from face to face: a slope that is taken across both
/// would point between them, as three quarters of central differences do, and every node beyond
/// would be told a wrong distance by it.
TEST(LayerFeet, MostlyBelongToOneSideOfACrease) {
  std::mt19937 random(5);
  int feet = 0;
  int mixed = 0;
  for (int n = 0; n < 50; ++n) {
    const Faces faces = random_faces(random);
    const LeafLayers layers = find_layers(
        leaf_of([&](const Vec3& p) { return std::max(dot(faces.a, p), dot(faces.b, p)); }), 1.0,
        false);
    for (const PlacedFoot& foot : feet_of(layers[1])) {
      const double to_a = -dot(faces.a, foot.normal);
      const double to_b = -dot(faces.b, foot.normal);
      ++feet;
      if (std::max(to_a, to_b) < std::cos(0.03)) ++mixed;
    }
  }
  EXPECT_GT(feet, 1000);
  EXPECT_LT(mixed, feet / 4) << feet;
}

/// Rays from an edge part in one direction only: the layer bends there by its radius, and half of
/// that, the mean, is what is believed where no axis tells the direction.
TEST(LayerFeet, BendAcrossAnEdge) {
  constexpr double kBend = 1.0 / kLayerVoxels;
  std::mt19937 random(6);
  double sum = 0.0;
  int feet = 0;
  for (int n = 0; n < 50; ++n) {
    const Faces faces = random_faces(random);
    const LeafLayers layers =
        find_layers(leaf_of([&](const Vec3& p) {
                      const double a = dot(faces.a, p);
                      const double b = dot(faces.b, p);
                      return std::min(a, b) > 0.0 ? std::hypot(a, b) : std::max(a, b);
                    }),
                    1.0, false);
    for (const PlacedFoot& foot : feet_of(layers[0])) {
      if (std::min(dot(faces.a, foot.place), dot(faces.b, foot.place)) < 1.0) continue;
      EXPECT_GT(foot.bend, 0.4 * kBend);
      EXPECT_LE(foot.bend, kBend);
      sum += foot.bend;
      ++feet;
    }
  }
  EXPECT_GT(feet, 50);
  EXPECT_GT(sum / feet, 0.75 * kBend) << feet;
}

TEST(LayerFeet, BendAsABallDoes) {
  constexpr double kBallRadius = 1.6 + kLayerVoxels;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-0.5, 0.5);
  for (int n = 0; n < 20; ++n) {
    const Vec3 center{shift(random), shift(random), shift(random)};
    const LeafLayers layers =
        find_layers(leaf_of([&](const Vec3& p) { return length(p - center) - 1.6; }), 1.0, false);
    double sum = 0.0;
    const std::vector<PlacedFoot> feet = feet_of(layers[0]);
    for (const PlacedFoot& foot : feet) {
      EXPECT_NEAR(length(foot.place - center), kBallRadius, 0.1);
      sum += foot.bend;
    }
    ASSERT_GT(feet.size(), 30U);
    EXPECT_NEAR(sum / static_cast<double>(feet.size()), 1.0 / kBallRadius, 0.1 / kBallRadius);
  }
}

}  // namespace
}  // namespace argil
