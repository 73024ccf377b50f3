// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "argil/haptics/falcon/falcon_firmware.h"

#include "falcon/falcon_mailbox.h"
#include "falcon/falcon_session.h"
#include "support/falcon_emulator/emulated_falcon.h"

namespace argil::haptics::test {

using argil::test::DspOptions;
using argil::test::EmulatedFalcon;
using argil::test::FalconDsp;
using argil::test::FalconFaults;
using argil::test::SeenCommand;
using argil::test::SessionTime;

/// A boot stream of four blocks and as long as the usual firmware, without a byte of it.
inline std::vector<std::uint8_t> synthetic_firmware() {
  std::vector<std::uint8_t> bytes;
  const auto put = [&](unsigned word) {
    bytes.push_back(static_cast<std::uint8_t>(word & 0xFF));
    bytes.push_back(static_cast<std::uint8_t>(word >> 8));
  };
  put(0x08AA);
  for (int n = 0; n < 8; ++n) put(0);
  put(0x003F);
  put(0x8002);
  for (unsigned block = 0; block < 4; ++block) {
    constexpr unsigned kWords = 1055;
    put(kWords);
    put(0x003F);
    put(0x8000 + block * kWords);
    for (unsigned n = 0; n < kWords; ++n) put((n * 40503U + block) & 0xFFFF);
  }
  put(0);
  return bytes;
}

inline FalconFirmware firmware() {
  auto parsed = FalconFirmware::parse(synthetic_firmware());
  return std::move(parsed).value();
}

inline DspOptions powered_up() {
  DspOptions options;
  options.is_loaded = false;
  return options;
}

/// A hand that pulls the grip out, back and through the middle, and rests there: what homes it.
inline std::vector<HandKey> homing_plan() {
  std::vector<HandKey> plan;
  for (const auto& [time_s, z_mm] :
       {std::pair{0.0, -20.0}, {0.4, 60.0}, {0.8, -20.0}, {1.2, 60.0}, {1.6, 0.0}}) {
    HandKey key;
    key.time_s = time_s;
    key.place_mm.z = z_mm;
    plan.push_back(key);
  }
  return plan;
}

/// The driver on virtual time, and what it drives.
struct Driver {
  explicit Driver(const DspOptions& device = {}, const FalconOptions& options = {},
                  std::optional<FalconFirmware> image = std::nullopt)
      : falcon(device),
        session(options, std::move(image), falcon.clock(), mailbox),
        port(mailbox, falcon.clock(), options.calibration.mass_kg,
             options.calibration.damping_n_s_per_m, options.most_force_n),
        time(session, falcon.clock()) {}

  double now_s() { return falcon.clock().now_s(); }
  FalconFault start() {
    const FalconFault fault = session.open();
    return fault != FalconFault::none ? fault : session.connect();
  }
  void run_for(double seconds) { session.run_until(now_s() + seconds); }
  /// A force that the servo gives every millisecond, or so often.
  void push_for(double seconds, const Vec3& force_n, double period_s = 1e-3) {
    for (const double end_s = now_s() + seconds; now_s() < end_s;) {
      port.write(force_n);
      run_for(period_s);
    }
  }
  std::vector<SeenCommand> commands() {
    return falcon.with([](FalconDsp& dsp, FalconFaults&, double) { return dsp.commands(); });
  }
  Vec3 true_place_mm() {
    return falcon.with([](FalconDsp& dsp, FalconFaults&, double now) { return dsp.place_mm(now); });
  }
  Vec3 true_force_n() {
    return falcon.with([](FalconDsp& dsp, FalconFaults&, double now) { return dsp.force_n(now); });
  }

  EmulatedFalcon falcon;
  FalconMailbox mailbox;
  FalconSession session;
  FalconPort port;
  SessionTime time;
};

/// Homed, pulled out and held in the middle.
inline DspOptions held_in_the_middle() {
  DspOptions options;
  options.plan = homing_plan();
  return options;
}

/// Starts and runs until it gives forces.
inline void make_active(Driver& driver) {
  ASSERT_EQ(driver.start(), FalconFault::none);
  driver.run_for(3.0);
  ASSERT_EQ(driver.session.state(), FalconState::active);
}

}  // namespace argil::haptics::test
