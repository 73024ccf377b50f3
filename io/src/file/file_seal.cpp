// SPDX-License-Identifier: GPL-3.0-or-later
#include "file/file_seal.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <vector>

#include "argil/core/hash.h"

#include "file/file_bytes.h"

namespace argil::io {
namespace {

constexpr std::array<char, 8> kLetters{'A', 'r', 'g', 'i', 'l', 'S', 'e', 'a'};
using FileHandle = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;
using Seal = std::array<std::byte, kSealBytes>;

void put_number(Seal& seal, std::size_t at, std::uint64_t number) {
  // Little-endian on every machine.
  for (std::size_t i = 0; i < 8; ++i) seal[at + i] = static_cast<std::byte>(number >> (8 * i));
}

Seal make_seal(std::uint64_t length, std::uint64_t hash) {
  Seal seal{};
  std::transform(kLetters.begin(), kLetters.end(), seal.begin(),
                 [](char c) { return static_cast<std::byte>(c); });
  put_number(seal, 8, length);
  put_number(seal, 16, hash);
  return seal;
}

}  // namespace

Result<void> seal_file(const std::filesystem::path& file) {
  // Read back and not hashed while it is written: OpenVDB goes back to fill in offsets.
  const FileHandle handle(std::fopen(file.c_str(), "r+b"), &std::fclose);
  if (!handle) return disk_error("write", file, errno);
  Hash64 hash;
  std::uint64_t length = 0;
  std::vector<std::byte> block(std::size_t{1} << 20);
  while (const std::size_t got = std::fread(block.data(), 1, block.size(), handle.get())) {
    hash.update({block.data(), got});
    length += got;
  }
  if (std::ferror(handle.get()) != 0) return disk_error("read", file, errno);
  const Seal seal = make_seal(length, hash.digest());
  const bool written = std::fseek(handle.get(), 0, SEEK_END) == 0 &&
                       std::fwrite(seal.data(), 1, seal.size(), handle.get()) == seal.size() &&
                       std::fflush(handle.get()) == 0;
  if (!written) return disk_error("write", file, errno);
  return {};
}

std::optional<std::span<const std::byte>> unsealed(std::span<const std::byte> bytes) noexcept {
  if (bytes.size() < kSealBytes) return std::nullopt;
  const auto body = bytes.first(bytes.size() - kSealBytes);
  Hash64 hash;
  hash.update(body);
  const Seal seal = make_seal(body.size(), hash.digest());
  if (!std::equal(seal.begin(), seal.end(), bytes.end() - kSealBytes)) return std::nullopt;
  assert(body.size() + kSealBytes == bytes.size());
  return body;
}

}  // namespace argil::io
