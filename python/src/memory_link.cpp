// SPDX-License-Identifier: GPL-3.0-or-later
#include "memory_link.h"

#include <algorithm>
#include <chrono>
#include <thread>

namespace argil::python {
namespace {

constexpr haptics::BridgeAddress kSimulator{haptics::kLoopbackHost, 1};
constexpr std::chrono::microseconds kLookEvery{200};

/// Whether `there` comes to exceed `seen` within so long.
bool comes(const std::atomic<std::uint64_t>& there, std::uint64_t seen, double seconds) noexcept {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (there.load() <= seen) {
    if (std::chrono::steady_clock::now() >= end) return false;
    std::this_thread::sleep_for(kLookEvery);
  }
  return true;
}

MemoryLink::Datagram datagram_of(std::span<const std::byte> bytes) noexcept {
  MemoryLink::Datagram datagram;
  datagram.size = bytes.size();
  std::copy(bytes.begin(), bytes.end(), datagram.bytes.begin());
  return datagram;
}

}  // namespace

std::size_t MemoryLink::receive(std::span<std::byte> into, haptics::BridgeAddress& from) noexcept {
  Datagram datagram;
  if (!to_bridge_.pop(datagram)) return 0;
  ++received_;
  from = kSimulator;
  std::copy_n(datagram.bytes.begin(), std::min(datagram.size, into.size()), into.begin());
  return datagram.size;
}

void MemoryLink::send(std::span<const std::byte> datagram, const haptics::BridgeAddress&) noexcept {
  if (datagram.size() > haptics::kBridgeMostBytes) return;
  if (to_simulator_.push(datagram_of(datagram))) ++sent_;
}

bool MemoryLink::wait(double seconds) noexcept { return comes(put_, received_, seconds); }

bool MemoryLink::put(std::span<const std::byte> datagram) noexcept {
  if (datagram.empty() || datagram.size() > haptics::kBridgeMostBytes) return false;
  if (!to_bridge_.push(datagram_of(datagram))) return false;
  ++put_;
  return true;
}

std::optional<MemoryLink::Datagram> MemoryLink::take() noexcept {
  Datagram datagram;
  if (!to_simulator_.pop(datagram)) return std::nullopt;
  ++taken_;
  return datagram;
}

bool MemoryLink::wait_to_take(double seconds) noexcept { return comes(sent_, taken_, seconds); }

}  // namespace argil::python
