// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/result.h"
#include "argil/engine/clay.h"

#include "common/served_clay.h"

namespace argil::cli::lab {

/// A clay in the lab's loop, and what became of it.
class LabClay {
 public:
  /// As ServedClay.
  LabClay(Clay clay, const ClayWorkerOptions& worker, const haptics::ClaySceneOptions& scene);

  ServedClay& served() noexcept { return served_; }
  const Clay& clay() const noexcept { return clay_; }

  /// That of ServedClay, "carved_mm3" and "hash".
  Json report() const;

 private:
  Clay clay_;
  double volume_before_mm3_;
  ServedClay served_;
};

}  // namespace argil::cli::lab
