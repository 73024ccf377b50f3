// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace argil::test {

/// What may go wrong with an emulated Falcon. Counts are of the next so many; all may be changed
/// while it runs, through EmulatedFalcon::with.
struct FalconFaults {
  // Of the boot.
  int ignored_greetings = 0;
  bool has_zero_before_greeting = false;
  int corrupted_uploads = 0;  ///< a byte of their echo is another
  int lossy_uploads = 0;      ///< a byte of their echo is missing
  int prefixed_uploads = 0;   ///< their echo begins with 00
  bool never_starts = false;  ///< takes the firmware and stays mute

  // Of running.
  int lost_replies = 0;
  int short_replies = 0;   ///< of 14 bytes, which end in '>'
  int jumped_replies = 0;  ///< in which an encoder is `jump_ticks` off
  int jump_ticks = 4096;
  int late_replies = 0;  ///< that reach the chip `late_s` after they should
  double late_s = 0.0;
  bool is_silent = false;

  // Of the bus; negative errno.
  int in_error = 0;         ///< of every bulk IN transfer, until CLEAR_HALT
  int out_error = 0;        ///< of every bulk OUT transfer, the same
  double out_late_s = 0.0;  ///< from a bulk OUT transfer's arrival until the host is told
  int control_error = 0;
  int babbles = 0;              ///< IN transfers that get more than they can take
  bool has_line_error = false;  ///< each packet's status says that a byte was framed wrongly
  bool splits_packets = false;  ///< IN packets end anywhere, and empty ones come between
  bool is_taken = false;        ///< another program holds the interface
  bool has_driver = false;      ///< a driver of the kernel does
};

}  // namespace argil::test
