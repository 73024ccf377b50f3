// SPDX-License-Identifier: GPL-3.0-or-later
// What the Falcon's driver computes for one packet: where the grip is, and the words for a force.
#include <bit>
#include <cmath>

#include "argil/haptics/falcon/falcon_kinematics.h"

#include "bench/row.h"
#include "falcon/falcon_packet.h"

namespace argil::bench {
namespace {

using haptics::FalconKinematics;
using haptics::LegValues;

/// A grip that moves by a few counts from packet to packet.
LegValues ticks_at(int packet) {
  const double swing = packet % 64;
  return {300.0 + 2.0 * swing, -150.0 + swing, 80.0 - 3.0 * swing};
}

void falcon_forward(benchmark::State& state) {
  const FalconKinematics kinematics(haptics::martin_hillier_geometry());
  Vec3 place = haptics::kFalconCenterMm;
  int packet = 0;
  for (auto _ : state) {
    place =
        kinematics.position_of(kinematics.angles_of_ticks(ticks_at(++packet)), place).position_mm;
    benchmark::DoNotOptimize(place);
  }
  // From the same start, whatever the number of iterations was.
  const auto last = kinematics.position_of(kinematics.angles_of_ticks(ticks_at(1)), place);
  RowResult row(state);
  row.add(std::bit_cast<std::uint64_t>(std::round(1e6 * last.position_mm.z)));
  row.show("from the last place");
}

void falcon_words(benchmark::State& state) {
  const FalconKinematics kinematics(haptics::martin_hillier_geometry());
  const Vec3 place = haptics::kFalconCenterMm + Vec3{10.0, -5.0, 12.0};
  haptics::FalconCommand command;
  haptics::FalconPacket packet{};
  double size = 1.0;
  for (auto _ : state) {
    size = size < 4.0 ? size + 0.25 : 1.0;
    command.word = kinematics.motor_words(size * Vec3{1.0, -0.5, 0.75}, place).word;
    packet = encode(command);
    benchmark::DoNotOptimize(packet);
  }
  command.word = kinematics.motor_words({1.0, -0.5, 0.75}, place).word;
  packet = encode(command);
  Hash64 hash;
  hash.update(std::as_bytes(std::span(packet)));
  RowResult row(state);
  row.add(hash.digest());
  row.show("force to packet");
}

BENCHMARK(falcon_forward);
BENCHMARK(falcon_words);

}  // namespace
}  // namespace argil::bench
