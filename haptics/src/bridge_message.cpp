// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/bridge_message.h"

#include <bit>
#include <cassert>
#include <cmath>

namespace argil::haptics {
namespace {

constexpr double kMostNumber = 1e9;
constexpr double kLeastRateHz = 10.0;  // slower, the 100 ms of the watch would chop the force
constexpr double kMostRateHz = 4000.0;
constexpr double kUnitWithin = 1e-3;
constexpr std::uint32_t kMostLaw = 3;

/// What of a datagram's size and place depends on the kind alone.
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

/// Appends fields.
class Writer {
 public:
  template <class Number>
  void unsigned_field(Number& value) noexcept {
    const auto wide = static_cast<std::uint64_t>(value);
    for (std::size_t n = 0; n < sizeof(Number); ++n) {
      out.bytes[out.size++] = static_cast<std::byte>(wide >> (8 * n));
    }
  }
  void field(std::uint16_t& value) noexcept { unsigned_field(value); }
  void field(std::uint32_t& value) noexcept { unsigned_field(value); }
  void field(std::uint64_t& value) noexcept { unsigned_field(value); }
  void field(double& value) noexcept {
    auto bits = std::bit_cast<std::uint64_t>(value);
    unsigned_field(bits);
  }
  BridgeDatagram out;
};

/// Takes them in the same order; the length was checked before.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) noexcept : bytes_(bytes) {}
  template <class Number>
  void unsigned_field(Number& value) noexcept {
    assert(at_ + sizeof(Number) <= bytes_.size());
    std::uint64_t wide = 0;
    for (std::size_t n = 0; n < sizeof(Number); ++n) {
      wide |= static_cast<std::uint64_t>(bytes_[at_++]) << (8 * n);
    }
    value = static_cast<Number>(wide);
  }
  void field(std::uint16_t& value) noexcept { unsigned_field(value); }
  void field(std::uint32_t& value) noexcept { unsigned_field(value); }
  void field(std::uint64_t& value) noexcept { unsigned_field(value); }
  void field(double& value) noexcept {
    std::uint64_t bits = 0;
    unsigned_field(bits);
    value = std::bit_cast<double>(bits);
    is_good = is_good && std::abs(value) <= kMostNumber;  // also no NaN
  }
  bool is_good = true;

 private:
  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
};

// The layout, once for both directions.
template <class Stream>
void field(Stream& stream, Vec3& v) noexcept {
  stream.field(v.x);
  stream.field(v.y);
  stream.field(v.z);
}

struct Prefix {
  std::uint32_t magic = kBridgeMagic;
  std::uint16_t version = kBridgeVersion;
  std::uint16_t kind = 0;
  std::uint32_t size = 0;
};
template <class Stream>
void head(Stream& stream, Prefix& prefix, BridgeHeader& header) noexcept {
  stream.field(prefix.magic);
  stream.field(prefix.version);
  stream.field(prefix.kind);
  stream.field(header.flags);
  stream.field(prefix.size);
  stream.field(header.sequence);
  stream.field(header.time_ns);
}

template <class Stream>
void body(Stream& stream, BridgeHello& hello) noexcept {
  stream.field(hello.rate_hz);
}
template <class Stream>
void body(Stream& stream, BridgeWelcome& welcome) noexcept {
  stream.field(welcome.rate_hz);
  stream.field(welcome.stiffness_n_per_m);
  stream.field(welcome.damping_n_s_per_m);
  stream.field(welcome.scale);
  stream.field(welcome.law);
  std::uint32_t unused = 0;
  stream.field(unused);
}
template <class Stream>
void body(Stream& stream, BridgeState& state) noexcept {
  field(stream, state.position_mm);
  field(stream, state.velocity_mm_per_s);
  field(stream, state.force_n);
  stream.field(state.buttons);
  std::uint32_t unused = 0;
  stream.field(unused);
}
template <class Stream>
void body(Stream& stream, BridgeProxy& proxy) noexcept {
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
void body(Stream& stream, BridgeBye& bye) noexcept {
  auto reason = static_cast<std::uint32_t>(bye.reason);
  stream.field(reason);
  bye.reason = static_cast<BridgeReason>(reason);
  std::uint32_t unused = 0;
  stream.field(unused);
}

bool is_rate(double rate_hz) noexcept { return rate_hz >= kLeastRateHz && rate_hz <= kMostRateHz; }
bool is_unit(double length) noexcept { return std::abs(length - 1.0) <= kUnitWithin; }

bool is_sound(const BridgeHello& hello) noexcept { return is_rate(hello.rate_hz); }
bool is_sound(const BridgeWelcome& welcome) noexcept {
  return is_rate(welcome.rate_hz) && welcome.stiffness_n_per_m > 0.0 &&
         welcome.damping_n_s_per_m >= 0.0 && welcome.scale > 0.0 && welcome.law <= kMostLaw;
}
bool is_sound(const BridgeState&) noexcept { return true; }
bool is_sound(const BridgeProxy& proxy) noexcept {
  const Quat& q = proxy.orientation;
  return is_unit(std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z)) &&
         is_unit(length(proxy.plane_normal));
}
bool is_sound(const BridgeBye& bye) noexcept { return bye.reason <= BridgeReason::busy; }

template <class Message>
std::optional<BridgeMessage> read(std::span<const std::byte> bytes) noexcept {
  Message message;
  const std::size_t wanted = layout_of(message).bytes;
  if (bytes.size() != wanted) return std::nullopt;
  Reader reader(bytes);
  Prefix prefix;
  head(reader, prefix, message.header);
  body(reader, message);
  const bool is_good = reader.is_good && prefix.size == wanted &&
                       (message.header.flags & ~kBridgeFlags) == 0 && is_sound(message);
  if (!is_good) return std::nullopt;
  return message;
}

}  // namespace

BridgeDatagram encode(const BridgeMessage& message) noexcept {
  return std::visit(
      [](auto copy) {
        Writer writer;
        const Layout layout = layout_of(copy);
        Prefix prefix;
        prefix.kind = static_cast<std::uint16_t>(layout.kind);
        prefix.size = static_cast<std::uint32_t>(layout.bytes);
        head(writer, prefix, copy.header);
        assert(writer.out.size == kBridgeHeaderBytes);
        body(writer, copy);
        assert(writer.out.size == layout.bytes);
        return writer.out;
      },
      message);
}

std::optional<BridgeMessage> decode(std::span<const std::byte> bytes) noexcept {
  if (bytes.size() < kBridgeHeaderBytes) return std::nullopt;
  Reader reader(bytes);
  Prefix prefix;
  BridgeHeader header;
  head(reader, prefix, header);
  if (prefix.magic != kBridgeMagic || prefix.version != kBridgeVersion) return std::nullopt;
  switch (static_cast<BridgeKind>(prefix.kind)) {
    case BridgeKind::hello:
      return read<BridgeHello>(bytes);
    case BridgeKind::welcome:
      return read<BridgeWelcome>(bytes);
    case BridgeKind::state:
      return read<BridgeState>(bytes);
    case BridgeKind::proxy:
      return read<BridgeProxy>(bytes);
    case BridgeKind::bye:
      return read<BridgeBye>(bytes);
  }
  return std::nullopt;
}

}  // namespace argil::haptics
