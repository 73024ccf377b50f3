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
/// Source       Y. Collet, xxHash fast digest algorithm, https://xxhash.com, compiled in from the
///              system's header.
class Hash64 {
 public:
  /// The hash of no bytes so far.
  Hash64() noexcept;

  /// Appends bytes; none changes nothing. Multi-byte numbers count as they lie in memory, so that a
  /// hash is of one byte order, and -0.0 and 0.0 differ. Structs with padding must not be given
  /// whole: their padding is undefined.
  void update(std::span<const std::byte> bytes) noexcept;

  /// The hash of all bytes so far; more may follow
  /// (Hash64.GoesOnAfterADigestAndAfterACopy).
  std::uint64_t digest() const noexcept;

 private:
  alignas(
      8) std::array<std::byte, 88> state_;  // xxhash's own state, which stays out of this header
};

}  // namespace argil
