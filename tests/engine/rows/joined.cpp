// SPDX-License-Identifier: GPL-3.0-or-later
// What a clay and its feet say of a leaf's nodes, joined by every instruction set.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "rows/rows.h"

namespace argil {
namespace {

constexpr int kJoinedNodes = kLeafRows * kRowNodes;
using JoinedNodes = std::array<float, kJoinedNodes>;

struct JoinedCase {
  JoinedNodes near;
  std::array<JoinedNodes, 2> told;
  JoinJob job{};
};

/// Nodes on both sides, some at the surface, some at the end of the band (where feet are believed)
/// or, as a coarser level tells it, beyond, some of which feet say nothing.
JoinedCase some_joined(std::mt19937& dice) {
  std::uniform_real_distribution<float> clay(-4.0F, 4.0F);
  std::uniform_real_distribution<float> feet(0.0F, 8.0F);
  JoinedCase made;
  for (std::size_t n = 0; n < kJoinedNodes; ++n) {
    made.near[n] = n % 37 == 0 ? 0.0F : n % 5 == 0 ? std::copysign(3.0F, clay(dice)) : clay(dice);
    for (JoinedNodes& told : made.told) told[n] = n % 11 == 0 ? 8.0F : feet(dice);
  }
  return made;
}

/// In voxels; which sides feet are asked about by two bits.
void set_job(JoinedCase& joined, unsigned asked, float offset) {
  JoinJob& job = joined.job;
  job.near = joined.near.data();
  for (unsigned side = 0; side < 2; ++side) {
    job.told[side] = (asked >> side & 1U) != 0 ? joined.told[side].data() : nullptr;
  }
  job.low = 1.05F;
  job.high = 2.1F;
  job.known = 3.0F;
  job.stretch = 1.5F;
  job.limit = 8.0F;
  job.offset = offset;
  job.band = 3.0F;
}

float joined_by_hand(const JoinJob& job, std::size_t n) {
  const float near = job.near[n];
  const float size = std::abs(near);
  const float* told = job.told[near < 0.0F ? 1 : 0];
  float value = near;
  if (size > job.low && told != nullptr) {
    float far = told[n];
    if (size < job.known) {
      far = far < job.limit ? std::clamp(far, size / job.stretch, size * job.stretch) : size;
    }
    const float share = std::clamp((job.high - size) / (job.high - job.low), 0.0F, 1.0F);
    value = std::copysign(std::max(share * size + (1.0F - share) * far, job.low), near);
  }
  return std::clamp(value - job.offset, -job.band, job.band);
}

TEST(Rows, JoinWhatClayAndFeetSayByThePlainFormula) {
  std::mt19937 dice(7);
  for (const unsigned asked : {0U, 1U, 2U, 3U}) {
    for (const float offset : {0.0F, 2.0F, -2.0F}) {
      JoinedCase joined = some_joined(dice);
      set_job(joined, asked, offset);
      JoinedNodes plain;
      JoinedNodes fastest;
      baseline::kRowLoops.join_told(joined.job, plain.data());
      row_loops().join_told(joined.job, fastest.data());
      ASSERT_EQ(plain, fastest) << asked << " " << offset;
      for (std::size_t n = 0; n < kJoinedNodes; ++n) {
        ASSERT_EQ(plain[n], joined_by_hand(joined.job, n)) << asked << " " << offset << " " << n;
      }
    }
  }
}

}  // namespace
}  // namespace argil
