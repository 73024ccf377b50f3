// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "argil/core/result.h"
#include "argil/engine/clay.h"

#include "chart/distance.h"
#include "chart/random.h"

namespace argil::cli::chart {

/// The finest voxel of every scene.
inline constexpr double kVoxelMm = 0.25;

/// A place on the surface.
struct Place {
  Vec3 point_mm;
  Vec3 normal;  ///< outward, unit
};

/// A body as clay and as its exact distance.
struct Scene {
  std::shared_ptr<const Clay> clay;
  Distance distance;
  double probe_mm;  ///< step at which the direction of `distance` is taken
  /// A place fit for a tool of this radius.
  std::function<Place(Random&, double radius_mm)> place;
};

/// What panel of the chart a scene belongs to, and what limit holds for it.
enum class Group { smooth, sharp };

/// One scene of the chart, made for tools of one radius where it scales with them.
struct SceneKind {
  std::string name;
  Group group = Group::smooth;
  bool scales = false;      ///< with the tool's radius
  bool has_detail = false;  ///< finer than a tool: the reference never skips two finest voxels
  std::function<Result<Scene>(double radius_mm)> make;
};

std::vector<SceneKind> formula_scenes();

/// The Stanford bunny, 80 mm. None where the model is not there: `missing` then says why.
std::optional<SceneKind> bunny_scene(std::string& missing);

}  // namespace argil::cli::chart
