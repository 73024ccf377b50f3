// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/surface_detail.h"
#include "argil/core/vec3.h"

namespace argil::haptics {

struct TextureOptions {
  /// Force for a bump of a mm; usual 1, >= 0. Much more and every bump is felt at the bound.
  double n_per_mm = 1.0;
  /// Bound of the vibration, N; usual 0.1, 0 to 1. More shakes the handle off the surface.
  double most_n = 0.1;
  /// How far the tool may move to and fro before it slides, mm; usual 0.1, >= 0: as
  /// VibroOptions::play_mm.
  double play_mm = 0.1;
  /// What is slower than this many seconds is not vibration; usual 0.05, > 0: below 3 Hz. A hand
  /// that rests feels nothing of the texture after it.
  double slow_s = 0.05;
  /// What is faster than this many seconds is taken off; usual 0.001, > 0: above 160 Hz, where a
  /// sampled force would alias.
  double fast_s = 0.001;
};

/// Detail of the clay that is too fine for the force, as a vibration of a tool that slides over it:
/// the height of SurfaceDetail under the tool, through a band of frequencies, in N along the
/// surface's normal, out of the clay for a bump.
///
/// Bounded: never more than most_n, nor than the push that it comes on top of (`added_to`), so that
/// it neither pulls nor begins with a step; a path of the handle along the normal of s mm can gain
/// at most most_n * s. It only changes while the tool slides, and fades within some slow_s when it
/// rests, when the tool leaves the patch (over its last three nodes), or touches nothing.
///
/// Threads  Realtime: noexcept, no allocation, lock or system call.
/// Source   section 3.6.4, "hybrid feedback", of the Falcon report (docs/equations.md).
class SurfaceTexture {
 public:
  explicit SurfaceTexture(const TextureOptions& options = {}) noexcept;

  /// Once a tick: the newest detail, where the tool is, mm in its frame, whether it touches the
  /// clay, and the time since the last tick, >= 0.
  void tick(const SurfaceDetail& detail, const Vec3& place_mm, bool is_touching,
            double passed_s) noexcept;

  /// The motion from the last tick to the next one means nothing.
  void forget_motion() noexcept { is_sliding_ = false; }

  /// A push with the vibration on it, along itself.
  Vec3 added_to(const Vec3& push_n) const noexcept;

  /// As it would be on a push that is strong enough.
  double force_n() const noexcept { return force_n_; }
  /// The strongest that it has been, whichever way; 0 where nothing was too fine for the force.
  double most_force_n() const noexcept { return most_force_n_; }

 private:
  TextureOptions options_;
  Vec3 dragged_mm_;  ///< follows the tool within the play
  bool is_sliding_ = false;
  double slow_mm_ = 0.0;  ///< mean of the height lately
  double band_mm_ = 0.0;
  double force_n_ = 0.0;
  double most_force_n_ = 0.0;
};

}  // namespace argil::haptics
