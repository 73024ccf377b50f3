// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene/scene_catalogue.h"

#include "argil/haptics/scene/scene_pebbles.h"
#include "argil/haptics/scene/scene_round.h"
#include "argil/haptics/scene/scene_sine.h"
#include "argil/haptics/scene/scene_slider.h"
#include "argil/haptics/scene/scene_spring.h"
#include "argil/haptics/scene/scene_wall.h"
#include "argil/haptics/scene/scene_workspace.h"

namespace argil::haptics {
namespace {

template <class Scene>
std::unique_ptr<ForceScene> make() {
  return std::make_unique<Scene>();
}

std::unique_ptr<ForceScene> make_free() {
  SpringOptions options;
  options.damping_n_s_per_m = 0.0;
  return std::make_unique<SpringScene>(options);
}

template <WallKind kind>
std::unique_ptr<ForceScene> make_wall() {
  WallOptions options;
  options.kind = kind;
  return std::make_unique<WallScene>(options);
}

template <SineDirection direction>
std::unique_ptr<ForceScene> make_sine() {
  SineOptions options;
  options.direction = direction;
  return std::make_unique<SineScene>(options);
}

using enum SineDirection;

constexpr SceneEntry kScenes[] = {
    {"spring", "a spring and damper about the middle (3.1)", {}, make<SpringScene>, 800.0},
    {"free",
     "the handle let go in a spring, and what that tells of it (3.2-3.5)",
     {},
     make_free,
     800.0},
    {"wall-rigid",
     "a constant 20 N below y = -20 mm (3.6)",
     {},
     make_wall<WallKind::rigid>,
     kRigidStiffnessNPerM},
    {"wall-linear", "a spring and damper there (3.7)", {}, make_wall<WallKind::linear>, 800.0},
    {"wall-nonlinear",
     "squares of depth and speed (3.8)",
     {},
     make_wall<WallKind::nonlinear>,
     1800.0},
    {"sphere", "a ball of 50 mm (3.9)", {0.0, 55.0, 0.0}, make<SphereScene>, 3000.0},
    {"cylinder",
     "a cylinder of 30 mm about z (3.10-3.14)",
     {0.0, 35.0, 0.0},
     make<CylinderScene>,
     3000.0},
    {"pebbles", "a wall of balls (3.15)", {}, make<PebblesScene>, 3000.0},
    {"sine-z", "a sine wall that pushes along z (3.17)", {}, make_sine<z_only>, 1400.0},
    {"sine-normal", "along its unit normal (3.22)", {}, make_sine<unit_normal>, 1400.0},
    {"sine-gradient",
     "along its gradient: no work on a closed path",
     {},
     make_sine<gradient>,
     1960.0},
    {"sine-table",
     "along normals of a table, bilinear (section 3.6.4)",
     {},
     make_sine<table_bilinear>,
     1400.0},
    {"sine-nearest", "the same, nearest", {}, make_sine<table_nearest>, 1400.0},
    {"slider", "grooves along x (3.23-3.27)", {0.0, 0.0, 50.0}, make<SliderScene>, 1500.0},
    {"click",
     "the slider with a hard ball in it (3.28)",
     {0.0, 0.0, 5.0},
     make<ClickScene>,
     9500.0},
    {"workspace",
     "nothing to feel: how far the handle reaches (section 3.1)",
     {},
     make<WorkspaceScene>,
     0.0},
};

}  // namespace

std::span<const SceneEntry> scene_catalogue() noexcept { return kScenes; }

const SceneEntry* find_scene(std::string_view name) noexcept {
  for (const SceneEntry& scene : kScenes) {
    if (scene.name == name) return &scene;
  }
  return nullptr;
}

}  // namespace argil::haptics
