// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "argil/haptics/falcon_status.h"

#include "ftdi_framing.h"
#include "link_clock.h"

namespace argil::haptics {

/// An opened Falcon as a serial line: bytes out, bytes in, and requests to the chip between. Two
/// bulk IN transfers of 64 bytes are always under way, so that nothing is lost between two reads
/// and a full packet is an end by itself.
///
/// Errors   the first failure of a transfer stays what every call answers: open another link then.
/// Threads  one. Allocates and takes libusb's locks: not for the servo's thread.
class FalconLink {
 public:
  /// Opens the Falcon with this serial number, "" for the first one, and takes it from the kernel's
  /// driver if that has it. `clock` must outlive the link.
  static Result<std::unique_ptr<FalconLink>, FalconFault> open(const std::string& serial,
                                                               LinkClock& clock);
  /// Cancels what is under way and gives the device back.
  ~FalconLink();
  FalconLink(const FalconLink&) = delete;
  FalconLink& operator=(const FalconLink&) = delete;

  /// Waits for its end, at most a second.
  FalconFault control(FtdiRequest request);

  /// Begins a transfer of 1 to kFtdiPayloadBytes bytes (asserted). usb_failed while another is
  /// under way.
  FalconFault send(std::span<const std::uint8_t> bytes);

  /// The last word to the device, which is sent whatever failed before, but not to one that was
  /// unplugged: waits for what is on its way out, takes a stall off, and waits until it has left,
  /// all that for at most `most_s`. True when it has. Then only the end is left.
  bool send_last(std::span<const std::uint8_t> bytes, double most_s) noexcept;
  bool is_sending() const noexcept;

  /// Waits until something happened, or so long; may come back before with nothing new.
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
