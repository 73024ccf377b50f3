// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>

#include "argil/core/vec3.h"

namespace argil::haptics {

// The datagrams between the bridge and a 3D simulator. Each has one size, numbers are
// little-endian, floating-point numbers binary64, and there is no padding. Frame and units are the
// device's: mm about the middle of the workspace, x to the right, y up, z towards the user; mm/s,
// N, s. examples/blender/argil_bridge.py is the other side's copy of this layout.
//
// All begin with 32 bytes: magic u32, version u16, kind u16, flags u32, size u32 (of the whole
// datagram), sequence u64 (of its sender, rising), time u64 (of its sender's monotonic clock, ns).

inline constexpr std::uint32_t kBridgeMagic = 0x42475241;  ///< "ARGB"
inline constexpr std::uint16_t kBridgeVersion = 1;

enum class BridgeKind : std::uint16_t { hello = 1, welcome = 2, state = 3, proxy = 4, bye = 5 };

inline constexpr std::size_t kBridgeHeaderBytes = 32;
inline constexpr std::size_t kBridgeSequenceAt = 16;  ///< in a header
inline constexpr std::size_t kBridgeHelloBytes = 40;
inline constexpr std::size_t kBridgeWelcomeBytes = 72;
inline constexpr std::size_t kBridgeStateBytes = 112;
inline constexpr std::size_t kBridgeProxyBytes = 208;
inline constexpr std::size_t kBridgeByeBytes = 40;
inline constexpr std::size_t kBridgeMostBytes = kBridgeProxyBytes;

/// Bits of BridgeHeader::flags, with the message that may have each.
enum BridgeFlag : std::uint32_t {
  /// STATE, in lockstep: the bridge waits for the PROXY that echoes this one.
  kBridgeFrame = 1U << 0,
  /// WELCOME: time is virtual; answer every STATE with kBridgeFrame.
  kBridgeLockstep = 1U << 1,
  /// PROXY: the proxy touches; without it the laws direct and indirect give no force.
  kBridgeContact = 1U << 2,
  /// PROXY: plane and distance are known, touching or not.
  kBridgePlane = 1U << 3,
  /// PROXY: no force at once, until a PROXY without it.
  kBridgeStop = 1U << 4,
};
/// All of them; a message with another bit is malformed.
inline constexpr std::uint32_t kBridgeFlags = 0x1F;

struct BridgeHeader {
  std::uint64_t sequence = 0;
  std::uint64_t time_ns = 0;
  std::uint32_t flags = 0;
  friend bool operator==(const BridgeHeader&, const BridgeHeader&) = default;
};

/// Simulator to bridge, again and again until it is welcomed.
struct BridgeHello {
  BridgeHeader header;
  /// How often the simulator will send PROXY; 10 to 4000.
  double rate_hz = 60.0;
  friend bool operator==(const BridgeHello&, const BridgeHello&) = default;
};

/// Bridge to simulator: the session has begun.
struct BridgeWelcome {
  BridgeHeader header;
  /// Of the servo.
  double rate_hz = 1000.0;
  /// k of the law; > 0.
  double stiffness_n_per_m = 1500.0;
  /// c of the law; >= 0.
  double damping_n_s_per_m = 0.0;
  /// mm of the simulator's scene for a mm of the hand; > 0.
  double scale = 1.0;
  /// A value of BridgeLaw.
  std::uint32_t law = 2;
  friend bool operator==(const BridgeWelcome&, const BridgeWelcome&) = default;
};

/// Bridge to simulator, every tick of the servo.
struct BridgeState {
  BridgeHeader header;
  Vec3 position_mm;
  Vec3 velocity_mm_per_s;
  /// What the device was given.
  Vec3 force_n;
  std::uint32_t buttons = 0;
  friend bool operator==(const BridgeState&, const BridgeState&) = default;
};

/// Simulator to bridge: where the proxy is, and what it touches.
struct BridgeProxy {
  BridgeHeader header;
  /// Sequence of the STATE that it answers.
  std::uint64_t echo_sequence = 0;
  /// Time of that STATE.
  std::uint64_t echo_time_ns = 0;
  Vec3 position_mm;
  /// Unit length within 1e-3.
  Quat orientation;
  Vec3 velocity_mm_per_s;
  Vec3 plane_point_mm;
  /// Out of the matter; unit length within 1e-3.
  Vec3 plane_normal{0.0, 1.0, 0.0};
  /// On the handle; of the direct law.
  Vec3 direct_force_n;
  /// Of the handle from the surface, negative inside.
  double distance_mm = 0.0;
  friend bool operator==(const BridgeProxy&, const BridgeProxy&) = default;
};

enum class BridgeReason : std::uint32_t {
  /// The program ends.
  ends = 0,
  /// The bridge refuses the simulator's rate with this law and stiffness.
  too_stiff = 1,
  /// The bridge has another simulator.
  busy = 2,
};

/// From either side: it leaves.
struct BridgeBye {
  BridgeHeader header;
  BridgeReason reason = BridgeReason::ends;
  friend bool operator==(const BridgeBye&, const BridgeBye&) = default;
};

using BridgeMessage = std::variant<BridgeHello, BridgeWelcome, BridgeState, BridgeProxy, BridgeBye>;

/// A datagram as it is sent.
struct BridgeDatagram {
  std::array<std::byte, kBridgeMostBytes> bytes{};
  std::size_t size = 0;
  std::span<const std::byte> span() const noexcept { return {bytes.data(), size}; }
};

/// The datagram of a message.
///
/// Threads  Realtime: any thread; no allocation.
BridgeDatagram encode(const BridgeMessage& message) noexcept;

/// The message of a datagram. None when it is malformed: wrong magic, version, kind, size or flag;
/// a number that is not finite or beyond 1e9; a rate, scale, unit vector, law or reason out of its
/// range. Reads no byte beyond `bytes`.
///
/// Threads  Realtime: any thread; no allocation.
std::optional<BridgeMessage> decode(std::span<const std::byte> bytes) noexcept;

}  // namespace argil::haptics
