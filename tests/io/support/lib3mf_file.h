// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "argil/core/vec3.h"

namespace argil::test {

/// A mesh object of a 3MF as the 3MF consortium's library sees it.
struct Lib3mfObject {
  std::string name;
  std::int64_t vertices = 0;
  std::int64_t triangles = 0;
  bool manifold = false;  ///< and oriented
  Box3 box_mm;            ///< by the unit that the file states
  std::string color;      ///< "#RRGGBB" of its base material; empty for none
};

struct Lib3mfFile {
  bool is_read = false;  ///< by every call; else the rest is what was read until then
  std::vector<Lib3mfObject> objects;
  std::map<std::string, std::string> metadata;
  int items = 0;       ///< of the build
  int components = 0;  ///< of all objects made of components
  bool moves = false;  ///< an item of the build has a transform
};
Lib3mfFile lib3mf_file(const std::filesystem::path& threemf);

/// Has the library read one file and write what it read as another; whether it could.
bool rewrite_by_lib3mf(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace argil::test
