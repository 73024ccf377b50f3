// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/haptics/scene/scene.h"
#include "argil/haptics/scene/sine_network.h"

namespace argil::haptics {

struct SineNetworkOptions {
  /// Height of the middle of the waves; usual -20.
  double offset_mm = -20.0;
  /// f, along x and y; usual 20 (waves 50 mm long and 5 mm high), 5 to 200. The height is always a
  /// tenth of the length.
  double frequency_per_m = 20.0;
  /// k; usual 1000, >= 0.
  double stiffness_n_per_m = 1000.0;
  /// c; usual 0, 0 to 20; more buzzes.
  double damping_n_s_per_m = 0.0;
};

/// A wall below waves, felt through a network of sines (SineNetwork): a spring of the distance to
/// the nearest point of the surface, towards it.
///
/// F = -(k d + c dd/dt) grad d below the surface, d < 0, with the network's own gradient, and never
/// pulling. Without a damper it is minus the gradient of k / 2 d^2 of the distance that the network
/// answers, so that it does no work on a closed path, however wrong that distance is.
///
/// Threads  as ForceScene.
/// Source   section 3.6.4 of the Falcon report (docs/equations.md).
class SineNetworkScene final : public ForceScene {
 public:
  explicit SineNetworkScene(const SineNetworkOptions& options = {});

  SceneForce force_at(const HandleState& handle) const noexcept override;

 private:
  SineNetworkOptions options_;
  SineNetwork network_;
};

}  // namespace argil::haptics
