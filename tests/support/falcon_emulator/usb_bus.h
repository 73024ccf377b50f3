// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <linux/usbdevice_fs.h>

#include "support/falcon_emulator/doorbell.h"
#include "support/falcon_emulator/faults.h"
#include "support/falcon_emulator/ftdi_chip.h"

namespace argil::test {

/// One Falcon on a bus, as the kernel's usbfs shows it: transfers are handed in and reaped, and
/// take the time that full-speed USB and the serial line take, on a clock that is given.
///
/// Threads  any.
class UsbBus {
 public:
  using Clock = std::function<double()>;
  /// What tells one opened file of the node from another.
  using File = std::uintptr_t;

  UsbBus(const DspOptions& options, Clock clock) : clock_(std::move(clock)), chip_(options) {}

  /// A new node for the device, as each time it is plugged in.
  void plug(const std::string& node_path);
  void unplug();  ///< what is under way ends with -ESHUTDOWN

  // The calls of usbfs, as an opened file of the node makes them: 0 or more, or negative errno. A
  // file gets back what it handed in itself.
  int submit(usbdevfs_urb* urb, File file);
  usbdevfs_urb* reap(File file);
  int discard(usbdevfs_urb* urb);
  void forget(File file);  ///< it is closed: nothing of it is written to any more
  int claim(bool takes_from_driver);
  int release();
  int attach_driver();
  int clear_halt(unsigned endpoint);
  bool has_driver();
  bool is_plugged();
  bool is_node_of(int fd);
  std::size_t under_way();  ///< handed in and not reaped

  std::vector<VendorRequest> requests();  ///< that the chip has met

  /// Does what is due by now; virtual time only, since the thread of run_in_real_time does it.
  void advance();
  double next_event_s();  ///< when something happens next; far away when nothing will

  /// Does what is due, when it is due, until `stop`.
  void run_in_real_time();
  void stop();

  /// Looks at or changes the device with nothing else going on.
  template <class Function>
  auto with(const Function& function) {
    const std::lock_guard lock(mutex_);
    return function(chip_.dsp, faults_, clock_());
  }

 private:
  static constexpr double kNever = 1e18;

  void advance_locked();
  double next_event_locked() const;
  void complete(usbdevfs_urb* urb, int status, std::size_t bytes);
  void ring();
  void begin_out(usbdevfs_urb* urb, double now_s);
  void serve_in(double now_s);
  int control(usbdevfs_urb* urb);
  int answer_control(const unsigned char* setup, std::string& answer);

  std::mutex mutex_;
  std::condition_variable changed_;
  Clock clock_;
  FalconFaults faults_;
  FtdiChip chip_;
  std::optional<Doorbell> node_;
  bool is_plugged_ = false;
  bool is_claimed_ = false;
  bool had_driver_ = false;
  bool is_stopped_ = false;
  std::deque<usbdevfs_urb*> in_;     ///< waiting for a packet
  std::deque<usbdevfs_urb*> stuck_;  ///< OUT transfers on their way
  std::deque<usbdevfs_urb*> done_;
  std::map<usbdevfs_urb*, File> files_;  ///< of all that is in the three
  std::multimap<double, std::function<void()>> events_;
};

}  // namespace argil::test
