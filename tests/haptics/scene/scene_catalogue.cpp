// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene/scene_catalogue.h"

#include <set>
#include <string>

#include <gtest/gtest.h>

#include "haptics/scene/scene_checks.h"

namespace argil::haptics {
namespace {

TEST(SceneCatalogue, FindsEachByItsOwnName) {
  std::set<std::string> names;
  for (const SceneEntry& scene : scene_catalogue()) {
    EXPECT_EQ(find_scene(scene.name), &scene);
    EXPECT_TRUE(names.insert(scene.name).second) << scene.name;
    EXPECT_STRNE(scene.about, "") << scene.name;
  }
  EXPECT_EQ(names.size(), 16U);
  EXPECT_EQ(find_scene("clay"), nullptr);
  EXPECT_EQ(find_scene(""), nullptr);
}

TEST(SceneCatalogue, MakesScenesThatAreFeltSomewhereButNotWhereAHandBegins) {
  for (const SceneEntry& entry : scene_catalogue()) {
    const std::unique_ptr<ForceScene> scene = entry.make();
    ASSERT_NE(scene, nullptr) << entry.name;
    EXPECT_EQ(scenes::force(*scene, entry.start_mm), Vec3{}) << entry.name;
    double most = 0.0;
    for (int n = 0; n < 70; ++n) {
      const Vec3 below{7.0, -1.0 * n, -1.0 * n};
      const Vec3 above{7.0, 20.0 - n, 40.0 - n};
      most = std::max(most, length(scenes::force(*scene, below)));
      most = std::max(most, length(scenes::force(*scene, above)));
    }
    if (std::string(entry.name) != "workspace") {
      EXPECT_GT(most, 1.0) << entry.name;
    }
  }
}

}  // namespace
}  // namespace argil::haptics
