// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

namespace argil::test {

/// The folder of the shared test models: $ARGIL_SHARED/models, or ../shared/models beside the
/// repository when the variable is not set.
std::filesystem::path shared_models();

/// The shared model of that file name ("spot.obj"), or nothing when it is not there.
std::optional<std::filesystem::path> find_model(const std::string& name);

/// What a test of that model is called: "stanford-bunny.obj" gives "stanford_bunny".
std::string name_of_model(const std::string& file);

/// Why a test is skipped when `find_model` finds nothing: names the file that was looked for.
std::string missing_model(const std::string& name);

}  // namespace argil::test

/// Declares `path` as the shared model `name`, or skips the test saying which file is missing.
#define ARGIL_MODEL_OR_SKIP(file, name)                                  \
  auto found_##file = ::argil::test::find_model(name);                   \
  if (!found_##file) GTEST_SKIP() << ::argil::test::missing_model(name); \
  const std::filesystem::path file = std::move(found_##file).value()
