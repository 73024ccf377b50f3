// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/bridge/bridge_message.h"

#include <cassert>
#include <cmath>

#include "argil/haptics/bridge/bridge_law.h"

#include "bridge/wire_fields.h"

namespace argil::haptics {
namespace {

/// Of numbers that are not lengths: a force or a speed that is too much is felt as far as the
/// safety gate allows.
constexpr double kMostBridgeNumber = 1e9;
constexpr double kLeastRateHz = 10.0;  // slower, the 100 ms of the watch would chop the force
constexpr double kMostRateHz = 4000.0;
constexpr double kUnitWithin = 1e-3;
constexpr auto kMostLaw = static_cast<std::uint32_t>(kLastBridgeLaw);

/// What of a datagram depends on its kind alone.
struct Layout {
  BridgeKind kind;
  std::size_t bytes;
};
Layout layout_of(const BridgeHello&) noexcept { return {BridgeKind::hello, kBridgeHelloBytes}; }
Layout layout_of(const BridgeWelcome&) noexcept {
  return {BridgeKind::welcome, kBridgeWelcomeBytes};
}
Layout layout_of(const BridgeState&) noexcept { return {BridgeKind::state, kBridgeStateBytes}; }
Layout layout_of(const BridgeProxy&) noexcept { return {BridgeKind::proxy, kBridgeProxyBytes}; }
Layout layout_of(const BridgeBye&) noexcept { return {BridgeKind::bye, kBridgeByeBytes}; }

// The layout, once for both directions.
struct Prefix {
  std::uint32_t magic = kBridgeMagic;
  std::uint16_t version = kBridgeVersion;
  std::uint16_t kind = 0;
  std::uint32_t size = 0;
};
template <class Stream>
void bridge_head(Stream& stream, Prefix& prefix, BridgeHeader& header) noexcept {
  stream.field(prefix.magic);
  stream.field(prefix.version);
  stream.field(prefix.kind);
  stream.field(header.flags);
  stream.field(prefix.size);
  stream.field(header.sequence);
  stream.field(header.time_ns);
}

template <class Stream>
void bridge_body(Stream& stream, BridgeHello& hello) noexcept {
  stream.field(hello.rate_hz);
}
template <class Stream>
void bridge_body(Stream& stream, BridgeWelcome& welcome) noexcept {
  stream.field(welcome.rate_hz);
  stream.field(welcome.stiffness_n_per_m);
  stream.field(welcome.damping_n_s_per_m);
  stream.field(welcome.scale);
  stream.field(welcome.law);
  std::uint32_t unused = 0;
  stream.field(unused);
}
template <class Stream>
void bridge_body(Stream& stream, BridgeState& state) noexcept {
  field(stream, state.position_mm);
  field(stream, state.velocity_mm_per_s);
  field(stream, state.force_n);
  stream.field(state.buttons);
  std::uint32_t unused = 0;
  stream.field(unused);
}
template <class Stream>
void bridge_body(Stream& stream, BridgeProxy& proxy) noexcept {
  stream.field(proxy.echo_sequence);
  stream.field(proxy.echo_time_ns);
  field(stream, proxy.position_mm);
  stream.field(proxy.orientation.w);
  stream.field(proxy.orientation.x);
  stream.field(proxy.orientation.y);
  stream.field(proxy.orientation.z);
  field(stream, proxy.velocity_mm_per_s);
  field(stream, proxy.plane_point_mm);
  field(stream, proxy.plane_normal);
  field(stream, proxy.direct_force_n);
  stream.field(proxy.distance_mm);
}
template <class Stream>
void bridge_body(Stream& stream, BridgeBye& bye) noexcept {
  auto reason = static_cast<std::uint32_t>(bye.reason);
  stream.field(reason);
  bye.reason = static_cast<BridgeReason>(reason);
  std::uint32_t unused = 0;
  stream.field(unused);
}

bool is_rate(double rate_hz) noexcept { return rate_hz >= kLeastRateHz && rate_hz <= kMostRateHz; }
bool is_unit_length(double length) noexcept { return std::abs(length - 1.0) <= kUnitWithin; }

bool is_sound_message(const BridgeHello& hello) noexcept { return is_rate(hello.rate_hz); }
bool is_sound_message(const BridgeWelcome& welcome) noexcept {
  return is_rate(welcome.rate_hz) && welcome.stiffness_n_per_m > 0.0 &&
         welcome.damping_n_s_per_m >= 0.0 && welcome.scale > 0.0 && welcome.law <= kMostLaw;
}
bool is_sound_message(const BridgeState& state) noexcept { return is_in_reach(state.position_mm); }
bool is_sound_message(const BridgeProxy& proxy) noexcept {
  const Quat& q = proxy.orientation;
  return is_in_reach(proxy.position_mm) && is_in_reach(proxy.plane_point_mm) &&
         std::abs(proxy.distance_mm) <= kMaxReachMm &&
         is_unit_length(std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z)) &&
         is_unit_length(length(proxy.plane_normal));
}
bool is_sound_message(const BridgeBye& bye) noexcept { return bye.reason <= BridgeReason::busy; }

template <class Message>
std::optional<BridgeMessage> read_message(std::span<const std::byte> bytes) noexcept {
  Message message;
  const std::size_t wanted = layout_of(message).bytes;
  if (bytes.size() != wanted) return std::nullopt;
  FieldReader reader(bytes, kMostBridgeNumber);
  Prefix prefix;
  bridge_head(reader, prefix, message.header);
  bridge_body(reader, message);
  const bool is_good = reader.is_good() && prefix.size == wanted &&
                       (message.header.flags & ~kBridgeFlags) == 0 && is_sound_message(message);
  if (!is_good) return std::nullopt;
  return message;
}

}  // namespace

BridgeDatagram encode(const BridgeMessage& message) noexcept {
  return std::visit(
      [](auto copy) {
        BridgeDatagram out;
        FieldWriter writer(out.bytes);
        const Layout layout = layout_of(copy);
        Prefix prefix;
        prefix.kind = static_cast<std::uint16_t>(layout.kind);
        prefix.size = static_cast<std::uint32_t>(layout.bytes);
        bridge_head(writer, prefix, copy.header);
        assert(writer.size() == kBridgeHeaderBytes);
        bridge_body(writer, copy);
        assert(writer.size() == layout.bytes);
        out.size = writer.size();
        return out;
      },
      message);
}

std::optional<BridgeMessage> decode(std::span<const std::byte> bytes) noexcept {
  if (bytes.size() < kBridgeHeaderBytes) return std::nullopt;
  FieldReader reader(bytes, kMostBridgeNumber);
  Prefix prefix;
  BridgeHeader header;
  bridge_head(reader, prefix, header);
  if (prefix.magic != kBridgeMagic || prefix.version != kBridgeVersion) return std::nullopt;
  switch (static_cast<BridgeKind>(prefix.kind)) {
    case BridgeKind::hello:
      return read_message<BridgeHello>(bytes);
    case BridgeKind::welcome:
      return read_message<BridgeWelcome>(bytes);
    case BridgeKind::state:
      return read_message<BridgeState>(bytes);
    case BridgeKind::proxy:
      return read_message<BridgeProxy>(bytes);
    case BridgeKind::bye:
      return read_message<BridgeBye>(bytes);
  }
  return std::nullopt;
}

}  // namespace argil::haptics
