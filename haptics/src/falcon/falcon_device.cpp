// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/falcon/falcon_device.h"

#include <atomic>
#include <cassert>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "falcon/falcon_session.h"
#include "servo/thread_priority.h"

namespace argil::haptics {
namespace {

/// How long the thread may take to notice that it should end or home.
constexpr double kSliceS = 0.02;

}  // namespace

struct FalconDevice::Impl {
  Impl(const FalconOptions& options, std::optional<FalconFirmware> firmware)
      : port(mailbox, clock, options.calibration.mass_kg, options.calibration.damping_n_s_per_m,
             options.most_force_n),
        session(options, std::move(firmware), clock, mailbox) {}

  ~Impl() {
    session.stop();
    if (thread.joinable()) thread.join();
  }

  void run() noexcept {
    guard([&] { session.connect(); });
    while (!session.is_stopped()) {
      guard([&] {
        if (is_home_wanted.exchange(false)) session.home();
        session.run_until(clock.now_s() + kSliceS);
      });
    }
    session.close();
  }

  /// Want of memory, or the unforeseen, is a fault like others: `home` is still served.
  template <class Step>
  void guard(const Step& step) noexcept {
    try {
      step();
    } catch (...) {
      session.give_up();
    }
  }

  // What fills whole cache lines comes first: no padding between.
  FalconMailbox mailbox;
  std::thread thread;
  SteadyLinkClock clock;
  std::string priority_refusal;
  FalconPort port;
  FalconSession session;
  std::atomic<bool> is_home_wanted = false;
};

Result<void> check_falcon(const FalconOptions& options) {
  const auto check = [](const char* name, double value, double least, double most,
                        const char* unit) -> Result<void> {
    if (value >= least && value <= most) return {};  // a NaN is not
    std::ostringstream text;
    text << name << " is " << value << unit << "; must be " << least << " to " << most << unit;
    return Error{ErrorKind::bad_input, text.str()};
  };
  if (auto good = check("largest force", options.most_force_n, 0.0, 8.0, " N"); !good) return good;
  return check("largest slew", options.most_slew_n_per_s, 500.0, 1e5, " N/s");
}

Result<std::unique_ptr<FalconDevice>> FalconDevice::open(const FalconOptions& options) {
  if (auto good = check_falcon(options); !good) return good.error();
  const auto file = options.firmware.empty() ? falcon_firmware_of_environment() : options.firmware;
  std::optional<FalconFirmware> firmware;
  if (!file.empty()) {
    auto read = read_falcon_firmware(file);
    if (!read) return read.error();
    firmware = std::move(read).value();
  }
  auto impl = std::make_unique<Impl>(options, std::move(firmware));
  // Here and not on its thread: what is absent or forbidden is known at once.
  if (const FalconFault fault = impl->session.open(); fault != FalconFault::none) {
    return falcon_error(fault);
  }
  try {
    impl->thread = std::thread([device = impl.get()] { device->run(); });
  } catch (const std::system_error& error) {
    return Error{ErrorKind::internal, std::string("the Falcon got no thread (") + error.what() +
                                          "); end other programs"};
  }
  impl->priority_refusal = ask_for_priority(impl->thread);
  return std::unique_ptr<FalconDevice>(new FalconDevice(std::move(impl)));
}

FalconDevice::FalconDevice(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {
  assert(impl_ && impl_->thread.joinable());
}
FalconDevice::~FalconDevice() = default;

DeviceReading FalconDevice::read(double now_s) noexcept { return impl_->port.read(now_s); }
void FalconDevice::write(const Vec3& force_n) noexcept { impl_->port.write(force_n); }
void FalconDevice::cut() noexcept { impl_->port.cut(); }
DeviceTraits FalconDevice::traits(double period_s) const noexcept {
  return impl_->port.traits(period_s);
}

const FalconStatus& FalconDevice::look() noexcept {
  impl_->mailbox.statuses.fetch();
  return impl_->mailbox.statuses.read_slot();
}

void FalconDevice::home() noexcept { impl_->is_home_wanted = true; }

const std::string& FalconDevice::priority_refusal() const noexcept {
  return impl_->priority_refusal;
}

}  // namespace argil::haptics
