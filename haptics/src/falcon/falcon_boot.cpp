// SPDX-License-Identifier: GPL-3.0-or-later
#include "falcon/falcon_boot.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <initializer_list>
#include <span>

namespace argil::haptics {
namespace {

constexpr std::uint8_t kRunLatencyMs = 1;
constexpr std::uint8_t kBootLatencyMs = 16;

constexpr std::array<std::uint8_t, 3> kGreeting{0x0A, 0x43, 0x0D};
constexpr std::array<std::uint8_t, 4> kGreetingAnswer{0x0A, 0x44, 0x2C, 0x0D};
constexpr int kGreetings = 5;  // in each attempt
constexpr double kGreetingS = 0.1;

constexpr std::array<std::uint8_t, 1> kAutobaud{0x41};
constexpr double kAutobaudS = 0.1;
constexpr double kClearToSendS = 0.2;

constexpr double kEchoS = 0.25;  ///< without a byte
constexpr double kUploadS = 5.0;

FalconFault request(FalconLink& link, std::initializer_list<FtdiRequest> all) {
  FalconFault fault = FalconFault::none;
  for (const FtdiRequest& one : all) {
    if (fault == FalconFault::none) fault = link.control(one);
  }
  return fault;
}

FalconFault enter_boot_mode(FalconLink& link) {
  // The rising edge of DTR resets the processor into its boot loader.
  return request(link, {kFtdiPurgeIn, kFtdiPurgeOut, ftdi_latency(kBootLatencyMs), kFtdiBootBaud,
                        kFtdiLine8N1, kFtdiNoFlowControl, kFtdiRtsLow, kFtdiDtrLow, kFtdiDtrHigh});
}

bool contains(std::span<const std::uint8_t> bytes, std::span<const std::uint8_t> wanted) {
  return std::search(bytes.begin(), bytes.end(), wanted.begin(), wanted.end()) != bytes.end();
}

/// Waits until `is_done`, at most `most_s`. False when it was not done by then, or the link failed.
template <class Done>
bool wait_for(FalconLink& link, LinkClock& clock, double most_s, const Done& is_done) {
  assert(most_s > 0.0);
  const double until_s = clock.now_s() + most_s;
  while (!is_done()) {
    if (clock.now_s() >= until_s) return false;
    if (link.wait_until(until_s) != FalconFault::none) return false;
  }
  return true;
}

/// Sends a question and waits for its answer among whatever comes.
bool ask(FalconLink& link, LinkClock& clock, std::span<const std::uint8_t> question,
         std::span<const std::uint8_t> answer, double most_s) {
  assert(!question.empty() && !answer.empty());
  if (!wait_for(link, clock, most_s, [&] { return !link.is_sending(); })) return false;
  link.clear_received();
  if (link.send(question) != FalconFault::none) return false;
  return wait_for(link, clock, most_s, [&] { return contains(link.received(), answer); });
}

FalconFault or_link(const FalconLink& link, FalconFault fault) {
  return link.failure() != FalconFault::none ? link.failure() : fault;
}

FalconFault greet(FalconLink& link, LinkClock& clock) {
  for (int n = 0; n < kGreetings; ++n) {
    if (link.control(kFtdiPurgeIn) != FalconFault::none) return link.failure();
    if (ask(link, clock, kGreeting, kGreetingAnswer, kGreetingS)) return FalconFault::none;
    if (link.failure() != FalconFault::none) return link.failure();
  }
  return FalconFault::no_greeting;
}

/// Lets the boot loader find the speed of the line.
FalconFault lock_baud(FalconLink& link, LinkClock& clock) {
  if (const FalconFault fault = request(link, {kFtdiDtrLow, kFtdiUploadBaud});
      fault != FalconFault::none) {
    return fault;
  }
  // It says when it is ready, but is known to work without having said so.
  wait_for(link, clock, kClearToSendS, [&] { return link.is_clear_to_send(); });
  if (ask(link, clock, kAutobaud, kAutobaud, kAutobaudS)) return FalconFault::none;
  return or_link(link, FalconFault::no_greeting);
}

FalconFault send_firmware(FalconLink& link, LinkClock& clock, std::span<const std::uint8_t> bytes,
                          const UploadProgress& progress) {
  assert(!bytes.empty());
  const double end_s = clock.now_s() + kUploadS;
  for (std::size_t sent = 0; sent < bytes.size();) {
    // 62 bytes come back as one full packet, which waits for no timer.
    const auto chunk = bytes.subspan(sent, std::min(kFtdiPayloadBytes, bytes.size() - sent));
    if (!wait_for(link, clock, kEchoS, [&] { return !link.is_sending(); })) {
      return or_link(link, FalconFault::bad_echo);
    }
    link.clear_received();
    if (link.send(chunk) != FalconFault::none) return link.failure();
    for (std::size_t seen = 0; seen < chunk.size(); seen = link.received().size()) {
      const bool is_more =
          wait_for(link, clock, kEchoS, [&] { return link.received().size() > seen; });
      if (!is_more) return or_link(link, FalconFault::bad_echo);
    }
    if (!std::ranges::equal(link.received(), chunk)) return FalconFault::bad_echo;
    sent += chunk.size();
    if (clock.now_s() > end_s) return FalconFault::bad_echo;
    if (!progress(static_cast<double>(sent) / static_cast<double>(bytes.size()))) break;
  }
  return FalconFault::none;
}

}  // namespace

FalconFault enter_run_mode(FalconLink& link, bool flushes_at_packet_end) {
  FalconFault fault =
      request(link, {kFtdiPurgeIn, kFtdiPurgeOut, ftdi_latency(kRunLatencyMs), kFtdiRunBaud});
  if (flushes_at_packet_end && fault == FalconFault::none) {
    fault = link.control(kFtdiEventAtPacketEnd);
  }
  if (fault != FalconFault::none) return fault;
  fault = request(link, {kFtdiPurgeIn, kFtdiPurgeOut});
  link.clear_received();
  return fault;
}

FalconFault upload_falcon_firmware(FalconLink& link, LinkClock& clock,
                                   const FalconFirmware& firmware, const UploadProgress& progress) {
  if (const FalconFault fault = enter_boot_mode(link); fault != FalconFault::none) return fault;
  if (const FalconFault fault = greet(link, clock); fault != FalconFault::none) return fault;
  if (const FalconFault fault = lock_baud(link, clock); fault != FalconFault::none) return fault;
  return send_firmware(link, clock, firmware.bytes(), progress);
}

}  // namespace argil::haptics
