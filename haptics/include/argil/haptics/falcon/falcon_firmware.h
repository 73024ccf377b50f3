// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "argil/core/result.h"

namespace argil::haptics {

/// A Falcon's firmware, known to be a whole boot stream of its processor before any device is
/// touched. Argil has none to give: its licence does not allow that (docs/falcon.md).
///
/// The stream is of little-endian 16-bit words: the key 0x08AA, eight reserved words of 0, the
/// entry point (high, low), then blocks of (count, destination high, low, `count` words), a count
/// of 0 and nothing after it.
///
/// Source  Texas Instruments, "TMS320x281x Boot ROM Reference Guide" (SPRU095), SCI boot.
class FalconFirmware {
 public:
  /// A longer file is refused; known images have 7 to 9 KiB.
  static constexpr std::size_t kMostBytes = std::size_t{256} * 1024;

  /// Checks that `bytes` are a whole stream.
  ///
  /// Errors  bad_input saying what is wrong at which byte.
  static Result<FalconFirmware> parse(std::vector<std::uint8_t> bytes);

  /// The bytes as they are sent.
  std::span<const std::uint8_t> bytes() const noexcept { return bytes_; }
  int blocks() const noexcept { return blocks_; }
  std::uint32_t entry_point() const noexcept { return entry_point_; }

 private:
  FalconFirmware() = default;

  std::vector<std::uint8_t> bytes_;
  int blocks_ = 0;
  std::uint32_t entry_point_ = 0;
};

/// The same from a file.
///
/// Errors  bad_input as FalconFirmware::parse, and when the file cannot be read.
Result<FalconFirmware> read_falcon_firmware(const std::filesystem::path& file);

/// The file that the environment names as ARGIL_FALCON_FIRMWARE; "" when it names none.
std::filesystem::path falcon_firmware_of_environment();

}  // namespace argil::haptics
