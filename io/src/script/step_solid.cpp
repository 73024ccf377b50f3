// SPDX-License-Identifier: GPL-3.0-or-later
// What a step works with besides the clay, a mesh, an image or another clay, and the files that
// hold it under the name of its hash.
#include "script/step_solid.h"

#include <cassert>
#include <limits>
#include <span>
#include <system_error>

#include "argil/core/hash.h"
#include "argil/core/hash_text.h"
#include "argil/io/alpha_file.h"
#include "argil/io/mesh_file.h"
#include "argil/io/project_file.h"
#include "argil/io/safe_file.h"

#include "file/file_bytes.h"
#include "file/file_error.h"

namespace argil::io {
namespace {

namespace fs = std::filesystem;

std::optional<Solid> needed_by(const Stroke& stroke) {
  if (stroke.tool.alpha != nullptr) return Solid(stroke.tool.alpha);
  const auto& tool = stroke.tool.mesh;
  if (stroke.tool.shape != Shape::mesh || tool == nullptr) return std::nullopt;
  return Solid(std::shared_ptr<const TriangleMesh>(tool, &tool->mesh()));
}

std::optional<Solid> needed_by(HistoryStep) { return std::nullopt; }
std::optional<Solid> needed_by(MaskEdit) { return std::nullopt; }
std::optional<Solid> needed_by(const MaskFilter&) { return std::nullopt; }
std::optional<Solid> needed_by(const MaskOutline&) { return std::nullopt; }

/// Of a combination or a new piece.
template <class Of>
Solid clay_or_mesh(const Of& of) {
  if (of.clay != nullptr) return Solid(of.clay);
  return Solid(of.mesh);
}

std::optional<Solid> needed_by(const Operation& operation) {
  const auto* with = std::get_if<Combine>(&operation);
  if (with == nullptr) return std::nullopt;
  return clay_or_mesh(*with);
}

std::optional<Solid> needed_by(const PieceEdit& edit) {
  const auto* add = std::get_if<AddPiece>(&edit);
  if (add == nullptr) return std::nullopt;
  return clay_or_mesh(*add);
}

std::string mesh_hash(const TriangleMesh& mesh) {
  Hash64 hash;
  const std::uint64_t vertices = mesh.positions.size();
  hash.update(std::as_bytes(std::span(&vertices, 1)));
  hash.update(std::as_bytes(std::span(mesh.positions)));
  hash.update(std::as_bytes(std::span(mesh.triangles)));
  return hash_text(hash.digest());
}

/// write_mesh rounds to float: what a step did must be repeated with its own bits.
Result<void> save_mesh(const fs::path& file, const TriangleMesh& mesh) {
  constexpr std::size_t kMost = std::numeric_limits<std::int32_t>::max();  // PLY's int
  if (mesh.positions.size() > kMost || mesh.triangles.size() > kMost) {
    return file_error(ErrorKind::bad_input, file,
                      ": the mesh has more vertices or triangles than PLY can count; use a "
                      "simpler one");
  }
  return replace_file(file, [&](const fs::path& temporary) -> Result<void> {
    OutputFile out(temporary);
    std::string head = "ply\nformat binary_little_endian 1.0\nelement vertex ";
    head.append(std::to_string(mesh.positions.size()));
    head.append("\nproperty double x\nproperty double y\nproperty double z\nelement face ");
    head.append(std::to_string(mesh.triangles.size()));
    out.write(head.append("\nproperty list uchar int vertex_indices\nend_header\n"));
    // As they lie in memory (asserted below), which is little-endian.
    out.write(mesh.positions.data(), mesh.positions.size() * sizeof(Vec3));
    for (const Triangle& triangle : mesh.triangles) {
      constexpr std::uint8_t kCorners = 3;
      out.write(&kCorners, sizeof kCorners);
      out.write(triangle.data(), sizeof triangle);
    }
    return out.close();
  });
}
static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Triangle) == 3 * sizeof(std::uint32_t));

Result<void> check_hash(const fs::path& file, const SolidName& name, const std::string& hash) {
  if (name.hash.empty() || name.hash == hash) return {};
  std::string what = " holds ";
  what.append(hash).append(" and not ").append(name.hash);
  return file_error(ErrorKind::bad_input, file,
                    what.append(": it was changed; put the former file back"));
}

}  // namespace

std::optional<Solid> solid_of(const ScriptStep& step) {
  return std::visit([](const auto& chosen) { return needed_by(chosen); }, step);
}

SolidName name_of(const Solid& solid, const std::string& front) {
  assert(std::visit([](const auto& held) { return held != nullptr; }, solid));
  if (const auto* clay = std::get_if<std::shared_ptr<const Clay>>(&solid)) {
    const std::string hash = hash_text((*clay)->hash());
    return {front + hash + ".vdb", hash};
  }
  if (const auto* image = std::get_if<std::shared_ptr<const AlphaImage>>(&solid)) {
    const std::string hash = alpha_hash(**image);
    return {front + hash + ".png", hash};
  }
  const std::string hash = mesh_hash(*std::get<std::shared_ptr<const TriangleMesh>>(solid));
  return {front + hash + ".ply", hash};
}

Result<void> save_solid(const fs::path& file, const Solid& solid) {
  if (const auto* clay = std::get_if<std::shared_ptr<const Clay>>(&solid)) {
    return save_project(file, **clay);
  }
  if (const auto* image = std::get_if<std::shared_ptr<const AlphaImage>>(&solid)) {
    return write_alpha(file, **image);
  }
  return save_mesh(file, *std::get<std::shared_ptr<const TriangleMesh>>(solid));
}

Result<fs::path> SolidReader::path_of(const SolidName& name) const {
  fs::path path = folder_ / name.file;
  std::error_code error;
  if (fs::exists(path, error)) return path;
  return file_error(ErrorKind::bad_input, path, " is not there; put it back, or name another file");
}

Result<std::shared_ptr<const ToolMesh>> SolidReader::tool_mesh(const SolidName& name) {
  auto& known = tools_[{name.file, name.hash}];
  if (known != nullptr) return known;
  const auto path = path_of(name);
  if (!path) return path.error();
  const auto mesh = read_mesh(path.value());
  if (!mesh) return mesh.error();
  if (auto ok = check_hash(path.value(), name, mesh_hash(mesh.value())); !ok) return ok.error();
  auto made = ToolMesh::make(mesh.value());
  if (!made) return file_error(made.error().kind, path.value(), ": " + made.error().message);
  files_.insert(name.file);
  return known = std::move(made).value();
}

Result<std::shared_ptr<const AlphaImage>> SolidReader::alpha(const SolidName& name) {
  auto& known = alphas_[{name.file, name.hash}];
  if (known != nullptr) return known;
  const auto path = path_of(name);
  if (!path) return path.error();
  auto image = read_alpha(path.value());
  if (!image) return image.error();
  if (auto ok = check_hash(path.value(), name, alpha_hash(*image.value())); !ok) return ok.error();
  files_.insert(name.file);
  return known = std::move(image).value();
}

Result<Operand> SolidReader::operand(const SolidName& name) {
  const Key key{name.file, name.hash};
  if (const auto known = operands_.find(key); known != operands_.end()) return known->second;
  const auto path = path_of(name);
  if (!path) return path.error();
  const bool as_it_is = !name.hash.empty();
  auto read = read_operand(path.value(), as_it_is ? Closing::none : Closing::as_import);
  if (!read) return read.error();
  const std::string hash = name_of(clay_or_mesh(read.value()), "").hash;
  if (auto ok = check_hash(path.value(), name, hash); !ok) return ok.error();
  operands_.emplace(key, read.value());
  files_.insert(name.file);
  return read;
}

}  // namespace argil::io
