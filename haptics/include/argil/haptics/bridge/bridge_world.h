// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cassert>
#include <cstdint>
#include <deque>

#include "argil/haptics/bridge/bridge_link.h"
#include "argil/haptics/bridge/bridge_message.h"

namespace argil::haptics {

enum class BridgeShape { floor, ball };

struct BridgeWorldOptions {
  /// The half space y < 0, or a ball that touches y = 0 from below.
  BridgeShape shape = BridgeShape::floor;
  /// > 0.
  double ball_radius_mm = 40.0;
  /// Of the simulator's frames; 10 to 4000, no faster than the servo.
  double rate_hz = 60.0;
  /// From a frame's STATE until its PROXY arrives; >= 0.
  double delay_s = 0.0;
};

/// A simulated 3D simulator within the process, on the virtual time of the states that it is sent:
/// what examples/blender/stand_in.py is over UDP.
///
/// Determinism  same options and states: same bits.
/// Threads      one; allocates.
class BridgeWorld final : public BridgeLink {
 public:
  /// Where its datagrams seem to come from.
  static constexpr BridgeAddress kAddress{0, 1};

  explicit BridgeWorld(const BridgeWorldOptions& options) : options_(options) {
    assert(options.ball_radius_mm > 0.0 && options.rate_hz > 0.0 && options.delay_s >= 0.0);
  }

  std::size_t receive(std::span<std::byte> into, BridgeAddress& from) noexcept override;
  void send(std::span<const std::byte> datagram, const BridgeAddress& to) noexcept override;
  bool wait(double) noexcept override { return !out_.empty(); }

  /// True kills it: it says nothing and loses what it is sent. False brings it back, beginning with
  /// HELLO.
  void set_dead(bool is_dead) noexcept;
  /// From the next frame on it says stop, or no longer.
  void stop(bool is_stopped) noexcept { is_stopped_ = is_stopped; }
  /// It leaves.
  void say_bye() noexcept;

  bool is_welcome() const noexcept { return is_welcome_; }
  /// The nearest point of the surface, the normal there, out of the matter, and the distance.
  BridgeProxy nearest(const Vec3& place_mm) const noexcept;

 private:
  struct Letter {
    BridgeDatagram datagram;
    double due_s;
  };
  void post(const BridgeDatagram& datagram, double due_s) noexcept {
    out_.push_back({datagram, due_s});
  }
  void answer(const BridgeState& state) noexcept;

  BridgeWorldOptions options_;
  BridgeWelcome welcome_;
  bool is_welcome_ = false;
  bool has_greeted_ = false;
  bool is_dead_ = false;
  bool is_stopped_ = false;
  std::deque<Letter> out_;
  std::uint64_t sequence_ = 0;
  double now_s_ = 0.0;
  double next_frame_s_ = 0.0;
};

}  // namespace argil::haptics
