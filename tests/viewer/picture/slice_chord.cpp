// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture/slice_chord.h"

#include <cmath>

#include <gtest/gtest.h>

namespace argil::viewer {
namespace {

/// Of distances on the plane y = 2, 40 mm square, 0.25 mm from value to value.
template <class Distance>
SlicePicture slice_of(const Distance& distance) {
  SlicePicture slice{{-20.0, 2.0, 20.0}, {40.0, 0.0, 0.0}, {0.0, 0.0, -40.0}, 161, 161, {}};
  for (int row = 0; row < slice.rows; ++row) {
    for (int column = 0; column < slice.columns; ++column) {
      slice.distance_mm.push_back(
          static_cast<float>(distance(-20.0 + 0.25 * column, 20.0 - 0.25 * row)));
    }
  }
  return slice;
}

/// Along the view at a place of the plane.
std::optional<Chord> chord_at(const SlicePicture& slice, double x, double z) {
  const Vec3 eye{3.0, -60.0, 5.0};
  return shortest_chord(slice, {eye, normalized(Vec3{x, 2.0, z} - eye)});
}

TEST(SliceChord, OfARingIsItsWallWhereverThePointerIs) {
  const SlicePicture ring =
      slice_of([](double x, double z) { return std::abs(std::hypot(x, z) - 12.0) - 1.5; });
  for (double angle = 0.0; angle < 6.28; angle += 0.1) {
    for (const double radius : {10.8, 12.0, 13.2}) {
      const auto chord = chord_at(ring, radius * std::cos(angle), radius * std::sin(angle));
      ASSERT_TRUE(chord) << angle;
      EXPECT_NEAR(length(chord->to_mm - chord->from_mm), 3.0, 0.02) << angle;
      EXPECT_NEAR(std::hypot(chord->from_mm.x, chord->from_mm.z) +
                      std::hypot(chord->to_mm.x, chord->to_mm.z),
                  24.0, 0.05);
      EXPECT_DOUBLE_EQ(chord->from_mm.y, 2.0);
    }
  }
  EXPECT_FALSE(chord_at(ring, 0.0, 0.0)) << "the cavity";
  EXPECT_FALSE(chord_at(ring, 16.0, 0.0)) << "beside it";
}

TEST(SliceChord, OfASlabThatLeavesTheSliceIsAcrossIt) {
  const SlicePicture slab = slice_of([](double, double z) { return std::abs(z - 1.0) - 2.0; });
  const auto chord = chord_at(slab, 18.0, 0.5);
  ASSERT_TRUE(chord);
  EXPECT_NEAR(length(chord->to_mm - chord->from_mm), 4.0, 0.01);
  const SlicePicture full = slice_of([](double, double) { return -1.0; });
  EXPECT_FALSE(chord_at(full, 0.0, 0.0));
}

TEST(SliceChord, OfARayThatDoesNotMeetTheSliceIsNothing) {
  const SlicePicture full = slice_of([](double, double z) { return std::abs(z) - 1.0; });
  EXPECT_FALSE(shortest_chord(full, {{0.0, -60.0, 0.0}, {1.0, 0.0, 0.0}})) << "along it";
  EXPECT_FALSE(shortest_chord(full, {{0.0, -60.0, 0.0}, {0.0, -1.0, 0.0}})) << "away from it";
  EXPECT_FALSE(chord_at(full, 30.0, 0.0)) << "beyond its edge";
}

}  // namespace
}  // namespace argil::viewer
