// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>

#include "argil/core/result.h"
#include "argil/engine/clay.h"
#include "argil/haptics/scene/scene_clay.h"
#include "argil/haptics/servo/servo_run.h"

#include "common/served_clay.h"

namespace argil::evaluation {

/// The finest voxel of the clay.
inline constexpr double kFlatVoxelMm = 0.5;

/// What is felt of the clay, and where it lies.
struct FlatClayOptions {
  double radius_mm = 1.0;  ///< of the ball that is the tool; above 0
  haptics::ForceMaterial material;
  /// How the plane leans: the angle of its normal from the y axis, about z and then about x. 0: the
  /// cells lie along the surface.
  double tilt_rad = 0.0;
  /// How often a resting tool gets a window. The program's 0.03 s; a hold does not need the same
  /// window so often.
  double refresh_s = 0.03;
  /// How far the tool may slide along x, mm: how long the clay is.
  double path_mm = 20.0;
};

/// Flat clay whose surface goes through the device's middle, as the program serves it: a worker
/// that is stepped every 10 ms of the servo's clock carves and publishes windows, a ClayScene feels
/// them. Its scene and itself, as the observer, belong to one run.
///
/// Threads  one.
/// Cost     making 10 to 30 ms; a window 10 to 40 ms, a dab 1 to 3 ms.
class FlatClay final : public haptics::ServoObserver {
 public:
  /// Errors  as Clay::block and Clay::from_distance.
  static Result<std::unique_ptr<FlatClay>> make(const FlatClayOptions& options);

  haptics::ClayScene& scene() noexcept { return served_.scene(); }
  const ClayWorkerCounts& counts() const noexcept { return served_.counts(); }

  void after_tick(const haptics::ServoTick& tick) override;
  /// After a tick: the clay's step, when it is due.
  void step(double now_s);

  /// Of all ticks since the first window.
  std::uint32_t faults() const noexcept { return faults_; }
  /// The first error of a step.
  const Result<void>& worked() const noexcept { return worked_; }

 private:
  FlatClay(Clay clay, const FlatClayOptions& options, const Vec3& offset_mm);

  Clay clay_;
  cli::ServedClay served_;
  Result<void> worked_;
  std::uint32_t faults_ = 0;
};

/// The unit normal, out of the surface, of clay that leans so.
Vec3 leaning_normal(double tilt_rad);

}  // namespace argil::evaluation
