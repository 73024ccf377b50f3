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

/// Who says something: the tag of what one side says is none of the other's, so that nothing can be
/// sent back to where it came from.
enum class BridgeSender { bridge, simulator };

/// What the two ends of a bridge share, so that each tells the other from a stranger: 128 bits, of
/// which keyed BLAKE2b (RFC 7693) makes a tag of 128 bits for each message.
///
/// Threads  any.
class BridgeKey {
 public:
  static constexpr std::size_t kBytes = 16;
  static constexpr std::size_t kTagBytes = 16;
  using Tag = std::array<std::byte, kTagBytes>;

  /// What is said once: 128 random bits, of the system's random numbers, as a key is.
  using Nonce = std::array<std::byte, 16>;
  static Nonce nonce() noexcept;

  static BridgeKey random() noexcept;
  /// Of 32 hexadecimal digits; of nothing else.
  static std::optional<BridgeKey> from_text(std::string_view text) noexcept;
  std::string text() const;

  /// Cost  0.4 us for a datagram; no allocation.
  Tag tag(BridgeSender sender, std::span<const std::byte> message) const noexcept;
  /// In a time that tells nothing about the tag. `tag` may have any length.
  bool fits(BridgeSender sender, std::span<const std::byte> message,
            std::span<const std::byte> tag) const noexcept;

 private:
  explicit BridgeKey(const std::array<unsigned char, kBytes>& bytes) noexcept;
  std::array<unsigned char, kBytes> bytes_;
};

/// In a time that tells nothing about either.
bool is_same(const BridgeKey::Tag& a, const BridgeKey::Tag& b) noexcept;

/// Where the key of the bridge at this port lies unless the user names another place:
/// $XDG_RUNTIME_DIR/argil/bridge-PORT.key, and without that folder /tmp/argil-UID/bridge-PORT.key.
std::filesystem::path usual_key_file(std::uint16_t port);

/// A key in a file that its owner alone can read (mode 0600), for as long as this object lives.
class BridgeKeyFile {
 public:
  /// Makes its last folder too, for the owner alone, where it is not there. A key that lies there
  /// is replaced, unless the bridge that holds it lives: each locks its own (flock). Errors
  /// bad_input where a living bridge holds the key, something lies there that is no key, or
  ///         others may write to the folder or have put a link in its place; disk.
  static Result<BridgeKeyFile> write(const std::filesystem::path& file, const BridgeKey& key);
  BridgeKeyFile(BridgeKeyFile&& other) noexcept;
  BridgeKeyFile& operator=(BridgeKeyFile&&) = delete;
  /// Removes the file, but none that another has put in its place.
  ~BridgeKeyFile();

  const std::filesystem::path& path() const noexcept;

 private:
  struct Held;
  explicit BridgeKeyFile(std::unique_ptr<Held> held) noexcept;
  std::unique_ptr<Held> held_;
};

}  // namespace argil::haptics
