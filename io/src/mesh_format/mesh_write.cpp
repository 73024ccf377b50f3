// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_format/mesh_write.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "argil/io/assembly.h"
#include "argil/mesh/bodies.h"
#include "argil/mesh/rounding.h"

#include "mesh_format/3mf_write.h"
#include "mesh_format/chunks.h"

namespace argil::io {
namespace {

/// The whole as one object without a name, or an object for each part and one that holds them.
Result<void> write_threemf(OutputFile& out, const TriangleMesh& mesh_mm,
                           const WriteOptions& options, const Progress& progress) {
  ThreemfModel model{options.title, options.metadata, {}, nullptr};
  std::vector<TriangleMesh> parts;
  if (!options.parts.empty()) parts = mesh::split_mesh(mesh_mm, options.parts);
  AssemblyItem item;
  if (options.parts.empty()) {
    model.objects.push_back({"", {}, &mesh_mm});
  } else {
    item.name = options.title;
  }
  for (const TriangleMesh& part : parts) {
    const std::string number = std::to_string(model.objects.size() + 1);
    model.objects.push_back({options.title + " " + number, {}, &part});
  }
  for (std::size_t o = 0; o < model.objects.size(); ++o) item.placements.push_back({o, {}});
  const std::vector<AssemblyItem> items{std::move(item)};
  model.items = &items;
  return write_3mf(out, model, progress);
}

char lower(char c) noexcept { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

}  // namespace

Result<MeshFormat> mesh_format_of(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), lower);
  if (ending == ".obj") return MeshFormat::obj;
  if (ending == ".stl") return MeshFormat::stl;
  if (ending == ".ply") return MeshFormat::ply;
  if (ending == ".glb") return MeshFormat::glb;
  if (ending == ".3mf") return MeshFormat::threemf;
  return Error{ErrorKind::bad_input, file.string() + ": the ending '" + ending +
                                         "' is not a mesh format known here; use .obj, .stl, .ply, "
                                         ".glb or .3mf, or .gltf to read"};
}

Result<void> check_holds_parts(const std::filesystem::path& file) {
  const Result<MeshFormat> format = mesh_format_of(file);
  if (!format) return format.error();
  if (format.value() == MeshFormat::threemf) return {};
  return Error{ErrorKind::bad_input, file.string() +
                                         ": the format has no place for parts of a name; write a "
                                         ".3mf, or one mesh"};
}

Result<void> check_writable(const TriangleMesh& mesh) {
  constexpr std::size_t kMost = std::numeric_limits<std::int32_t>::max();  // PLY's int
  if (mesh.triangles.empty())
    return Error{ErrorKind::bad_input, "the mesh has no triangles to write"};
  if (mesh.triangles.size() > kMost || mesh.positions.size() > kMost) {
    return Error{ErrorKind::bad_input, "the mesh has more than 2147483647 triangles; split it"};
  }
  for (const Vec3& p : mesh.positions) {
    const auto [x, y, z] = mesh::floats_of(p);
    // After rounding: a double beyond 3.4e38 becomes infinite as a float.
    if (!is_finite({double{x}, double{y}, double{z}})) {
      return Error{ErrorKind::bad_input,
                   "a coordinate is beyond what a float can hold (3.4e38); scale the mesh down"};
    }
  }
  for (const Triangle& t : mesh.triangles) {
    if (std::max({t[0], t[1], t[2]}) >= mesh.positions.size()) {
      return Error{ErrorKind::bad_input, "a triangle names a vertex the mesh does not have"};
    }
  }
  return {};
}

Result<void> check_size(MeshFormat format, const TriangleMesh& mesh_mm, const Progress& progress) {
  if (format != MeshFormat::threemf) return {};
  const std::vector<AssemblyItem> items{{"", {{0, {}}}}};
  return check_3mf_size({"", {}, {{"", {}, &mesh_mm}}, &items}, progress);
}

Result<void> write_format(OutputFile& out, MeshFormat format, const TriangleMesh& mesh_mm,
                          const WriteOptions& options, const Progress& progress) {
  if (Result<void> fits = check_writable(mesh_mm); !fits) return fits;
  if (!options.colors.empty() && options.colors.size() != mesh_mm.positions.size()) {
    return Error{ErrorKind::bad_input, std::to_string(options.colors.size()) + " colors for " +
                                           std::to_string(mesh_mm.positions.size()) +
                                           " vertices; give one each, or none"};
  }
  if (!options.parts.empty() && options.parts.size() != mesh_mm.triangles.size()) {
    return Error{ErrorKind::bad_input, std::to_string(options.parts.size()) + " parts for " +
                                           std::to_string(mesh_mm.triangles.size()) +
                                           " triangles; give one each, or none"};
  }
  Chunks chunks([&](std::string_view data) { out.write(data); }, progress,
                mesh_mm.positions.size() + mesh_mm.triangles.size());
  Result<void> written;
  switch (format) {  // without a default, so that the compiler asks for a new one
    case MeshFormat::threemf:
      return write_threemf(out, mesh_mm, options, progress);
    case MeshFormat::obj:
      written = write_obj(chunks, mesh_mm);
      break;
    case MeshFormat::stl:
      written = write_stl(chunks, mesh_mm);
      break;
    case MeshFormat::ply:
      written = write_ply(chunks, mesh_mm, options);
      break;
    case MeshFormat::glb:
      written = write_glb(chunks, mesh_mm, options);
      break;
  }
  chunks.flush();
  return written;
}

}  // namespace argil::io
