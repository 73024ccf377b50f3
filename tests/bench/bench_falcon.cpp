// SPDX-License-Identifier: GPL-3.0-or-later
// Exchanges a second with an emulated Falcon through the real libusb, and what each costs the
// driver. Usage: bench_falcon [SECONDS]   (of each row; default 3)
#include <cstdio>
#include <cstdlib>
#include <optional>

#include "bench/clock.h"
#include "falcon/falcon_mailbox.h"
#include "falcon/falcon_session.h"
#include "support/falcon_emulator/emulated_falcon.h"

namespace argil::bench {
namespace {

enum class Pace { as_hardware, as_fast_as_it_goes };

void row(const char* name, Pace pace, bool flushes, double seconds) {
  test::EmulatedFalcon falcon({}, pace == Pace::as_hardware);
  haptics::FalconMailbox mailbox;
  haptics::FalconOptions options;
  options.flushes_at_packet_end = flushes;
  haptics::FalconSession session(options, std::nullopt, falcon.clock(), mailbox);
  if (session.open() != haptics::FalconFault::none ||
      session.connect() != haptics::FalconFault::none) {
    std::printf("%s: the emulated device did not start\n", name);
    return;
  }
  const auto before = session.status().replies;
  const double begin_ms = wall_ms();
  const double cpu_ms = process_cpu_ms();
  while (wall_ms() - begin_ms < 1e3 * seconds) session.run_until(falcon.clock().now_s() + 0.1);
  const double wall = wall_ms() - begin_ms;
  const auto replies = static_cast<double>(session.status().replies - before);
  std::printf("| %s | %.0f | %.3f | %.1f |\n", name, 1e3 * replies / wall,
              1e3 * session.status().round_trip_s, 1e3 * (process_cpu_ms() - cpu_ms) / replies);
}

}  // namespace
}  // namespace argil::bench

int main(int argc, char** argv) {
  using argil::bench::Pace;
  using argil::bench::row;
  const double seconds = argc > 1 ? std::atof(argv[1]) : 3.0;
  std::printf("| emulated bus | exchanges/s | round trip, its own ms | CPU us, both sides |\n");
  std::printf("|---|---|---|---|\n");
  row("real time, latency timer of 1 ms", Pace::as_hardware, false, seconds);
  row("real time, each reply sent at once", Pace::as_hardware, true, seconds);
  row("virtual time, latency timer of 1 ms", Pace::as_fast_as_it_goes, false, seconds);
  row("virtual time, each reply sent at once", Pace::as_fast_as_it_goes, true, seconds);
  return 0;
}
