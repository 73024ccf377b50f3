// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <deque>
#include <memory>

#include "argil/core/window_channel.h"
#include "argil/engine/clay.h"
#include "argil/engine/clay_worker.h"
#include "argil/haptics/scene/scene_clay.h"
#include "argil/haptics/servo/servo_run.h"

#include "stability/late/exchange_meter.h"
#include "stability/late/late_case.h"

namespace argil::evaluation {

/// A real clay of 0.5 mm voxels with a flat top, or a hollow in it, that a ClayWorker works every
/// P and whose windows are held back for A before a ClayScene may read them. Its scene and itself,
/// as the observer, belong to one run.
///
/// Threads  one.
/// Cost     making 20 to 50 ms; a step some ms.
class LateBlock final : public EnergyScene, public haptics::ServoObserver {
 public:
  /// `surface_mm`: where the clay's top, the hollow's bottom, lies in the device's frame. Of the
  /// remedies all but at_once, which no servo has.
  /// Errors  as Clay::block and Clay::from_distance.
  static Result<std::unique_ptr<LateBlock>> make(const LateCase& what, double surface_mm);

  void begin_tick(const haptics::HandleState& handle) noexcept override;
  haptics::SceneForce force_at(const haptics::HandleState& handle) const noexcept override;
  void end_tick(const haptics::HandleState& tool) noexcept override;
  void forget_motion() noexcept override;
  int most_queries() const noexcept override { return scene_.most_queries(); }
  haptics::WindowStamp window_stamp() const noexcept override { return scene_.window_stamp(); }
  double energy_at(const haptics::HandleState& handle) const noexcept override;

  void after_tick(const haptics::ServoTick& tick) override;
  /// The first error of a step.
  const Result<void>& worked() const noexcept { return worked_; }

 private:
  struct Coming {
    double time_s;
    WindowSlot window;
  };
  LateBlock(Clay clay, const LateCase& what, const Vec3& offset_mm);

  Lateness late_;
  Clay clay_;
  ToolSampleRing ring_;
  WindowChannel made_;
  WindowChannel felt_;
  ClayWorker worker_;
  haptics::ClayScene scene_;
  std::deque<Coming> coming_;
  double next_s_ = 0.0;
  Result<void> worked_;
};

}  // namespace argil::evaluation
