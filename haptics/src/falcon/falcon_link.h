// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "argil/haptics/falcon/falcon_status.h"

#include "falcon/ftdi_framing.h"
#include "falcon/link_clock.h"

namespace argil::haptics {

/// An opened Falcon as a serial line: bytes out, bytes in, and requests to the chip in between. Two
/// bulk IN transfers of 64 bytes are always pending, so that nothing is lost between two reads and
/// a full packet ends a transfer by itself.
///
/// Errors   the first failure of a transfer stays what every call answers: open another link then.
/// Threads  one. Allocates and takes libusb's locks: not for the servo's thread.
class FalconLink {
 public:
  /// Opens the Falcon with this serial number, "" for the first one, and takes it from the kernel's
  /// driver if that has it. `clock` must outlive the link.
  static Result<std::unique_ptr<FalconLink>, FalconFault> open(const std::string& serial,
                                                               LinkClock& clock);
  /// Cancels pending transfers and gives the device back.
  ~FalconLink();
  FalconLink(const FalconLink&) = delete;
  FalconLink& operator=(const FalconLink&) = delete;

  /// Makes a request to the chip and waits for its end, at most a second.
  FalconFault control(FtdiRequest request);

  /// Begins a transfer of 1 to kFtdiPayloadBytes bytes (asserted). usb_failed while another is
  /// pending.
  FalconFault send(std::span<const std::uint8_t> bytes);

  /// The last packet to the device, which is sent whatever failed before, but not to a device that
  /// was unplugged: waits for a pending transfer, clears a stall, and waits until the packet has
  /// left, all within `most_s`. True when it has left. After it nothing else may be sent.
  bool send_last(std::span<const std::uint8_t> bytes, double most_s) noexcept;
  bool is_sending() const noexcept;

  /// Waits until something happens or `until_s`; may return earlier with nothing new.
  FalconFault wait_until(double until_s);

  std::span<const std::uint8_t> received() const noexcept { return received_; }
  void clear_received() noexcept { received_.clear(); }
  std::uint64_t packets() const noexcept { return packets_; }  ///< that came, also empty ones
  bool is_clear_to_send() const noexcept { return status_.is_clear_to_send; }
  bool has_line_error() const noexcept { return status_.has_line_error; }  ///< since it was opened
  FalconFault failure() const noexcept { return failure_; }

  struct Usb;  ///< what of libusb it holds

 private:
  FalconLink(std::unique_ptr<Usb> usb, LinkClock& clock);
  FalconFault begin_reading();
  bool wait_for_out(double until_s) noexcept;

  std::unique_ptr<Usb> usb_;
  LinkClock& clock_;
  std::vector<std::uint8_t> received_;
  std::uint64_t packets_ = 0;
  FtdiStatus status_;
  FalconFault failure_ = FalconFault::none;
};

}  // namespace argil::haptics
