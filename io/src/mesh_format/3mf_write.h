// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
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

/// The model's text is one entry of an archive, which holds no more: less than 4 GB.
inline constexpr std::uint64_t kMost3mfText = 0xffffffff;

/// Whether the text of the model is less than `most` bytes.
///
/// Errors   bad_input naming what it takes; interrupted.
/// Cost     none up to 22 million vertices; beyond, the text is made once more each time this is
/// asked.
Result<void> check_3mf_size(const ThreemfModel& model, const Progress& progress,
                            std::uint64_t most = kMost3mfText);

/// As the writers of chunks.h. The text is made once: a model of `most` bytes of it or more is
/// refused where it comes to that many, with a part in `out` (check_3mf_size knows before).
Result<void> write_3mf(OutputFile& out, const ThreemfModel& model, const Progress& progress,
                       std::uint64_t most = kMost3mfText);

}  // namespace argil::io
