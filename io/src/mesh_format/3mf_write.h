// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/io/assembly.h"

#include "file/file_bytes.h"

namespace argil::io {

/// An object to write; its mesh stays where it is.
struct ThreemfObject {
  std::string name;  ///< empty: none
  std::optional<Srgb> color;
  const TriangleMesh* mesh = nullptr;
};

/// What a 3MF is to hold, in mm.
struct ThreemfModel {
  std::string title;
  std::vector<std::pair<std::string, std::string>> metadata;
  std::vector<ThreemfObject> objects;
  const std::vector<AssemblyItem>* items = nullptr;  ///< of these objects
};

/// As the writers of chunks.h.
Result<void> write_3mf(OutputFile& out, const ThreemfModel& model, const Progress& progress);

}  // namespace argil::io
