// SPDX-License-Identifier: GPL-3.0-or-later
#include "falcon/falcon_packet.h"

#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace argil::haptics {
namespace {

// Packets worked out by hand from docs/theory.md, "Falcon", wire.

std::string text_of(const FalconCommand& command) {
  const FalconPacket packet = encode(command);
  return {packet.begin(), packet.end()};
}

std::vector<FalconReply> replies_in(FalconReplyParser& parser, const std::string& bytes) {
  std::vector<FalconReply> replies;
  for (const char byte : bytes) {
    if (auto reply = parser.push(static_cast<std::uint8_t>(byte))) replies.push_back(*reply);
  }
  return replies;
}
std::vector<FalconReply> replies_in(const std::string& bytes) {
  FalconReplyParser parser;
  return replies_in(parser, bytes);
}

TEST(FalconPacket, EncodesTheVectors) {
  FalconCommand command;
  command.word = {-1, 4095, -4095};
  command.blue = true;
  command.is_homing = true;
  EXPECT_EQ(text_of(command), "<PPPPPPPABAAPFA>");
  command = {};
  command.green = true;
  EXPECT_EQ(text_of(command), "<AAAAAAAAAAAACA>");
  EXPECT_EQ(text_of({}), "<AAAAAAAAAAAAAA>");
  command = {};
  command.red = true;
  EXPECT_EQ(text_of(command), "<AAAAAAAAAAAAIA>");
}

TEST(FalconPacket, ClampsWordsBeforeTheyCouldWrap) {
  FalconCommand most;
  most.word = {32767, -32768, 4096};
  FalconCommand legal;
  legal.word = {4095, -4095, 4095};
  EXPECT_EQ(text_of(most), text_of(legal));
}

TEST(FalconPacket, DecodesTheVector) {
  const auto replies = replies_in("<JFKPAAAAOJPPEA>");
  ASSERT_EQ(replies.size(), 1U);
  EXPECT_EQ(replies[0].tick, (std::array<std::int16_t, 3>{-1447, 0, -98}));
  EXPECT_EQ(replies[0].buttons, 4);
  EXPECT_EQ(replies[0].is_homed, (std::array<bool, 3>{}));
}

TEST(FalconPacket, ReadsEveryFlag) {
  for (int flags = 0; flags < 128; ++flags) {
    const auto replies =
        replies_in("<AAAAAAAAAAAA" + std::string(1, static_cast<char>(0x41 + flags)) + "A>");
    ASSERT_EQ(replies.size(), 1U);
    EXPECT_EQ(replies[0].buttons, flags & 15);
    for (std::size_t leg = 0; leg < 3; ++leg) {
      EXPECT_EQ(replies[0].is_homed[leg], (flags >> (4 + leg) & 1) != 0);
    }
    EXPECT_EQ(replies[0].all_homed(), flags >> 4 == 7);
  }
  EXPECT_TRUE(replies_in("<AAAAAAAAAAAA\xC1"
                         "A>")
                  .empty());
}

TEST(FalconPacket, TakesNoByteThatCannotStandThere) {
  const std::string good = "<JFKPAAAAOJPPEA>";
  for (std::size_t at = 0; at < good.size(); ++at) {
    for (int byte = 0; byte < 256; ++byte) {
      std::string bytes = good;
      bytes[at] = static_cast<char>(byte);
      const bool is_frame = byte == '<' || byte == '>';
      const bool may_be = at == 0 || at == 15 ? bytes == good
                          : at < 13           ? byte >= 'A' && byte <= 'P'
                          : at == 13          ? byte >= 0x41 && byte <= 0xC0
                                              : !is_frame;
      EXPECT_EQ(replies_in(bytes).size(), may_be ? 1U : 0U) << at << " " << byte;
    }
  }
}

/// It once made "all homed and three buttons" for someone.
TEST(FalconPacket, AReplyOfFourteenBytesIsNone) {
  FalconReplyParser parser;
  EXPECT_TRUE(replies_in(parser, "<JFKPAAAAOJPP>").empty());
  EXPECT_EQ(parser.dropped_bytes(), 14U);
  EXPECT_EQ(replies_in(parser, "<JFKPAAAAOJPPEA>").size(), 1U);
  EXPECT_TRUE(replies_in(parser, "<JFKPAAAAOJPPEA").empty());
  EXPECT_EQ(replies_in(parser, "<AAAAAAAAAAAAAA>").size(), 1U);
}

TEST(FalconPacket, FindsTheNextPacketAfterAnyDamage) {
  const std::string good = "<JFKPAAAAOJPPEA>";
  for (std::size_t cut = 0; cut < good.size(); ++cut) {
    FalconReplyParser parser;
    const std::string begun = good.substr(0, cut);
    EXPECT_EQ(replies_in(parser, begun + good).size(), 1U) << cut;
    EXPECT_EQ(replies_in(parser, good.substr(cut) + good).size(), cut == 0 ? 2U : 1U) << cut;
  }
}

TEST(FalconPacket, ForgetsABeginningThatItIsToldTo) {
  FalconReplyParser parser;
  replies_in(parser, "<JFKPAAAA");
  parser.reset();
  EXPECT_TRUE(replies_in(parser, "OJPPEA>").empty());
}

std::string reply_text(std::mt19937_64& random, FalconReply& reply) {
  std::string text = "<";
  for (std::int16_t& tick : reply.tick) {
    tick = static_cast<std::int16_t>(random());
    for (int n = 0; n < 4; ++n) {
      text += static_cast<char>('A' + (static_cast<std::uint16_t>(tick) >> (4 * n) & 15));
    }
  }
  const auto flags = static_cast<unsigned>(random() % 128);
  reply.buttons = static_cast<std::uint8_t>(flags & 15);
  for (std::size_t leg = 0; leg < 3; ++leg) reply.is_homed[leg] = (flags >> (4 + leg) & 1) != 0;
  return text + static_cast<char>(0x41 + flags) + "A>";
}

/// Whatever lies between packets, as long as it is no '<' that begins one.
TEST(FalconPacketProperty, LosesNoPacketBetweenNoise) {
  std::mt19937_64 random(7);
  FalconReplyParser parser;
  std::uint64_t noise_bytes = 0;
  for (int n = 0; n < 10'000; ++n) {
    std::string bytes;
    for (std::size_t noise = random() % 4; noise > 0; --noise, ++noise_bytes) {
      bytes += static_cast<char>(0x50 + random() % 16);
    }
    FalconReply sent;
    bytes += reply_text(random, sent);
    const auto replies = replies_in(parser, bytes);
    ASSERT_EQ(replies.size(), 1U);
    ASSERT_EQ(replies[0], sent);
  }
  EXPECT_EQ(parser.dropped_bytes(), noise_bytes);
}

}  // namespace
}  // namespace argil::haptics
