// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/haptics/scene.h"

namespace argil::haptics {

struct VibroOptions {
  double amplitude_n = 0.1;    ///< at contact forces from 1 N up, in proportion below; >= 0
  double wavelength_mm = 1.0;  ///< of the texture: at 50 mm/s a vibration of 50 Hz; > 0
};

/// The hybrid feedback of section 3.6.4: a fine texture as a small vibration along the contact
/// force of another scene. It is laid out along the way slid, so that it stands still when the
/// hand does.
class VibroScene final : public ForceScene {
 public:
  /// `scene` must outlive this.
  VibroScene(ForceScene& scene, const VibroOptions& options) noexcept
      : scene_(scene), options_(options) {}

  void begin_tick(const HandleState& handle) noexcept override;
  SceneForce force_at(const HandleState& place) const noexcept override;
  void end_tick(const HandleState& tool) noexcept override { scene_.end_tick(tool); }
  int most_queries() const noexcept override { return scene_.most_queries(); }
  WindowStamp window_stamp() const noexcept override { return scene_.window_stamp(); }

 private:
  ForceScene& scene_;
  VibroOptions options_;
  Vec3 last_mm_;
  bool has_last_ = false;
  double slid_mm_ = 0.0;
};

}  // namespace argil::haptics
