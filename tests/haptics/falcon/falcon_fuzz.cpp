// SPDX-License-Identifier: GPL-3.0-or-later
// The readers of what comes from outside, fed damaged inputs: a second in every run, two in a slow
// test, a minute there in a thorough run. tests/corpus has the seeds.
#include <algorithm>
#include <cstdlib>
#include <functional>

#include <gtest/gtest.h>

#include "argil/haptics/falcon/falcon_calibration.h"
#include "argil/haptics/falcon/falcon_firmware.h"
#include "argil/haptics/falcon/falcon_kinematics.h"

#include "falcon/falcon_packet.h"
#include "falcon/ftdi_framing.h"
#include "support/effort.h"
#include "support/fuzz.h"

namespace argil::haptics {
namespace {

constexpr double kShortS = 1.0;
double long_s() { return test::effort(2.0, 60.0); }

using FalconBytes = std::vector<std::uint8_t>;  ///< of the exact size: one byte over is seen

/// Bytes that make no packet are counted, those of packets are not; none is lost or seen twice.
void check_packets(const std::string& input) {
  FalconReplyParser parser;
  std::uint64_t in_replies = 0;
  for (const char byte : input) {
    const auto reply = parser.push(static_cast<std::uint8_t>(byte));
    if (!reply) continue;
    in_replies += kFalconPacketBytes;
    ASSERT_LE(reply->buttons, 15);
  }
  const std::uint64_t known = in_replies + parser.dropped_bytes();
  ASSERT_LE(known, input.size());
  ASSERT_LT(input.size() - known, kFalconPacketBytes);
  const std::uint64_t dropped = parser.dropped_bytes();
  parser.push('<');  // what was begun is dropped, and a packet begins
  ASSERT_EQ(parser.dropped_bytes() - dropped, input.size() - known);
}

void check_transfer(const std::string& input) {
  FalconBytes transfer(input.begin(), input.end());
  FtdiStatus status;
  const std::size_t packets = (input.size() + kFtdiPacketBytes - 1) / kFtdiPacketBytes;
  const std::size_t kept = strip_ftdi_status(transfer, status);
  const std::size_t last = input.size() % kFtdiPacketBytes;
  const std::size_t lost = kFtdiStatusBytes * packets - (last == 1 ? 1 : 0);
  ASSERT_EQ(kept, input.size() - lost);
}

/// What is taken is what was given, and its blocks fill it: the words are counted once more.
void check_firmware(const std::string& input) {
  const auto parsed = FalconFirmware::parse(FalconBytes(input.begin(), input.end()));
  if (!parsed) {
    ASSERT_FALSE(parsed.error().message.empty());
    return;
  }
  const auto bytes = parsed.value().bytes();
  ASSERT_EQ(bytes.size(), input.size());
  std::size_t at = 22;
  int blocks = 0;
  for (; bytes[at] != 0 || bytes[at + 1] != 0; ++blocks) {
    at += 6 + 2 * (bytes[at] + std::size_t{256} * bytes[at + 1]);
  }
  ASSERT_EQ(at + 2, bytes.size());
  ASSERT_EQ(blocks, parsed.value().blocks());
}

/// What is taken makes arms that give finite forces at the centre.
void check_calibration(const std::string& input) {
  const auto parsed = parse_falcon_calibration(input, "fuzz");
  if (!parsed) {
    ASSERT_FALSE(parsed.error().message.empty());
    return;
  }
  const FalconKinematics kinematics(parsed.value().geometry);
  const auto words = kinematics.motor_words({1.0, -2.0, 0.5}, parsed.value().center_mm);
  ASSERT_FALSE(words.is_singular);
  for (const std::int16_t word : words.word) ASSERT_LE(std::abs(word), kFalconLargestWord);
}

void fuzz(const char* corpus, double seconds,
          const std::function<void(const std::string&)>& check) {
  test::Fuzzer fuzzer(corpus);
  ASSERT_FALSE(fuzzer.seeds().empty());
  for (const std::string& seed : fuzzer.seeds()) {
    for (std::size_t size = 0; size <= seed.size(); ++size) check(seed.substr(0, size));
  }
  const auto inputs = test::fuzz_for(fuzzer, seconds, [&](const std::string& input) {
    if (!testing::Test::HasFatalFailure()) check(input);
  });
  testing::Test::RecordProperty("inputs", std::to_string(inputs));
}

void check_wire(const std::string& input) {
  check_packets(input);
  check_transfer(input);
}

TEST(FalconFuzz, Packets) { fuzz("falcon_packet", kShortS, check_wire); }
TEST(FalconFuzz, BootStreams) { fuzz("falcon_firmware", kShortS, check_firmware); }
TEST(FalconFuzz, Calibrations) { fuzz("falcon_calibration", kShortS, check_calibration); }

TEST(FalconFuzzSlow, Packets) { fuzz("falcon_packet", long_s(), check_wire); }
TEST(FalconFuzzSlow, BootStreams) { fuzz("falcon_firmware", long_s(), check_firmware); }
TEST(FalconFuzzSlow, Calibrations) { fuzz("falcon_calibration", long_s(), check_calibration); }

}  // namespace
}  // namespace argil::haptics
