// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace argil {

/// The xxh64 hash (seed 0) of a sequence of bytes given piece by piece: how the sequence is cut
/// does not matter. Not cryptographic; it is there to tell whether two results have the same bits.
///
/// Determinism  same hash however the bytes are cut (Hash64.DoesNotDependOnHowTheBytesAreCut),
///              equal to the published vectors (Hash64.MatchesPublishedVectors).
/// Threads      any, one object each; noexcept, does not allocate. Copying copies the state so far.
/// Source       Y. Collet, xxHash fast digest algorithm, https://xxhash.com, from the system's
/// header.
class Hash64 {
 public:
  /// The hash of no bytes so far.
  Hash64() noexcept;

  /// Appends bytes. Multi-byte numbers count as they lie in memory.
  void update(std::span<const std::byte> bytes) noexcept;

  /// The hash of all bytes so far; more may follow
  /// (Hash64.GoesOnAfterADigestAndAfterACopy).
  std::uint64_t digest() const noexcept;

 private:
  alignas(
      8) std::array<std::byte, 88> state_;  // xxhash's own state, which stays out of this header
};

}  // namespace argil
