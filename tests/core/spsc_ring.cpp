// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/core/spsc_ring.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <thread>

#include <gtest/gtest.h>

namespace argil {
namespace {

TEST(SpscRing, RoundsItsCapacityUpToAPowerOfTwo) {
  EXPECT_EQ(SpscRing<int>(1).capacity(), 1U);
  EXPECT_EQ(SpscRing<int>(5).capacity(), 8U);
  EXPECT_EQ(SpscRing<int>(64).capacity(), 64U);
}

TEST(SpscRing, GivesValuesBackInOrder) {
  SpscRing<int> ring(4);
  int value = 0;
  EXPECT_FALSE(ring.pop(value));
  for (int round = 0; round < 100; ++round) {
    EXPECT_TRUE(ring.push(2 * round));
    EXPECT_TRUE(ring.push(2 * round + 1));
    for (const int expected : {2 * round, 2 * round + 1}) {
      ASSERT_TRUE(ring.pop(value));
      EXPECT_EQ(value, expected);
    }
  }
  EXPECT_EQ(ring.dropped(), 0U);
}

TEST(SpscRing, DropsAndCountsTheNewWhenFull) {
  SpscRing<int> ring(4);
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(ring.push(i));
  for (int i = 4; i < 11; ++i) EXPECT_FALSE(ring.push(i));
  EXPECT_EQ(ring.dropped(), 7U);
  int value = -1;
  ASSERT_TRUE(ring.pop(value));
  EXPECT_EQ(value, 0);
  EXPECT_TRUE(ring.push(11));
  for (const int expected : {1, 2, 3, 11}) {
    ASSERT_TRUE(ring.pop(value));
    EXPECT_EQ(value, expected);
  }
  EXPECT_FALSE(ring.pop(value));
  EXPECT_EQ(ring.dropped(), 7U);
}

struct Sample {
  std::array<std::uint64_t, 8> words{};
};

/// Pushes 0, 1, 2, ... and counts what was refused; yields now and then so that both ends of the
/// ring, full and empty, are met on any machine.
std::uint64_t produce(SpscRing<Sample>& ring, std::uint64_t count) {
  std::uint64_t refused = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    Sample sample;
    sample.words.fill(i);
    refused += ring.push(sample) ? 0U : 1U;
    if (i % 257 == 0) std::this_thread::yield();
  }
  return refused;
}

TEST(SpscRingStress, KeepsOrderAndCountsEveryDrop) {
  constexpr std::uint64_t kCount = 300000;
  SpscRing<Sample> ring(16);
  std::atomic<bool> done{false};
  std::uint64_t refused = 0;
  std::thread producer([&] {
    refused = produce(ring, kCount);
    done.store(true, std::memory_order_release);
  });
  std::uint64_t received = 0;
  std::uint64_t torn = 0;
  std::uint64_t disordered = 0;
  std::uint64_t next = 0;
  for (Sample sample;;) {
    const bool finished = done.load(std::memory_order_acquire);
    if (!ring.pop(sample)) {
      if (finished) break;
      std::this_thread::yield();
      continue;
    }
    ++received;
    for (const std::uint64_t word : sample.words) torn += word == sample.words[0] ? 0U : 1U;
    disordered += sample.words[0] >= next ? 0U : 1U;
    next = sample.words[0] + 1;
  }
  producer.join();
  EXPECT_EQ(torn, 0U);
  EXPECT_EQ(disordered, 0U);
  EXPECT_EQ(ring.dropped(), refused);
  EXPECT_EQ(received + refused, kCount);
  EXPECT_GT(received, 0U);
}

}  // namespace
}  // namespace argil
