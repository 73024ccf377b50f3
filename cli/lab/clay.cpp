// SPDX-License-Identifier: GPL-3.0-or-later
// The clay of a lab scene. What was carved is the difference of two volumes of its surface.
#include "lab/clay.h"

#include <utility>

#include "argil/engine/surface.h"

#include "common/output.h"

namespace argil::cli::lab {

LabClay::LabClay(Clay clay, const ClayWorkerOptions& worker, const haptics::ClaySceneOptions& scene)
    : clay_(std::move(clay)),
      volume_before_mm3_(signed_volume(extract_surface(clay_))),
      served_(clay_, worker, scene) {}

Json LabClay::report() const {
  Json json = served_.report();
  json["carved_mm3"] = volume_before_mm3_ - signed_volume(extract_surface(clay_));
  json["hash"] = hex(clay_.hash());
  return json;
}

}  // namespace argil::cli::lab
