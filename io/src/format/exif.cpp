// SPDX-License-Identifier: GPL-3.0-or-later
#include "format/exif.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

namespace argil::io {
namespace {

/// Numbers of a TIFF, in its order of bytes; nothing beyond its end.
class TiffNumbers {
 public:
  TiffNumbers(std::span<const std::byte> bytes, bool is_little)
      : bytes_(bytes), is_little_(is_little) {}

  std::optional<std::uint32_t> at(std::size_t place, std::size_t size) const noexcept {
    if (place > bytes_.size() || size > bytes_.size() - place) return std::nullopt;
    std::uint32_t number = 0;
    for (std::size_t n = 0; n < size; ++n) {
      const std::size_t from = place + (is_little_ ? size - 1 - n : n);
      number = number << 8U | std::to_integer<std::uint32_t>(bytes_[from]);
    }
    return number;
  }

 private:
  std::span<const std::byte> bytes_;
  bool is_little_;
};

}  // namespace

int exif_orientation(std::span<const std::byte> segment) noexcept {
  constexpr std::array<unsigned char, 6> kName{'E', 'x', 'i', 'f', 0, 0};
  constexpr std::uint32_t kOrientation = 0x0112;
  constexpr std::uint32_t kShort = 3;
  constexpr std::size_t kEntry = 12;  // tag, type, count, value
  const bool is_exif = segment.size() >= kName.size() &&
                       std::equal(kName.begin(), kName.end(), segment.begin(),
                                  [](unsigned char a, std::byte b) { return std::byte{a} == b; });
  if (!is_exif) return 1;
  const std::span<const std::byte> tiff = segment.subspan(kName.size());
  if (tiff.size() < 2 || tiff[0] != tiff[1]) return 1;
  const bool is_little = tiff[0] == std::byte{'I'};
  if (!is_little && tiff[0] != std::byte{'M'}) return 1;
  const TiffNumbers numbers(tiff, is_little);
  const auto first = numbers.at(4, 4);
  const auto count = first ? numbers.at(*first, 2) : std::nullopt;
  for (std::size_t n = 0; count && n < *count; ++n) {
    const std::size_t entry = std::size_t{*first} + 2 + kEntry * n;
    const auto tag = numbers.at(entry, 2);
    if (!tag) return 1;
    if (*tag != kOrientation) continue;
    const auto value = numbers.at(entry + 8, 2);
    const bool is_sound = numbers.at(entry + 2, 2) == kShort && numbers.at(entry + 4, 4) == 1U &&
                          value && *value >= 1 && *value <= 8;
    return is_sound ? static_cast<int>(*value) : 1;
  }
  return 1;
}

}  // namespace argil::io
