// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "support/falcon_emulator/dsp.h"
#include "support/falcon_emulator/faults.h"

namespace argil::test {

/// A request without data that the chip was sent.
struct VendorRequest {
  int request = 0;
  int value = 0;
  bool operator==(const VendorRequest&) const = default;
};

/// The FT232R in front of it: vendor requests, the latency timer, and packets with two status
/// bytes.
class FtdiChip {
 public:
  explicit FtdiChip(const DspOptions& options) : dsp(options) {}

  /// A vendor request; bytes of the answer, or negative errno.
  int control(std::uint8_t type, std::uint8_t request, std::uint16_t value, std::string& answer);

  const std::vector<VendorRequest>& requests() const noexcept { return requests_; }

  double seconds_for(std::size_t bytes) const noexcept;  ///< on the serial line
  void put(const std::string& bytes, double now_s);      ///< from the processor

  /// When the next IN packet leaves, perhaps an empty one.
  double packet_due_s() const noexcept;
  std::string take_packet(double now_s, const FalconFaults& faults);

  FalconDsp dsp;

 private:
  std::vector<VendorRequest> requests_;
  std::string waiting_;
  unsigned divisor_ = 0x4138;
  double latency_s_ = 0.016;
  int event_ = -1;  ///< the byte that sends what is waiting; none
  double last_packet_s_ = 0.0;
  double flush_s_ = -1.0;  ///< when something asked for a packet; negative: nothing
  std::mt19937 random_{5};
};

}  // namespace argil::test
