// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/io/assembly.h"

#include "format/xml_scan.h"

namespace argil::io {

/// What a person should know of a file that was read: the first ten sentences, and how many more
/// there were.
class FileNotes {
 public:
  void add(std::string note);
  std::vector<std::string> take();

 private:
  static constexpr std::size_t kMost = 10;
  std::vector<std::string> notes_;
  std::size_t left_out_ = 0;
};

/// An object placed by a component or a build item, in the unit of the part that says so.
struct ItemPlacement {
  std::string part;  ///< of the archive; empty: the one it is written in
  std::int64_t object = 0;
  Affine transform;
};

struct ModelObject {
  std::string name;
  std::optional<Srgb> color;
  TriangleMesh mesh;  ///< in the unit of its part
  std::vector<ItemPlacement> components;
};

/// One model of a 3MF archive; most have one.
struct ModelPart {
  double unit_mm = 1.0;
  std::map<std::int64_t, ModelObject> objects;
  std::vector<ItemPlacement> build;
};

/// Reads a model part; `where` is what errors call it.
/// Errors  bad_input "WHERE:LINE: ...".
Result<ModelPart> read_model_part(XmlScan::TakePiece text, const std::string& where,
                                  FileNotes& notes);

}  // namespace argil::io
