// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "argil/core/vec3.h"
#include "argil/haptics/scene.h"

namespace argil::haptics {

enum class CouplingKind {
  direct,    ///< eq. 4.1: the handle itself is in the scene; nothing limits the stiffness
  indirect,  ///< eq. 4.2: a spring between the handle and a proxy in the scene (default)
};

struct CouplingOptions {
  CouplingKind kind = CouplingKind::indirect;
  double stiffness_n_per_m =
      1500.0;                      ///< k_c, the most that is used; the governor may use less; > 0
  double damping_n_s_per_m = 0.0;  ///< b_c, on the handle's motion against the proxy while it
                                   ///< touches; 0 to 5, more brings quantisation buzz
  bool as_printed = false;  ///< the sign of eq. 4.2 as the report prints it: repels the handle
                            ///< from the proxy. For the lab only
};

struct CoupledForce {
  Vec3 force_n;   ///< on the handle
  Vec3 proxy_mm;  ///< the handle where nothing is touched, and always when direct
  std::uint32_t faults = kSceneSound;
  int queries = 0;  ///< how often the scene was asked
};

/// From what a scene says to what the handle feels.
///
/// indirect: the proxy has no mass, so it rests where the scene's force balances the spring, F(p) +
/// k_c (x - p) = 0. It is sought from where it was, so that it stays on the side it came from, and
/// the scene is asked about the place of the proxy only: first along the pull, by bracketing and
/// the Illinois rule, so that a rigid wall's step is found as well as a spring's slope; then across
/// it by Newton steps, so that in a groove the handle is not held sideways more stiffly than k_c
/// either. The handle feels the spring, whose stiffness in series with the scene's never exceeds
/// k_c, whatever the scene. Where the handle touches nothing the proxy is the handle, and nothing
/// is felt.
///
/// Accuracy  the balance holds within 0.1 mN along and 1 mN across the force, or as near as the
///           scene's most_queries allow.
/// Threads   Realtime.
/// Cost      up to scene.most_queries() + 2 calls of force_at in a tick, usually 5 to 8.
class Coupling {
 public:
  explicit Coupling(const CouplingOptions& options) noexcept : options_(options) {}

  /// One tick. `most_stiffness_n_per_m` is the governor's; > 0, may be infinite.
  CoupledForce tick(const ForceScene& scene, const HandleState& handle,
                    double most_stiffness_n_per_m, double period_s) noexcept;

  /// Forgets the proxy: after a fault or a jump of the handle.
  void reset() noexcept { touches_ = false; }

  const CouplingOptions& options() const noexcept { return options_; }

 private:
  struct Line;
  struct Bracket {
    double low;     ///< a way where the scene pushes more than the spring pulls
    double low_n;   ///< by so much
    double high;    ///< and one where it pushes less
    double high_n;  ///< by so much, negative
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
  double way_mm_ = 0.0;  ///< from the handle to the proxy along direction_
};

}  // namespace argil::haptics
