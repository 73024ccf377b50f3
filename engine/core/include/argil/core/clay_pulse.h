// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>

namespace argil {

/// The sign of life of the clay's thread. A thread that hangs stays alive and beats no more: what
/// the servo judges that by is the age of its unanswered samples.
///
/// Threads  Realtime: written by the clay's thread, read from anywhere; wait-free.
struct ClayPulse {
  std::atomic<std::uint64_t> beats{
      0};                          ///< rounds of the thread's loop; about 1000 a second at rest
  std::atomic<bool> alive{false};  ///< from before its first round until its end, however it ends
};

}  // namespace argil
