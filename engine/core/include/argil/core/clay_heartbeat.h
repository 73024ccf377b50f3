// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>

namespace argil {

/// The sign of life of the clay's thread. A thread that hangs stays alive and beats no more: what
/// the servo judges that by is the age of its unanswered samples.
///
/// Threads  Realtime: written by the clay's thread, read from anywhere; wait-free.
struct ClayHeartbeat {
  /// Rounds of the thread's loop since it began; about 1000 a second at rest.
  std::atomic<std::uint64_t> beats{0};
  /// True from before the first round until the thread's end, however it ends.
  std::atomic<bool> alive{false};
};

}  // namespace argil
