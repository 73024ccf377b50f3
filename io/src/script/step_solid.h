// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>

#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/engine/alpha_image.h"
#include "argil/engine/operation.h"
#include "argil/engine/tool_mesh.h"
#include "argil/io/solid_file.h"
#include "argil/io/stroke_script.h"

namespace argil::io {

/// The mesh or the image of a tool, or the mesh or clay of a combination or a new piece: what a
/// step works with and its line only names.
using Solid = std::variant<std::shared_ptr<const TriangleMesh>, std::shared_ptr<const Clay>,
                           std::shared_ptr<const AlphaImage>>;

/// How a line names it.
struct SolidName {
  std::string file;  ///< seen from the folder of the script
  std::string hash;  ///< of the content, 16 hexadecimal digits; empty: whatever the file holds
};

/// Nothing for a step that needs none.
std::optional<Solid> solid_of(const ScriptStep& step);

/// A name for its content: `front`, the hash, and the ending of the format that holds it bit for
/// bit.
SolidName name_of(const Solid& solid, const std::string& front);

/// Writes a clay as a project, a mesh as binary PLY of 64-bit coordinates, an image as PNG.
/// Errors  disk; memory; bad_input for more vertices or triangles than PLY can count.
Result<void> save_solid(const std::filesystem::path& file, const Solid& solid);

/// Reads what the lines of a script name, each file once.
///
/// With a hash, the file must hold just that and is taken as it is. Without, the mesh of a
/// combination or a piece is closed first, as `argil import` does.
/// Errors  bad_input: not there, not readable as what it is, another content than the hash says;
///         of a tool's mesh also when it is open. disk, memory: what is there could not be read.
class SolidReader {
 public:
  explicit SolidReader(std::filesystem::path folder) : folder_(std::move(folder)) {}

  Result<std::shared_ptr<const ToolMesh>> tool_mesh(const SolidName& name);
  Result<std::shared_ptr<const AlphaImage>> alpha(const SolidName& name);
  /// A clay or a mesh.
  Result<Operand> operand(const SolidName& name);

  /// Every file that was named and read.
  const std::set<std::string>& files() const noexcept { return files_; }

 private:
  using Key = std::pair<std::string, std::string>;
  Result<std::filesystem::path> path_of(const SolidName& name) const;

  std::filesystem::path folder_;
  std::map<Key, std::shared_ptr<const ToolMesh>> tools_;
  std::map<Key, std::shared_ptr<const AlphaImage>> alphas_;
  std::map<Key, Operand> operands_;
  std::set<std::string> files_;
};

}  // namespace argil::io
