// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/falcon_emulator/ftdi_chip.h"

#include <algorithm>
#include <cerrno>
#include <cmath>

namespace argil::test {
namespace {

constexpr std::size_t kPayload = 62;
constexpr double kBitsPerByte = 10.0;

}  // namespace

int FtdiChip::control(std::uint8_t type, std::uint8_t request, std::uint16_t value,
                      std::string& answer) {
  if (type == 0xC0 && request == 10) {
    answer = std::string(1, static_cast<char>(std::lround(1000.0 * latency_s_)));
    return 1;
  }
  if (type != 0x40) return -EPIPE;
  requests_.push_back({request, value});
  const unsigned low = value & 0xFFU;
  switch (request) {
    case 0:
      if (value > 2) return -EPIPE;
      if (value != 2) {
        waiting_.clear();
        flush_s_ = -1.0;
      }
      return 0;
    case 1:
      if ((value & 0x0100U) != 0) dsp.set_reset_line((value & 1U) != 0);
      return 0;
    case 2:
    case 4:
      return 0;
    case 3:
      divisor_ = value;
      dsp.set_divisor(value);
      return 0;
    case 6:
      event_ = (value & 0x0100U) != 0 ? static_cast<int>(low) : -1;
      return 0;
    case 9:
      if (low == 0) return -EPIPE;
      latency_s_ = 1e-3 * low;
      return 0;
    default:
      return -EPIPE;
  }
}

double FtdiChip::seconds_for(std::size_t bytes) const noexcept {
  const double baud = divisor_ == 0x4138 ? 9600.0 : 3e6 / std::max(1U, divisor_ & 0x3FFFU);
  return kBitsPerByte * static_cast<double>(bytes) / baud;
}

void FtdiChip::put(const std::string& bytes, double now_s) {
  waiting_ += bytes;
  const bool has_event = event_ >= 0 && bytes.find(static_cast<char>(event_)) != std::string::npos;
  if ((waiting_.size() >= kPayload || has_event) && flush_s_ < 0.0) flush_s_ = now_s;
}

double FtdiChip::packet_due_s() const noexcept {
  const double timer_s = last_packet_s_ + latency_s_;
  return flush_s_ >= 0.0 ? std::min(flush_s_, timer_s) : timer_s;
}

std::string FtdiChip::take_packet(double now_s, const FalconFaults& faults) {
  std::size_t size = std::min(kPayload, waiting_.size());
  if (faults.splits_packets && random_() % 2 == 0) size = random_() % (size + 1);
  std::string packet{static_cast<char>(dsp.is_clear_to_send() ? 0x11 : 0x01),
                     faults.has_line_error ? '\x68' : '\x60'};
  packet += waiting_.substr(0, size);
  waiting_.erase(0, size);
  last_packet_s_ = now_s;
  flush_s_ = waiting_.size() >= kPayload ? now_s : -1.0;
  return packet;
}

}  // namespace argil::test
