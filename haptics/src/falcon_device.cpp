// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/falcon_device.h"

#include <atomic>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include "falcon_session.h"
#include "thread_priority.h"

namespace argil::haptics {
namespace {

/// How long the thread may take to hear that it should end or home.
constexpr double kSliceS = 0.02;

}  // namespace

struct FalconDevice::Impl {
  Impl(const FalconOptions& options, std::optional<FalconFirmware> firmware)
      : port(mailbox, options.calibration.mass_kg, options.calibration.damping_n_s_per_m,
             options.most_force_n),
        session(options, std::move(firmware), clock, mailbox) {}

  ~Impl() {
    session.stop();
    if (thread.joinable()) thread.join();
  }

  void run() noexcept {
    try {
      session.connect();
      while (!session.is_stopped()) {
        if (is_home_wanted.exchange(false)) session.home();
        session.run_until(clock.now_s() + kSliceS);
      }
    } catch (...) {
      // Memory, or the unforeseen: the servo reads that the device is lost.
    }
    session.close();
  }

  SteadyLinkClock clock;
  FalconMailbox mailbox;
  FalconPort port;
  FalconSession session;
  std::atomic<bool> is_home_wanted = false;
  std::string priority_refusal;
  std::thread thread;
};

Result<std::unique_ptr<FalconDevice>> FalconDevice::open(const FalconOptions& options) {
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

FalconDevice::FalconDevice(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
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
