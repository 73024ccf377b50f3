// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/haptics/scene.h"

namespace argil::haptics {

enum class WallKind {
  rigid,      ///< eq. 3.6: a constant force inside. A relay: it cycles with every hand (theory B.3)
  linear,     ///< eq. 3.7
  nonlinear,  ///< eq. 3.8
};

struct WallOptions {
  WallKind kind = WallKind::linear;
  double offset_mm = -20.0;     ///< solid for y < offset
  double rigid_n = 20.0;        ///< rigid; more than the device gives, so that it saturates
  double stiffness = 1000.0;    ///< k: N/m; of the nonlinear wall N/m^n, where 1e5 is usual; >= 0
  double damping = 5.0;         ///< c: N s/m; of the nonlinear wall N (s/m)^m; >= 0
  double depth_exponent = 2.0;  ///< n of eq. 3.8; >= 1
  double velocity_exponent = 2.0;  ///< m of eq. 3.8; >= 1
  bool is_one_sided = true;        ///< false: the damper pulls a handle that leaves, as printed
};

/// The walls of section 3.4.
class WallScene final : public ForceScene {
 public:
  explicit WallScene(const WallOptions& options) noexcept : options_(options) {}
  SceneForce force_at(const HandleState& place) const noexcept override;

 private:
  WallOptions options_;
};

}  // namespace argil::haptics
