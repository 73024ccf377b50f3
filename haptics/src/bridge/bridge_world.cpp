// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/bridge/bridge_world.h"

#include <algorithm>

#include "math/units.h"

namespace argil::haptics {

BridgeProxy BridgeWorld::nearest(const Vec3& place_mm) const noexcept {
  BridgeProxy found;
  if (options_.shape == BridgeShape::ball) {
    const Vec3 centre{0.0, -options_.ball_radius_mm, 0.0};
    const Vec3 out = place_mm - centre;
    if (length(out) > 0.0) found.plane_normal = normalized(out);
    found.distance_mm = length(out) - options_.ball_radius_mm;
    found.plane_point_mm = centre + options_.ball_radius_mm * found.plane_normal;
  } else {
    found.distance_mm = place_mm.y;
    found.plane_point_mm = {place_mm.x, 0.0, place_mm.z};
  }
  return found;
}

/// A frame: the proxy goes where the handle is, but not into the matter.
void BridgeWorld::answer(const BridgeState& state) noexcept {
  BridgeProxy proxy = nearest(state.position_mm);
  const double depth_mm = std::max(0.0, -proxy.distance_mm);
  proxy.header.sequence = ++sequence_;
  proxy.header.time_ns = state.header.time_ns;
  proxy.header.flags =
      kBridgePlane | (depth_mm > 0.0 ? kBridgeContact : 0U) | (is_stopped_ ? kBridgeStop : 0U);
  proxy.echo_sequence = state.header.sequence;
  proxy.echo_time_ns = state.header.time_ns;
  proxy.position_mm = state.position_mm + depth_mm * proxy.plane_normal;
  if (depth_mm > 0.0) {
    const double speed = dot(state.velocity_mm_per_s, proxy.plane_normal);
    const double push =
        (welcome_.stiffness_n_per_m * depth_mm - welcome_.damping_n_s_per_m * speed) / kMmPerM;
    proxy.direct_force_n = std::max(0.0, push) * proxy.plane_normal;
  }
  post(encode(proxy), now_s_ + options_.delay_s);
}

std::size_t BridgeWorld::receive(std::span<std::byte> into, BridgeAddress& from) noexcept {
  if (!has_greeted_ && !is_dead_) {
    has_greeted_ = true;
    BridgeHello hello;
    hello.header.sequence = ++sequence_;
    hello.rate_hz = options_.rate_hz;
    post(encode(hello), now_s_);
  }
  if (out_.empty() || out_.front().due_s > now_s_) return 0;
  const BridgeDatagram datagram = out_.front().datagram;
  out_.pop_front();
  from = kAddress;
  std::copy_n(datagram.bytes.begin(), std::min(datagram.size, into.size()), into.begin());
  return datagram.size;
}

void BridgeWorld::send(std::span<const std::byte> datagram, const BridgeAddress&) noexcept {
  const auto message = decode(datagram);
  if (!message) return;
  if (const auto* state = std::get_if<BridgeState>(&*message)) {
    now_s_ = static_cast<double>(state->header.time_ns) / kNsPerS;
    if (is_dead_ || !is_welcome_) return;
    // Half a nanosecond early is on time: STATE counts whole nanoseconds.
    if (now_s_ + 0.5 / kNsPerS < next_frame_s_) return;
    next_frame_s_ += 1.0 / options_.rate_hz;
    next_frame_s_ = std::max(next_frame_s_, now_s_);  // frames of a gap are not made up for
    answer(*state);
  } else if (const auto* welcome = std::get_if<BridgeWelcome>(&*message); welcome && !is_dead_) {
    welcome_ = *welcome;
    is_welcome_ = true;
  }
}

void BridgeWorld::set_dead(bool is_dead) noexcept {
  is_dead_ = is_dead;
  is_welcome_ = false;
  has_greeted_ = false;
  out_.clear();
}

void BridgeWorld::say_bye() noexcept {
  BridgeBye bye;
  bye.header.sequence = ++sequence_;
  post(encode(bye), 0.0);
  is_welcome_ = false;
}

}  // namespace argil::haptics
