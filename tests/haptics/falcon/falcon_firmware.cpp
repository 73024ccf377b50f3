// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/falcon/falcon_firmware.h"

#include <string>

#include <gtest/gtest.h>

#include "support/scratch.h"

namespace argil::haptics {
namespace {

using FalconBytes = std::vector<std::uint8_t>;

FalconBytes words(const std::vector<unsigned>& all) {
  FalconBytes bytes;
  for (const unsigned word : all) {
    bytes.push_back(static_cast<std::uint8_t>(word & 0xFF));
    bytes.push_back(static_cast<std::uint8_t>(word >> 8));
  }
  return bytes;
}

/// Two blocks, of 3 words and of 1; no bytes of any real firmware.
std::vector<unsigned> good() {
  return {0x08AA, 0,    0,      0, 0, 0, 0, 0, 0,      0x003F, 0x8002,
          3,      0x3F, 0x8000, 1, 2, 3, 1, 0, 0x0400, 9,      0};
}

std::string firmware_refusal(const std::vector<unsigned>& all) {
  const auto parsed = FalconFirmware::parse(words(all));
  if (parsed.ok()) return "";
  EXPECT_EQ(parsed.error().kind, ErrorKind::bad_input);
  return parsed.error().message;
}

TEST(FalconFirmware, ReadsABootStream) {
  const auto parsed = FalconFirmware::parse(words(good()));
  ASSERT_TRUE(parsed.ok()) << parsed.error().message;
  EXPECT_EQ(parsed.value().blocks(), 2);
  EXPECT_EQ(parsed.value().entry_point(), 0x3F8002U);
  const auto bytes = parsed.value().bytes();
  EXPECT_EQ(FalconBytes(bytes.begin(), bytes.end()), words(good()));
}

TEST(FalconFirmware, RefusesEveryTruncation) {
  const FalconBytes whole = words(good());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const FalconBytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_FALSE(FalconFirmware::parse(cut).ok()) << size;
  }
}

TEST(FalconFirmware, SaysWhatIsWrongAndWhere) {
  const auto expect = [](std::size_t index, unsigned word, const std::string& said) {
    std::vector<unsigned> all = good();
    all[index] = word;
    EXPECT_NE(firmware_refusal(all).find(said), std::string::npos) << firmware_refusal(all);
  };
  expect(0, 0x08AB, "key 08AA is missing at byte 0");
  expect(4, 1, "reserved word is not 0 at byte 8");
  expect(9, 0x0040, "no such entry point");
  expect(11, 2, "at byte");
  expect(11, 300, "a block is longer than the file at byte 22");
  expect(12, 0x40, "a block has no such place at byte 24");
  std::vector<unsigned> longer = good();
  longer.push_back(0);
  EXPECT_NE(firmware_refusal(longer).find("something follows the last block at byte 44"),
            std::string::npos);
  std::vector<unsigned> empty = good();
  empty.resize(11);
  empty.push_back(0);
  EXPECT_NE(firmware_refusal(empty).find("no block"), std::string::npos);
}

TEST(FalconFirmware, RefusesWhatIsLongerThanAny) {
  EXPECT_FALSE(FalconFirmware::parse(FalconBytes(FalconFirmware::kMostBytes + 2)).ok());
}

TEST(FalconFirmware, ReadsAFileAndNamesItWhenItCannot) {
  const test::ScratchFolder folder;
  const FalconBytes whole = words(good());
  test::fill(folder / "good.bin", std::string(whole.begin(), whole.end()));
  EXPECT_TRUE(read_falcon_firmware(folder / "good.bin").ok());
  test::fill(folder / "bad.bin", "a text");
  for (const auto& file : {folder / "bad.bin", folder / "missing.bin", folder.path()}) {
    const auto read = read_falcon_firmware(file);
    ASSERT_FALSE(read.ok());
    EXPECT_EQ(read.error().kind, ErrorKind::bad_input);
    EXPECT_NE(read.error().message.find(file.string()), std::string::npos);
  }
  test::fill(folder / "long.bin", std::string(FalconFirmware::kMostBytes + 100, 'x'));
  EXPECT_FALSE(read_falcon_firmware(folder / "long.bin").ok());
}

}  // namespace
}  // namespace argil::haptics
