// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/core/triple_buffer.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace argil {
namespace {

/// Every word holds the same number, so that a torn value shows.
using Payload = std::array<std::uint64_t, 64>;

bool is_whole(const Payload& payload) {
  for (const std::uint64_t word : payload) {
    if (word != payload[0]) return false;
  }
  return true;
}

TEST(TripleBuffer, ShowsThePrototypeBeforeTheFirstPublish) {
  TripleBuffer<int> buffer(7);
  EXPECT_FALSE(buffer.fetch());
  EXPECT_EQ(buffer.read_slot(), 7);
}

TEST(TripleBuffer, HandsOverTheNewestAndSkipsOlder) {
  TripleBuffer<int> buffer;
  for (int i = 1; i <= 5; ++i) {
    buffer.write_slot() = i;
    buffer.publish();
  }
  EXPECT_TRUE(buffer.fetch());
  EXPECT_EQ(buffer.read_slot(), 5);
  EXPECT_FALSE(buffer.fetch());
  EXPECT_EQ(buffer.read_slot(), 5);
}

TEST(TripleBuffer, KeepsTheReadersValueWhileTheWriterGoesOn) {
  TripleBuffer<int> buffer;
  buffer.write_slot() = 1;
  buffer.publish();
  ASSERT_TRUE(buffer.fetch());
  const int* held = &buffer.read_slot();
  for (int i = 2; i < 10; ++i) {
    buffer.write_slot() = i;
    EXPECT_NE(&buffer.write_slot(), held);
    buffer.publish();
    EXPECT_EQ(*held, 1);
  }
}

TEST(TripleBuffer, NeverGivesBothSidesTheSameSlot) {
  TripleBuffer<int> buffer;
  for (unsigned step = 0; step < 4096; ++step) {
    // All interleavings of publish and fetch up to 12 steps.
    for (unsigned bit = 0; bit < 12; ++bit) {
      if ((step >> bit & 1U) != 0) {
        buffer.publish();
      } else {
        buffer.fetch();
      }
      ASSERT_NE(&buffer.write_slot(), &buffer.read_slot());
    }
  }
}

/// What is held in one place stays as it is while the other takes newer values, whatever the writer
/// does meanwhile.
TEST(TripleBuffer, HoldsOneValueWhileItTakesAnother) {
  TripleBuffer<int, 2> buffer(7);
  EXPECT_EQ(buffer.read_slot(1), 7);
  int published = 0;
  const auto publish = [&] {
    buffer.write_slot() = ++published;
    buffer.publish();
  };
  std::size_t place = 0;
  int held = 7;
  for (int round = 0; round < 20; ++round) {
    for (int n = 0; n <= round % 4; ++n) publish();
    ASSERT_TRUE(buffer.fetch(place));
    EXPECT_EQ(buffer.read_slot(place), published);
    EXPECT_EQ(buffer.read_slot(1 - place), held);
    for (int n = 0; n < 5; ++n) {
      publish();
      ASSERT_NE(&buffer.write_slot(), &buffer.read_slot(0));
      ASSERT_NE(&buffer.write_slot(), &buffer.read_slot(1));
    }
    EXPECT_EQ(buffer.read_slot(1 - place), held);
    held = buffer.read_slot(place);
    place = 1 - place;
  }
}

TEST(TripleBuffer, LetsTheReaderChangeWhatItHolds) {
  TripleBuffer<int, 2> buffer;
  buffer.write_slot() = 1;
  buffer.publish();
  ASSERT_TRUE(buffer.fetch(1));
  buffer.held_slot(1) = 5;
  EXPECT_EQ(buffer.read_slot(1), 5);
  EXPECT_EQ(buffer.read_slot(0), 0);
}

TEST(TripleBuffer, KeepsTheMemoryOfItsSlots) {
  const std::vector<float> prototype(1000, 0.0F);
  TripleBuffer<std::vector<float>> buffer(prototype);
  std::vector<const float*> seen;
  for (int i = 0; i < 9; ++i) {
    buffer.write_slot().assign(800, static_cast<float>(i));
    seen.push_back(buffer.write_slot().data());
    buffer.publish();
    buffer.fetch();
  }
  std::sort(seen.begin(), seen.end());
  EXPECT_LE(std::unique(seen.begin(), seen.end()) - seen.begin(), 3);
}

TEST(TripleBufferStress, ReaderSeesWholeAndEverNewerValues) {
  constexpr std::uint64_t kLast = 200000;
  TripleBuffer<Payload> buffer;
  std::thread writer([&] {
    for (std::uint64_t i = 1; i <= kLast; ++i) {
      buffer.write_slot().fill(i);
      buffer.publish();
    }
  });
  std::uint64_t newest = 0;
  std::uint64_t torn = 0;
  std::uint64_t older = 0;
  while (newest < kLast) {
    if (!buffer.fetch()) {
      std::this_thread::yield();
      continue;
    }
    torn += is_whole(buffer.read_slot()) ? 0U : 1U;
    older += buffer.read_slot()[0] > newest ? 0U : 1U;
    newest = buffer.read_slot()[0];
  }
  writer.join();
  EXPECT_EQ(torn, 0U);
  EXPECT_EQ(older, 0U);
  EXPECT_EQ(newest, kLast);
}

}  // namespace
}  // namespace argil
