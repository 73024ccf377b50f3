// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/models.h"

#include <algorithm>
#include <cstdlib>
#include <system_error>

#include "support/built.h"

namespace argil::test {

std::filesystem::path shared_models() {
  const char* given = std::getenv("ARGIL_SHARED");
  const std::filesystem::path shared =
      given != nullptr && *given != '\0'
          ? std::filesystem::path(given)
          : std::filesystem::path(source_folder()).parent_path() / "shared";
  return shared / "models";
}

std::optional<std::filesystem::path> find_model(const std::string& name) {
  std::filesystem::path file = shared_models() / name;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return std::nullopt;
  return file;
}

std::string name_of_model(const std::string& file) {
  std::string name = file.substr(0, file.find('.'));
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

std::string missing_model(const std::string& name) {
  return "shared model " + (shared_models() / name).string() +
         " not found; set ARGIL_SHARED to the folder that holds models/";
}

}  // namespace argil::test
