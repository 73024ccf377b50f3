// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "argil/core/result.h"

#include "format/xml_scan.h"

namespace argil::io {

struct SlicerPart {
  std::string name;
  bool is_printed = true;  ///< not a modifier, a blocker or what is cut away
  std::int64_t first_triangle = 0;
  std::int64_t last_triangle = -1;  ///< itself in the part
};

/// An object as a slicer knows it.
struct SlicerObject {
  std::string name;
  std::vector<SlicerPart> ranges;                 ///< of the triangles of its mesh (PrusaSlicer)
  std::map<std::int64_t, SlicerPart> components;  ///< by the object that each places (Bambu Studio)
};

/// By the object's number in the model.
using SlicerObjects = std::map<std::int64_t, SlicerObject>;

/// Reads what a slicer says of the objects of a 3MF in a file beside the model:
/// Metadata/Slic3r_PE_model.config or Metadata/model_settings.config.
/// Errors  bad_input "line N: what is wrong"; at most a million parts.
Result<SlicerObjects> read_slicer_objects(XmlScan::TakePiece text);

/// Whether an object's ranges are all of its triangles, each in one of them.
bool covers_triangles(const SlicerObject& object, std::size_t triangles);

}  // namespace argil::io
