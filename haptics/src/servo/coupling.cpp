// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/servo/coupling.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "math/units.h"

namespace argil::haptics {
namespace {

/// Within this the spring balances the scene along the force, and within that across it.
constexpr double kBalancedN = 1e-4;
constexpr double kAcrossN = 1e-3;
/// How far beside the proxy the scene is probed for its stiffness across the force.
constexpr double kProbeMm = 0.02;
/// Searches along the line, with a step aside after each.
constexpr int kRounds = 4;

}  // namespace

/// The line of positions where the proxy may be: from the handle outward, and parallel to that.
struct Coupling::Line {
  const ForceScene& scene;
  const HandleState& handle;
  Vec3 direction;
  Vec3 last_proxy_mm;
  double spring_n_per_mm;
  double period_s;
  Vec3 aside_mm;  ///< of the line from the handle, across the direction

  HandleState proxy_at(double out_mm) const noexcept {
    return proxy_at(handle.position_mm + aside_mm + out_mm * direction);
  }
  HandleState proxy_at(const Vec3& position_mm) const noexcept {
    HandleState at = handle;
    at.position_mm = position_mm;
    // The proxy's own motion, so that a scene's damper holds the proxy and not the handle.
    if (period_s > 0.0) at.velocity_mm_per_s = (at.position_mm - last_proxy_mm) / period_s;
    return at;
  }
};

/// How far out from the handle the scene's push along the line equals the spring's pull, searched
/// from `from_mm`; 0 where the handle itself is not pushed along it. The excess of push over pull
/// falls on the way out wherever the scene pushes less further out.
double Coupling::balance(const Line& line, double from_mm, CoupledForce& out) const noexcept {
  assert(from_mm >= 0.0 && line.spring_n_per_mm > 0.0 && is_finite(line.direction));
  double stiffness = 0.0;  // of the scene at the last query
  const auto excess = [&](double out_mm) {
    const SceneForce felt = line.scene.force_at(line.proxy_at(out_mm));
    ++out.queries;
    if (!is_finite(felt.force_n)) out.faults |= kSceneNotFinite;
    // Faults count wherever the scene is asked, except that a probe left the window.
    out.faults |= felt.faults & ~kSceneOutsideWindow;
    stiffness = std::max(0.0, felt.stiffness_n_per_m) / kMmPerM;
    return dot(felt.force_n, line.direction) - line.spring_n_per_mm * out_mm;
  };
  double low = from_mm;
  double high = from_mm;
  double low_n = excess(from_mm);
  double high_n = low_n;
  if (std::abs(low_n) <= kBalancedN) return from_mm;
  // Where the scene is a spring a Newton step ends just beyond the balance; else it is doubled
  // until it does.
  const int most = line.scene.most_queries();
  double step = 1.001 * std::abs(low_n) / (line.spring_n_per_mm + stiffness);
  while (low_n > kBalancedN && high_n > kBalancedN && out.queries < most) {
    low = high;
    low_n = high_n;
    high += step;
    high_n = excess(high);
    step *= 2.0;
  }
  // Inward no further at first than the surface can have come: a long step would pass through a
  // sheet to the handle behind it.
  if (low_n < -kBalancedN) {
    const double left_mm =
        dot(line.proxy_at(from_mm).position_mm - line.last_proxy_mm, line.direction);
    step = std::min(step, std::abs(left_mm) + kProbeMm);
  }
  while (low_n < -kBalancedN && low > 0.0 && out.queries < most) {
    high = low;
    high_n = low_n;
    low = std::max(0.0, low - step);
    low_n = excess(low);
    step *= 2.0;
  }
  if (low_n < -kBalancedN) return low;
  return narrow(excess, {low, low_n, high, high_n}, most, out);
}

/// Narrows a bracket from where the push is too strong to where the pull is: by the Illinois rule,
/// and by bisection where its secant stalls, as on a rigid wall, whose force is a step.
template <class Excess>
double Coupling::narrow(const Excess& excess, Bracket b, int most_queries,
                        CoupledForce& out) noexcept {
  assert(b.low <= b.high && b.low >= 0.0);
  int kept = 0;  // which end stayed, to halve its weight
  bool halves = false;
  if (std::abs(b.low_n) <= kBalancedN) return b.low;
  while (out.queries < most_queries && std::abs(b.high_n) > kBalancedN && b.high - b.low > 1e-12) {
    const double width = b.high - b.low;
    const double out_mm =
        halves ? 0.5 * (b.low + b.high) : b.low + width * b.low_n / (b.low_n - b.high_n);
    const double excess_n = excess(out_mm);
    if (std::abs(excess_n) <= kBalancedN) return out_mm;
    halves = !halves && (excess_n > 0.0 ? b.high - out_mm : out_mm - b.low) > 0.5 * width;
    if (excess_n > 0.0) {
      b.low = out_mm;
      b.low_n = excess_n;
      if (kept == 1) b.high_n *= 0.5;
      kept = 1;
    } else {
      b.high = out_mm;
      b.high_n = excess_n;
      if (kept == -1) b.low_n *= 0.5;
      kept = -1;
    }
  }
  return b.high;
}

/// A direct coupling, or a handle that touches nothing yet, asks the scene at the handle; otherwise
/// the search goes on from the last proxy.
CoupledForce Coupling::tick(const ForceScene& scene, const HandleState& handle,
                            double most_stiffness_n_per_m, double period_s) noexcept {
  assert(is_finite(handle.position_mm) && is_finite(handle.velocity_mm_per_s));
  assert(most_stiffness_n_per_m > 0.0 && options_.stiffness_n_per_m > 0.0);
  CoupledForce out;
  out.proxy_mm = handle.position_mm;
  const bool is_direct = options_.kind == CouplingKind::direct;
  if (is_direct || !touches_) {
    const SceneForce here = scene.force_at(handle);
    out.queries = 1;
    out.faults = here.faults;
    if (!is_finite(here.force_n)) {
      out.faults |= kSceneNotFinite;
      return out;
    }
    if (is_direct) {
      out.force_n = here.force_n;
      return out;
    }
    if (!(length(here.force_n) > 0.0)) return out;
    direction_ = normalized(here.force_n);
    out_mm_ = 0.0;
    proxy_mm_ = handle.position_mm - period_s * handle.velocity_mm_per_s;
  }
  const double spring = std::min(options_.stiffness_n_per_m, most_stiffness_n_per_m) / kMmPerM;
  Line line{scene, handle, direction_, proxy_mm_, spring, period_s, {}};
  for (int round = 0; round < kRounds; ++round) {
    out_mm_ = balance(line, out_mm_, out);
    if (!(out_mm_ > 0.0) || !step_aside(line, out)) break;
  }
  follow(line, out);
  if (options_.as_printed) out.force_n *= -1.0;
  return out;
}

/// Where the scene pushes across the line as well, the proxy has to move across too, or the line
/// would be a rail that holds the handle more stiffly than the spring: by a Newton step along that
/// push, with the stiffness measured there. False when there is nothing left to do.
bool Coupling::step_aside(Line& line, CoupledForce& out) const noexcept {
  if (out.queries + 2 > line.scene.most_queries()) return false;
  const HandleState at = line.proxy_at(out_mm_);
  const Vec3 push_n = line.scene.force_at(at).force_n;
  const Vec3 rest_n = push_n + line.spring_n_per_mm * (line.handle.position_mm - at.position_mm);
  const Vec3 across_n = rest_n - dot(rest_n, line.direction) * line.direction;
  const double size_n = length(across_n);
  ++out.queries;
  if (!(size_n > kAcrossN)) return false;
  const Vec3 across = across_n / size_n;
  const Vec3 beside_n =
      line.scene.force_at(line.proxy_at(at.position_mm + kProbeMm * across)).force_n;
  ++out.queries;
  const double stiffness = std::max(0.0, dot(push_n - beside_n, across) / kProbeMm);
  line.aside_mm += std::min(size_n / (line.spring_n_per_mm + stiffness), out_mm_) * across;
  return true;
}

/// Takes the proxy where the search has ended, and pulls the handle there.
void Coupling::follow(const Line& line, CoupledForce& out) noexcept {
  const bool had_proxy = touches_;
  touches_ = out_mm_ > 0.0;
  if (!touches_) return;
  const HandleState proxy = line.proxy_at(out_mm_);
  out.faults |= line.scene.force_at(proxy).faults;
  ++out.queries;
  const Vec3 pull = proxy.position_mm - line.handle.position_mm;
  direction_ = normalized(pull);
  out_mm_ = length(pull);
  proxy_mm_ = proxy.position_mm;
  out.proxy_mm = proxy_mm_;
  out.force_n = line.spring_n_per_mm * pull;
  if (!had_proxy) return;  // its velocity is known from the next tick on
  const double relative = dot(proxy.velocity_mm_per_s - line.handle.velocity_mm_per_s, direction_);
  out.force_n += options_.damping_n_s_per_m / kMmPerM * relative * direction_;
}

}  // namespace argil::haptics
