// SPDX-License-Identifier: GPL-3.0-or-later
#include "falcon/falcon_mailbox.h"

#include "argil/haptics/falcon/falcon_device.h"

namespace argil::haptics {
namespace {

/// The device's own thread says so when a reply is late; a thread that says nothing is lost.
constexpr double kMostSilenceS = 0.1;

/// A force waits for half an exchange and travels for half of one, and the position that it answers
/// was read half an exchange before.
constexpr double kDelayPerRoundTrip = 1.5;

}  // namespace

DeviceReading FalconPort::read(double now_s) noexcept {
  if (mailbox_.readings.fetch()) last_s_ = now_s;
  DeviceReading reading = mailbox_.readings.read_slot().reading;
  if (!(now_s - last_s_ <= kMostSilenceS)) reading.is_ready = false;
  return reading;
}

void FalconPort::give(const Vec3& force_n, bool is_cut) noexcept {
  mailbox_.forces.write_slot() = {force_n, is_cut, clock_.now_s()};
  mailbox_.forces.publish();
}

DeviceTraits FalconPort::traits(double /*period_s*/) const noexcept {
  DeviceTraits traits = traits_;
  const double measured_s = mailbox_.readings.read_slot().round_trip_s;
  traits.delay_s = measured_s > 0.0 ? kDelayPerRoundTrip * measured_s : kFalconUsualDelayS;
  return traits;
}

}  // namespace argil::haptics
