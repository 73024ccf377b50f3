// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/falcon/falcon_firmware.h"

#include <cassert>
#include <cstdlib>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>

namespace argil::haptics {
namespace {

constexpr std::size_t kKey = 0x08AA;
constexpr std::size_t kReservedWords = 8;
constexpr std::size_t kHeadWords = 1 + kReservedWords + 2;
/// The processor addresses 4 M words.
constexpr std::size_t kAddressEnd = std::size_t{1} << 22U;

Error bad_firmware(const std::string& what, std::size_t word) {
  return {ErrorKind::bad_input, "is no boot stream of the Falcon's processor: " + what +
                                    " at byte " + std::to_string(2 * word) +
                                    "; use the firmware that came with the Falcon's own software"};
}

/// The words of a stream by their index.
class Words {
 public:
  explicit Words(std::span<const std::uint8_t> bytes) noexcept : bytes_(bytes) {}
  std::size_t size() const noexcept { return bytes_.size() / 2; }
  std::size_t operator[](std::size_t index) const noexcept {
    assert(index < size());
    return bytes_[2 * index] | std::size_t{bytes_[2 * index + 1]} << 8U;
  }
  std::size_t address(std::size_t index) const noexcept {
    return (*this)[index] << 16U | (*this)[index + 1];
  }

 private:
  std::span<const std::uint8_t> bytes_;
};

/// Key, reserved words and entry point.
Result<void> check_head(const Words& words) {
  if (words.size() < kHeadWords + 1) return bad_firmware("the end comes too soon", words.size());
  if (words[0] != kKey) return bad_firmware("the key 08AA is missing", 0);
  for (std::size_t n = 1; n <= kReservedWords; ++n) {
    if (words[n] != 0) return bad_firmware("a reserved word is not 0", n);
  }
  if (words.address(kHeadWords - 2) >= kAddressEnd)
    return bad_firmware("no such entry point", kHeadWords - 2);
  return {};
}

/// How many blocks there are, the last of which ends where the stream does.
Result<int> count_blocks(const Words& words) {
  int blocks = 0;
  for (std::size_t at = kHeadWords;;) {
    if (at >= words.size()) return bad_firmware("the end comes before the last block", at);
    const std::size_t count = words[at];
    if (count == 0) {
      if (at + 1 != words.size()) return bad_firmware("something follows the last block", at + 1);
      return blocks;
    }
    if (at + 3 + count > words.size()) return bad_firmware("a block is longer than the file", at);
    if (words.address(at + 1) + count > kAddressEnd)
      return bad_firmware("a block has no such place", at + 1);
    at += 3 + count;
    ++blocks;
  }
}

}  // namespace

Result<FalconFirmware> FalconFirmware::parse(std::vector<std::uint8_t> bytes) {
  if (bytes.size() > kMostBytes) return bad_firmware("it is longer than any", kMostBytes / 2);
  if (bytes.size() % 2 != 0) return bad_firmware("half a word", bytes.size() / 2);
  const Words words(bytes);
  if (auto head = check_head(words); !head) return head.error();
  const auto blocks = count_blocks(words);
  if (!blocks) return blocks.error();
  if (blocks.value() == 0) return bad_firmware("no block", kHeadWords);
  FalconFirmware firmware;
  firmware.blocks_ = blocks.value();
  firmware.entry_point_ = static_cast<std::uint32_t>(words.address(kHeadWords - 2));
  firmware.bytes_ = std::move(bytes);
  return firmware;
}

Result<FalconFirmware> read_falcon_firmware(const std::filesystem::path& file) {
  const auto bad_file = [&](const std::string& what) {
    return Error{ErrorKind::bad_input, "the firmware '" + file.string() + "' " + what};
  };
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    return bad_file("is no file; check the name given by --firmware or ARGIL_FALCON_FIRMWARE");
  }
  std::ifstream in(file, std::ios::binary);
  // One byte too many is enough to see that it is too long.
  std::vector<std::uint8_t> bytes(FalconFirmware::kMostBytes + 1);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!in.is_open() || in.bad()) return bad_file("cannot be read; check its permissions");
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  auto parsed = FalconFirmware::parse(std::move(bytes));
  if (!parsed) return bad_file(parsed.error().message);
  return parsed;
}

std::filesystem::path falcon_firmware_of_environment() {
  // Read before any thread of ours runs, and nothing of ours writes the environment.
  const char* file = std::getenv("ARGIL_FALCON_FIRMWARE");  // NOLINT(concurrency-mt-unsafe)
  return file != nullptr ? file : "";
}

}  // namespace argil::haptics
