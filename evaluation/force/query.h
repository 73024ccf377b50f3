// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "argil/core/result.h"
#include "argil/engine/window.h"
#include "argil/haptics/force/lattice_force.h"

#include "force/method.h"
#include "force/reference.h"
#include "force/stencil.h"
#include "scene/scene.h"

namespace argil::evaluation {

/// What one method answered.
struct Answer {
  Wrench wrench;
  int samples = 0;
  std::optional<double> error_n;  ///< what it says of its own error
};

/// A method made ready for one tool shape and material, so that asking costs what a tick costs.
class Query {
 public:
  Query(const Method& method, const haptics::ForceTool& tool,
        const haptics::ForceMaterial& material);

  Answer ask(const FieldWindowView& window, const haptics::ForceTool& pose) const;
  /// For stencils: on exact distances at the finest nodes.
  Answer ask(const Distance& distance, const haptics::ForceTool& pose) const;

 private:
  Method method_;
  haptics::ForceMaterial material_;
  std::vector<StencilPoint> points_;
  std::optional<haptics::LatticeForce> lattice_;
};

/// How far around the centre the point force reads, in voxels: what its gradient needs.
inline constexpr double kPointBorder = 3.0;

/// The windows that one pose needs, each read once: from the clay as the servo gets them, or for
/// methods on the finest lattice from the exact distance.
class Windows {
 public:
  /// `margin_mm` is how far the tool may move about `tool`'s position.
  Windows(const Scene& scene, const haptics::ForceTool& tool,
          const haptics::ForceMaterial& material, double margin_mm)
      : scene_(scene), tool_(tool), material_(material), margin_mm_(margin_mm) {}

  /// None for stencils, which read the exact distance.
  Result<const FieldWindowView*> of(const Method& method);

 private:
  const Scene& scene_;
  haptics::ForceTool tool_;
  haptics::ForceMaterial material_;
  double margin_mm_;
  std::map<double, FieldWindow> lattices_;  ///< by spacing
  std::optional<FieldWindow> centre_;       ///< for the point force
  std::optional<FieldWindow> fine_;
};

/// Every node of the finest lattice that the tool's kernel can reach, with the exact distance.
FieldWindow finest_window(const Distance& distance, const haptics::ForceTool& tool,
                          double margin_mm);

}  // namespace argil::evaluation
