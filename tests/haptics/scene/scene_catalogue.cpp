// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene/scene_catalogue.h"

#include <algorithm>
#include <cmath>
#include <memory>
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
  EXPECT_EQ(names.size(), 18U);
  EXPECT_EQ(find_scene("clay"), nullptr);
  EXPECT_EQ(find_scene(""), nullptr);
}

TEST(SceneCatalogue, MakesScenesThatAreFeltSomewhereButNotWhereAHandBegins) {
  for (const SceneEntry& entry : scene_catalogue()) {
    const SceneValues values(entry.parameters);
    const std::unique_ptr<ForceScene> scene = entry.make(values);
    ASSERT_NE(scene, nullptr) << entry.name;
    EXPECT_EQ(scenes::force(*scene, entry.start_mm(values)), Vec3{}) << entry.name;
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

/// What `argil lab --list` says of each.
TEST(SceneCatalogue, NamesTheEquationOfEveryParameter) {
  for (const SceneEntry& entry : scene_catalogue()) {
    for (const SceneParameter& parameter : entry.parameters) {
      const std::string equation = parameter.equation;
      EXPECT_TRUE(equation.starts_with("(3.") || equation.starts_with("section 3."))
          << entry.name << ", " << parameter.name << ": '" << equation << "'";
    }
  }
}

/// The strongest force around a place of a scene.
double most_force_n(const ForceScene& scene, const Vec3& about) {
  double most = 0.0;
  for (int n = -40; n <= 40; ++n) {
    for (const Vec3& step : {Vec3{0.3, 1.0, 0.2}, Vec3{0.1, 0.4, 1.0}}) {
      most = std::max(most, length(scenes::force(scene, about + 1.0 * n * step)));
    }
  }
  return most;
}

/// With each parameter at its least and its most.
TEST(SceneCatalogue, TakesEachParameterAtItsEnds) {
  int changed = 0;
  for (const SceneEntry& entry : scene_catalogue()) {
    const SceneValues usual(entry.parameters);
    const Vec3 start = entry.start_mm(usual);
    const double usual_n = most_force_n(*entry.make(usual), start);
    for (const SceneParameter& parameter : entry.parameters) {
      bool is_felt = false;
      for (const double value : {parameter.low, parameter.high}) {
        SceneValues values(entry.parameters);
        ASSERT_TRUE(values.set(parameter.name, value).ok());
        const std::unique_ptr<ForceScene> scene = entry.make(values);
        EXPECT_EQ(scenes::force(*scene, entry.start_mm(values)), Vec3{})
            << entry.name << ", " << parameter.name << " = " << value;
        const double most_n = most_force_n(*scene, start);
        EXPECT_TRUE(std::isfinite(most_n)) << entry.name << ", " << parameter.name;
        EXPECT_GE(entry.most_stiffness_n_per_m(values), 0.0) << entry.name;
        is_felt = is_felt || most_n != usual_n;
      }
      changed += is_felt ? 1 : 0;
    }
  }
  EXPECT_GT(changed, 60);  // dampers are felt by a handle that moves
}

TEST(SceneValues, SayWhatCannotBeSet) {
  SceneValues values(find_scene("sphere")->parameters);
  EXPECT_EQ(values["R"], 50.0);
  ASSERT_TRUE(values.set("R", 30.0).ok());
  EXPECT_EQ(values["R"], 30.0);
  const auto wrong = values.set("R", 1000.0);
  ASSERT_FALSE(wrong.ok());
  EXPECT_EQ(wrong.error().message, "R is 1000 mm; must be from 5 to 100 mm");
  EXPECT_FALSE(values.set("R", std::nan("")).ok());
  const auto unknown = values.set("depth", 1.0);
  ASSERT_FALSE(unknown.ok());
  EXPECT_EQ(unknown.error().message,
            "the scene has no 'depth'; what can be set is R, k, c, x, y, z");
  EXPECT_EQ(values["R"], 30.0);
}

}  // namespace
}  // namespace argil::haptics
