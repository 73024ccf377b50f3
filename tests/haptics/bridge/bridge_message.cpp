// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/bridge/bridge_message.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace argil::haptics {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::byte>;

/// The corpus was written by examples/blender/argil_bridge.py.
const fs::path kCorpus = "tests/corpus/bridge";

Bytes bytes_of_file(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  Bytes bytes(text.size());
  std::transform(text.begin(), text.end(), bytes.begin(),
                 [](char c) { return static_cast<std::byte>(c); });
  return bytes;
}

/// In a block of just that size, so that a sanitizer sees one byte over.
std::optional<BridgeMessage> decode_exactly(const Bytes& bytes) {
  const auto block = std::make_unique<std::byte[]>(bytes.size());
  std::copy(bytes.begin(), bytes.end(), block.get());
  return decode({block.get(), bytes.size()});
}

std::vector<BridgeMessage> one_of_each() {
  BridgeProxy proxy;
  proxy.header = {4, 4000, kBridgeContact | kBridgePlane};
  proxy.echo_sequence = 3;
  proxy.echo_time_ns = 3000;
  proxy.position_mm = {1.0, 0.0, 3.5};
  proxy.orientation = {0.6, 0.0, 0.8, 0.0};
  proxy.velocity_mm_per_s = {5.0, 0.0, -5.0};
  proxy.plane_point_mm = {1.0, 0.0, 3.5};
  proxy.direct_force_n = {0.0, 3.0, 0.0};
  proxy.distance_mm = -2.0;
  return {
      BridgeHello{{1, 1000, 0}, 60.0},
      BridgeWelcome{{2, 2000, kBridgeLockstep}, 1000.0, 1500.0, 2.5, 4.0, 1},
      BridgeState{
          {3, 3000, kBridgeFrame}, {1.0, -2.0, 3.5}, {10.0, -20.0, 30.0}, {0.25, 2.5, -0.125}, 1},
      proxy, BridgeBye{{5, 5000, 0}, BridgeReason::busy}};
}
constexpr const char* kNames[] = {"hello", "welcome", "state", "proxy", "bye"};
constexpr std::size_t kSizes[] = {kBridgeHelloBytes, kBridgeWelcomeBytes, kBridgeStateBytes,
                                  kBridgeProxyBytes, kBridgeByeBytes};

TEST(BridgeMessage, HasTheSameBytesInPythonAndHere) {
  const auto messages = one_of_each();
  for (std::size_t n = 0; n < messages.size(); ++n) {
    const Bytes theirs = bytes_of_file(kCorpus / (std::string(kNames[n]) + ".bin"));
    const auto ours = encode(messages[n]);
    ASSERT_EQ(ours.size, kSizes[n]) << kNames[n];
    EXPECT_TRUE(std::ranges::equal(ours.span(), theirs)) << kNames[n];
    const auto read = decode_exactly(theirs);
    ASSERT_TRUE(read.has_value()) << kNames[n];
    EXPECT_EQ(*read, messages[n]) << kNames[n];
  }
}

TEST(BridgeMessage, RefusesEveryTruncationAndEveryLongerDatagram) {
  for (const BridgeMessage& message : one_of_each()) {
    const auto whole = encode(message);
    Bytes bytes;
    for (std::size_t size = 0; size < whole.size; ++size) {
      bytes.assign(whole.bytes.begin(), whole.bytes.begin() + static_cast<std::ptrdiff_t>(size));
      EXPECT_FALSE(decode_exactly(bytes)) << size;
    }
    bytes.assign(whole.span().begin(), whole.span().end());
    bytes.push_back(std::byte{0});
    EXPECT_FALSE(decode_exactly(bytes));
  }
}

TEST(BridgeMessage, KnowsFiveLaws) {
  BridgeWelcome welcome;
  welcome.law = 4;
  EXPECT_TRUE(decode(encode(welcome).span()).has_value());
  welcome.law = 5;
  EXPECT_FALSE(decode(encode(welcome).span()).has_value());
}

TEST(BridgeMessage, RefusesPlacesBeyondAKilometreAndNoForce) {
  const auto is_taken = [](const auto& message) {
    return decode(encode(message).span()).has_value();
  };
  BridgeProxy proxy;
  proxy.position_mm = {1e6, 0.0, -1e6};
  proxy.distance_mm = -1e6;
  proxy.direct_force_n = {0.0, 1e9, 0.0};
  EXPECT_TRUE(is_taken(proxy));
  BridgeProxy far = proxy;
  far.position_mm.z = -1.000001e6;
  EXPECT_FALSE(is_taken(far));
  far = proxy;
  far.plane_point_mm.y = 1.000001e6;
  EXPECT_FALSE(is_taken(far));
  far = proxy;
  far.distance_mm = -1.000001e6;
  EXPECT_FALSE(is_taken(far));
  BridgeState state;
  state.position_mm.x = 1.000001e6;
  EXPECT_FALSE(is_taken(state));
}

TEST(BridgeMessage, RefusesWhatTheCorpusCallsMalformed) {
  int seen = 0;
  for (const auto& entry : fs::directory_iterator(kCorpus)) {
    if (!entry.path().filename().string().starts_with("malformed_")) continue;
    EXPECT_FALSE(decode_exactly(bytes_of_file(entry.path()))) << entry.path();
    ++seen;
  }
  EXPECT_GE(seen, 10);
}

/// What is taken is sound, and says the same when it is sent on.
void expect_sound(const Bytes& bytes) {
  const auto read = decode_exactly(bytes);
  if (!read) return;
  if (const auto* proxy = std::get_if<BridgeProxy>(&*read)) {
    EXPECT_TRUE(is_finite(proxy->position_mm) && is_finite(proxy->plane_point_mm));
    EXPECT_TRUE(is_finite(proxy->velocity_mm_per_s) && is_finite(proxy->direct_force_n));
    EXPECT_NEAR(length(proxy->plane_normal), 1.0, 1e-3);
  }
  const auto again = decode(encode(*read).span());
  ASSERT_TRUE(again.has_value());
  EXPECT_EQ(*again, *read);
}

using Random = std::mt19937;

/// One change: a bit, a byte, an end, or the rest of another datagram from the same byte on.
void mutate(Bytes& bytes, const Bytes& other, Random& random) {
  const std::size_t at = random() % bytes.size();
  switch (random() % 4) {
    case 0:
      bytes[at] ^= static_cast<std::byte>(1U << (random() % 8));
      return;
    case 1:
      bytes[at] = static_cast<std::byte>(random());
      return;
    case 2:
      bytes.resize(at);
      return;
    default:
      break;
  }
  if (at >= other.size()) return;
  bytes.resize(std::max(bytes.size(), other.size()));
  const auto from = static_cast<std::ptrdiff_t>(at);
  std::copy(other.begin() + from, other.end(), bytes.begin() + from);
}

std::vector<Bytes> corpus() {
  std::set<fs::path> files;
  for (const auto& entry : fs::directory_iterator(kCorpus)) files.insert(entry.path());
  std::vector<Bytes> seeds;
  seeds.reserve(files.size());
  for (const fs::path& file : files) seeds.push_back(bytes_of_file(file));
  return seeds;
}

TEST(BridgeMessageProperty, TakesNothingUnsoundFromMutatedDatagrams) {
  const std::vector<Bytes> seeds = corpus();
  constexpr unsigned kSeed = 47333;
  RecordProperty("seed", kSeed);
  Random random(kSeed);
  for (int run = 0; run < 200'000; ++run) {
    Bytes bytes = seeds[random() % seeds.size()];
    for (unsigned change = random() % 4; change > 0 && !bytes.empty(); --change) {
      mutate(bytes, seeds[random() % seeds.size()], random);
    }
    expect_sound(bytes);
  }
}

}  // namespace
}  // namespace argil::haptics
