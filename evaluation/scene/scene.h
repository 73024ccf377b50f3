// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "argil/core/result.h"
#include "argil/engine/clay.h"

#include "scene/distance.h"
#include "scene/random.h"

namespace argil::evaluation {

/// The finest voxel of every scene.
inline constexpr double kVoxelMm = 0.25;

/// A point on the surface.
struct SurfacePoint {
  Vec3 point_mm;
  Vec3 normal;  ///< outward, unit
};

/// A body as clay and as its exact distance.
struct Scene {
  std::shared_ptr<Clay> clay;  ///< worked only to be put back, as when windows are timed
  Distance distance;
  double probe_mm;  ///< step at which the direction of `distance` is taken; above 0
  /// A random point fit for a tool of this radius.
  std::function<SurfacePoint(Random&, double radius_mm)> point_for;
};

/// What panel of the chart a scene belongs to, and what limit holds for it.
enum class Group { smooth, sharp };

/// How one scene of the chart is made, for tools of one radius where it scales with them.
struct SceneRecipe {
  std::string name;
  Group group = Group::smooth;
  bool scales = false;  ///< with the tool's radius
  bool has_detail =
      false;  ///< finer than a tool: nodes of the reference lie at most two voxels apart
  std::function<Result<Scene>(double radius_mm)> make;
};

std::vector<SceneRecipe> formula_scenes();

/// The Stanford bunny, 80 mm. None where the model is not there: `missing` then says why.
std::optional<SceneRecipe> bunny_scene(std::string& missing);

}  // namespace argil::evaluation
