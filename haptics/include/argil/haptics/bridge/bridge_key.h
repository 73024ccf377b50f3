// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "argil/core/result.h"

namespace argil::haptics {

/// Who sends a message. The two sides' tags differ, so that a message cannot be sent back to where
/// it came from.
enum class BridgeSender { bridge, simulator };

/// The secret that the two ends of a bridge share, so that each can tell the other from a stranger:
/// 128 bits, with which keyed BLAKE2b makes a tag of 128 bits for each message.
///
/// Threads  any.
/// Source   M.-J. Saarinen, J.-P. Aumasson, "The BLAKE2 Cryptographic Hash and Message
///          Authentication Code", RFC 7693 (2015), with the side's name as personalisation; by
///          libsodium.
class BridgeKey {
 public:
  static constexpr std::size_t kBytes = 16;
  static constexpr std::size_t kTagBytes = 16;
  using Tag = std::array<std::byte, kTagBytes>;

  /// 128 bits that are used once.
  using Nonce = std::array<std::byte, 16>;
  /// From the system's random numbers.
  static Nonce nonce() noexcept;

  /// From the system's random numbers.
  static BridgeKey random() noexcept;
  /// From 32 hexadecimal digits, and from nothing else.
  static std::optional<BridgeKey> from_text(std::string_view text) noexcept;
  /// As 32 hexadecimal digits.
  std::string text() const;

  /// The tag of a message from this side.
  ///
  /// Threads  Realtime.
  /// Cost     0.4 us for a datagram.
  Tag tag(BridgeSender sender, std::span<const std::byte> message) const noexcept;
  /// Whether it is that message's tag, in a time that tells nothing about it. `tag` may have any
  /// length.
  bool fits(BridgeSender sender, std::span<const std::byte> message,
            std::span<const std::byte> tag) const noexcept;

 private:
  explicit BridgeKey(const std::array<unsigned char, kBytes>& bytes) noexcept;
  std::array<unsigned char, kBytes> bytes_;
};

/// Compares two tags in a time that tells nothing about either.
bool is_same(const BridgeKey::Tag& a, const BridgeKey::Tag& b) noexcept;

/// Where the key of the bridge at this port lies unless the user names another file:
/// $XDG_RUNTIME_DIR/argil/bridge-PORT.key, and without that folder /tmp/argil-UID/bridge-PORT.key.
std::filesystem::path usual_key_file(std::uint16_t port);

/// A key in a file that its owner alone can read (mode 0600), for as long as this object lives.
///
/// Threads  any.
class BridgeKeyFile {
 public:
  /// Writes the key, and makes the last folder of its path, for the owner alone, where it does not
  /// exist. A key that lies there is replaced, unless the bridge that holds it lives: each locks
  /// its own (flock).
  ///
  /// Errors  bad_input where a living bridge holds the key, the file there is not a key, or others
  ///         may write to the folder or have replaced it by a link; disk.
  static Result<BridgeKeyFile> write(const std::filesystem::path& file, const BridgeKey& key);
  BridgeKeyFile(BridgeKeyFile&& other) noexcept;
  BridgeKeyFile& operator=(BridgeKeyFile&&) = delete;
  /// Removes the file, unless another has replaced it.
  ~BridgeKeyFile();

  const std::filesystem::path& path() const noexcept;

 private:
  struct Held;
  explicit BridgeKeyFile(std::unique_ptr<Held> held) noexcept;
  std::unique_ptr<Held> held_;
};

}  // namespace argil::haptics
