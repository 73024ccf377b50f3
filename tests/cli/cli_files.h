// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

#include "argil/core/triangle_mesh.h"

namespace argil::test {

/// A mesh as the text of an OBJ file.
inline std::string obj_text(const TriangleMesh& mesh) {
  std::ostringstream text;
  text.precision(17);
  for (const Vec3& p : mesh.positions) text << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
  for (const Triangle& t : mesh.triangles) {
    text << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  }
  return text.str();
}

/// All of a file.
inline std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A script that starts from a ball of 8 mm and carves and adds a little.
inline const char* const kSmallScript =
    R"({"argil_strokes":1,"units":"mm","start":{"shape":"ball","radius_mm":8,"voxel_mm":0.25}}
{"tool":"carve","shape":"ball","radius_mm":2.5,"symmetry":"x","poses":[[0,3,-8,1],[0.1,3,-7,4]]}
{"tool":"add","shape":"ellipsoid","radii_mm":[2,3,4],"poses":[[0,0,0,8,0.9,0.1,0.2,0,0.8]]}
{"tool":"smooth","shape":"ball","radius_mm":3,"strength":0.5,"poses":[[0,0,0,8]]}
)";

}  // namespace argil::test
