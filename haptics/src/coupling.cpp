// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/coupling.h"

#include <algorithm>
#include <cmath>

namespace argil::haptics {
namespace {

constexpr double kMmPerM = 1000.0;
constexpr double kBalancedN = 1e-4;
constexpr double kAcrossN = 1e-3;
constexpr double kProbeMm = 0.02;
constexpr int kRounds = 4;

}  // namespace

/// The places where the proxy may be: from the handle outward, and beside that.
struct Coupling::Line {
  const ForceScene& scene;
  const HandleState& handle;
  Vec3 direction;
  Vec3 last_proxy_mm;
  double spring_n_per_mm;
  double period_s;
  Vec3 aside_mm;  ///< of the line from the handle, across the direction

  HandleState place(double way_mm) const noexcept {
    return place(handle.position_mm + aside_mm + way_mm * direction);
  }
  HandleState place(const Vec3& position_mm) const noexcept {
    HandleState at = handle;
    at.position_mm = position_mm;
    // The proxy's own motion, so that a scene's damper holds the proxy and not the handle.
    if (period_s > 0.0) at.velocity_mm_per_s = (at.position_mm - last_proxy_mm) / period_s;
    return at;
  }
};

/// The way from the handle at which the scene's push along the line equals the spring's pull. The
/// excess falls with the way wherever the scene pushes less further out.
double Coupling::balance(const Line& line, double scene_n_per_mm,
                         CoupledForce& out) const noexcept {
  const auto excess = [&](double way_mm) {
    const SceneForce felt = line.scene.force_at(line.place(way_mm));
    out.faults |= felt.faults;
    ++out.queries;
    if (!is_finite(felt.force_n)) out.faults |= kSceneNotFinite;
    return dot(felt.force_n, line.direction) - line.spring_n_per_mm * way_mm;
  };
  double low = 0.0;
  double low_n = excess(low);
  if (!(low_n > kBalancedN)) return 0.0;
  const int most = line.scene.most_queries();
  // A scene that pushes less further out has its balance before the spring alone holds the push;
  // where it is linear, there where spring and scene hold it together. Just beyond that, and
  // doubled until it brackets.
  double high = 1.001 * low_n / (line.spring_n_per_mm + scene_n_per_mm);
  double high_n = 0.0;
  for (high_n = excess(high); high_n > kBalancedN && out.queries < most; high_n = excess(high)) {
    low = high;
    low_n = high_n;
    high *= 2.0;
  }
  int kept = 0;         // which end stayed, to halve its weight: the Illinois rule
  bool halves = false;  // where the secant stalls: a rigid wall's force is a step
  while (out.queries < most && std::abs(high_n) > kBalancedN && high - low > 1e-12) {
    const double width = high - low;
    const double way = halves ? 0.5 * (low + high) : low + width * low_n / (low_n - high_n);
    const double way_n = excess(way);
    if (std::abs(way_n) <= kBalancedN) return way;
    halves = !halves && (way_n > 0.0 ? high - way : way - low) > 0.5 * width;
    if (way_n > 0.0) {
      low = way;
      low_n = way_n;
      if (kept == 1) high_n *= 0.5;
      kept = 1;
    } else {
      high = way;
      high_n = way_n;
      if (kept == -1) low_n *= 0.5;
      kept = -1;
    }
  }
  return high;
}

CoupledForce Coupling::tick(const ForceScene& scene, const HandleState& handle,
                            double most_stiffness_n_per_m, double period_s) noexcept {
  CoupledForce out;
  out.proxy_mm = handle.position_mm;
  const SceneForce here = scene.force_at(handle);
  out.faults = here.faults;
  out.queries = 1;
  const double push_n = length(here.force_n);
  if (!std::isfinite(push_n)) out.faults |= kSceneNotFinite;
  if (!(push_n > 0.0) || !std::isfinite(push_n)) {
    touches_ = false;
    return out;
  }
  if (options_.kind == CouplingKind::direct) {
    out.force_n = here.force_n;
    return out;
  }
  Vec3 direction = here.force_n / push_n;
  if (touches_ && dot(direction_, here.force_n) > 0.5 * push_n) direction = direction_;
  const double spring = std::min(options_.stiffness_n_per_m, most_stiffness_n_per_m) / kMmPerM;
  const Vec3 last = touches_ ? proxy_mm_ : handle.position_mm - period_s * handle.velocity_mm_per_s;
  Line line{scene, handle, direction, last, spring, period_s, {}};
  const double stiffness = std::max(0.0, here.stiffness_n_per_m) / kMmPerM;
  for (int round = 0; round < kRounds; ++round) {
    way_mm_ = balance(line, stiffness, out);
    if (!(way_mm_ > 0.0) || !step_aside(line, out)) break;
  }
  follow(line, out);
  if (options_.as_printed) out.force_n *= -1.0;
  return out;
}

/// Where the scene pushes across the line as well, the proxy has to go that way too, or the line
/// would be a rail that holds the handle more stiffly than the spring: by a Newton step along that
/// push, with the stiffness measured there. False when there is nothing left to do.
bool Coupling::step_aside(Line& line, CoupledForce& out) const noexcept {
  if (out.queries + 2 > line.scene.most_queries()) return false;
  const HandleState at = line.place(way_mm_);
  const Vec3 push_n = line.scene.force_at(at).force_n;
  const Vec3 rest_n = push_n + line.spring_n_per_mm * (line.handle.position_mm - at.position_mm);
  const Vec3 across_n = rest_n - dot(rest_n, line.direction) * line.direction;
  const double size_n = length(across_n);
  ++out.queries;
  if (!(size_n > kAcrossN)) return false;
  const Vec3 across = across_n / size_n;
  const Vec3 beside_n = line.scene.force_at(line.place(at.position_mm + kProbeMm * across)).force_n;
  ++out.queries;
  const double stiffness = std::max(0.0, dot(push_n - beside_n, across) / kProbeMm);
  line.aside_mm += std::min(size_n / (line.spring_n_per_mm + stiffness), way_mm_) * across;
  return true;
}

/// Takes the proxy where the search has ended, and pulls the handle there.
void Coupling::follow(const Line& line, CoupledForce& out) noexcept {
  const HandleState proxy = line.place(way_mm_);
  const Vec3 pull = proxy.position_mm - line.handle.position_mm;
  const Vec3 proxy_velocity = touches_ ? proxy.velocity_mm_per_s : line.handle.velocity_mm_per_s;
  touches_ = way_mm_ > 0.0;
  direction_ = touches_ ? normalized(pull) : line.direction;
  proxy_mm_ = proxy.position_mm;
  out.proxy_mm = proxy_mm_;
  out.force_n = line.spring_n_per_mm * pull;
  if (touches_) {
    const double relative = dot(proxy_velocity - line.handle.velocity_mm_per_s, direction_);
    out.force_n += options_.damping_n_s_per_m / kMmPerM * relative * direction_;
  }
}

}  // namespace argil::haptics
