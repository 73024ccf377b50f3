// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "argil/core/vec3.h"
#include "argil/haptics/scene/scene.h"

namespace argil::haptics {

enum class CouplingKind {
  /// The handle itself is in the scene (eq. 4.1); nothing limits the stiffness.
  direct,
  /// A spring between the handle and a proxy in the scene (eq. 4.2; default).
  indirect,
};

struct CouplingOptions {
  CouplingKind kind = CouplingKind::indirect;
  /// k_c, the most that is used; usual 1500, > 0. The governor may use less.
  double stiffness_n_per_m = 1500.0;
  /// b_c, on the handle's motion against the proxy while the proxy touches; usual 0, 0 to 5. More
  /// brings quantisation buzz.
  double damping_n_s_per_m = 0.0;
  /// The sign of eq. 4.2 as the Falcon report prints it, which repels the handle from the proxy.
  /// For the lab only.
  bool as_printed = false;
};

struct CoupledForce {
  /// On the handle.
  Vec3 force_n;
  /// The handle's position where nothing is touched, and always when direct.
  Vec3 proxy_mm;
  /// Bits of SceneFault.
  std::uint32_t faults = kSceneSound;
  /// How often the scene was asked.
  int queries = 0;
};

/// Virtual coupling: from a scene's force to what the handle feels.
///
/// Indirect, the proxy has no mass, so that it rests where the scene's force balances the spring,
/// F(p) + k_c (x - p) = 0. The search starts from the last proxy, so that it stays on the side it
/// came from, and asks the scene for forces at the proxy only: first along the pull, by bracketing
/// and the Illinois rule, which finds a rigid wall's step as well as a spring's slope; then across
/// it by Newton steps, so that in a groove the handle is not held sideways more stiffly than k_c
/// either. The handle feels the spring, whose stiffness in series with the scene's never exceeds
/// k_c, whatever the scene. Where the handle touches nothing the proxy is the handle, and nothing
/// is felt.
///
/// Accuracy  the balance holds within 0.1 mN along and 1 mN across the force, or as near as the
///           scene's most_queries allow (Coupling.*).
/// Threads   Realtime.
/// Cost      up to scene.most_queries() + 2 calls of force_at in a tick, usually 5 to 8.
/// Source    eq. 4.1 and 4.2 of the Falcon report (docs/equations.md); R. Adams, B. Hannaford,
///           "Stable haptic interaction with virtual environments", IEEE Trans. Robotics and
///           Automation 15 (1999), for why k_c alone has to be stable. Ours has no proxy mass.
class Coupling {
 public:
  explicit Coupling(const CouplingOptions& options) noexcept : options_(options) {}

  /// One tick of `period_s` at a finite handle. `most_stiffness_n_per_m`: the governor's, > 0, may
  /// be infinite.
  CoupledForce tick(const ForceScene& scene, const HandleState& handle,
                    double most_stiffness_n_per_m, double period_s) noexcept;

  /// Forgets the proxy: for a fault or a jump of the handle.
  void reset() noexcept { touches_ = false; }

  const CouplingOptions& options() const noexcept { return options_; }

 private:
  struct Line;
  /// Two distances out from the handle and the excess of the scene's push over the spring's pull
  /// there: positive at `low`, negative at `high`.
  struct Bracket {
    double low;
    double low_n;
    double high;
    double high_n;
  };
  double balance(const Line& line, double from_mm, CoupledForce& out) const noexcept;
  template <class Excess>
  static double narrow(const Excess& excess, Bracket bracket, int most_queries,
                       CoupledForce& out) noexcept;
  bool step_aside(Line& line, CoupledForce& out) const noexcept;
  void follow(const Line& line, CoupledForce& out) noexcept;

  CouplingOptions options_;
  bool touches_ = false;
  Vec3 proxy_mm_;        ///< of the last tick
  Vec3 direction_;       ///< of the scene's force there
  double out_mm_ = 0.0;  ///< from the handle to the proxy along direction_
};

}  // namespace argil::haptics
