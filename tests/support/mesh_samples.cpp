// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/mesh_samples.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <ostream>
#include <utility>

#include "argil/io/mesh_file.h"

#include "mesh_format/mesh_read.h"
#include "support/bytes/mesh_bytes.h"
#include "support/bytes/zip_maker.h"
#include "support/scratch.h"
#include "support/shapes.h"

namespace argil::test {
namespace {

bool never(std::size_t) { return false; }

TriangleMesh tetrahedron() {
  return {{{0, 0, 0}, {12.5, 0, 0}, {0, 11.25, 0}, {0, 0, 10}},
          {},
          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

std::string written(const std::string& name) {
  const ScratchFolder folder;
  const Result<void> saved = io::write_mesh(folder / name, tetrahedron());
  return saved ? content_of(folder / name) : saved.error().message;
}

MeshSample obj_sample() {
  const std::string text =
      "# comment\r\nmtllib a.mtl\nv 0 0 0\nv 12.5 0 0 0.5 0.5 0.5\nv 0 \\\n11.25 0\nv 0 0 1e1\n"
      "vt 0.5 0.5\nvn 0 0 1\ng part\nf 1 3 2\nf 1/1 2/1 4/1\nf -3//1 -2//1 -1//1\nf 3/1/1 1/1/1 "
      "4/1/1\n";
  const std::size_t first_face_ends = text.find("f 1 3 2") + 7;
  // From there on: cut behind a face, behind a number that is whole by chance, or in a keyword.
  return {"obj", "cut.obj", text, io::parse_obj,
          [first_face_ends](std::size_t length) { return length >= first_face_ends; }};
}

MeshSample obj_utf16_sample(bool higher_first) {
  const MeshSample plain = obj_sample();
  const auto may_pass = plain.may_pass_cut;
  return {higher_first ? "obj_utf16_big" : "obj_utf16_little", "cut.obj",
          utf16(plain.bytes, higher_first), io::parse_obj,
          [may_pass](std::size_t length) { return length >= 2 && may_pass((length - 2) / 2); }};
}

MeshSample stl_ascii_sample() {
  std::string text = "solid piece\n";
  const TriangleMesh mesh = tetrahedron();
  for (const Triangle& t : mesh.triangles) {
    text += " facet normal 0 0 0\n  outer loop\n";
    for (const std::uint32_t v : t) {
      const Vec3& p = mesh.positions[v];
      text += "   vertex " + std::to_string(p.x) + " " + std::to_string(p.y) + " " +
              std::to_string(p.z) + "\n";
    }
    text += "  endloop\n endfacet\n";
  }
  text += "endsolid piece\n";
  const std::size_t complete = text.find("endsolid") + 8;
  return {"stl_ascii", "cut.stl", text, io::parse_stl,
          [complete](std::size_t length) { return length >= complete; }};
}

MeshSample ply_ascii_sample() {
  const std::string text =
      "ply\nformat ascii 1.0\ncomment c\nelement vertex 4\nproperty double x\nproperty double y\n"
      "property double z\nproperty uchar red\nelement face 4\nproperty uchar flags\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0 1\n12.5 0 0 2\n0 11.25 0 3\n"
      "0 0 10 4\n0 3 0 2 1\n0 3 0 1 3\n0 3 1 2 3\n0 3 2 0 3\n";
  const std::size_t last_number = text.size() - 1;  // only the newline is missing
  return {"ply_ascii", "cut.ply", text, io::parse_ply,
          [last_number](std::size_t length) { return length >= last_number; }};
}

template <class T>
void append_big(std::string& bytes, T value) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), &value, sizeof value);
  std::reverse(raw.begin(), raw.end());
  bytes.append(raw.data(), raw.size());
}

MeshSample ply_big_sample() {
  std::string bytes =
      "ply\nformat binary_big_endian 1.0\nelement camera 1\nproperty list ushort float lens\n"
      "element vertex 4\nproperty float x\nproperty short tag\nproperty float y\nproperty float z\n"
      "element face 4\nproperty list int16 uint32 vertex_index\nend_header\n";
  append_big(bytes, std::uint16_t{2});
  append_big(bytes, 1.0F);
  append_big(bytes, 2.0F);
  const TriangleMesh mesh = tetrahedron();
  for (const Vec3& p : mesh.positions) {
    append_big(bytes, static_cast<float>(p.x));
    append_big(bytes, std::int16_t{-1});
    append_big(bytes, static_cast<float>(p.y));
    append_big(bytes, static_cast<float>(p.z));
  }
  for (const Triangle& t : mesh.triangles) {
    append_big(bytes, std::int16_t{3});
    for (const std::uint32_t v : t) append_big(bytes, v);
  }
  return {"ply_big", "cut.ply", bytes, io::parse_ply, never};
}

/// Strips, lists in every element, and what programs write into headers.
MeshSample ply_strips_sample() {
  std::string bytes =
      "ply\r\nCreated by a program\r\nformat binary_little_endian 1.0\r\nobj_info a b\r\n"
      "comment c\r\nelement vertex 4\r\nproperty list uint8 int8 tags\r\nproperty float32 x\r\n"
      "property float64 y\r\ncomment d\r\nproperty float z\r\nelement edge 1\r\n"
      "property list ushort double weights\r\nproperty int vertex1\r\nelement tristrips 1\r\n"
      "property list int int vertex_indices\r\nobj_info e\r\nend_header\r\n";
  for (const Vec3& p : tetrahedron().positions) {
    bytes += bytes_of(std::uint8_t{2}, 7, 8) + bytes_of(static_cast<float>(p.x)) + bytes_of(p.y) +
             bytes_of(static_cast<float>(p.z));
  }
  bytes += bytes_of(std::uint16_t{1}) + bytes_of(0.5) + bytes_of(std::int32_t{3});
  bytes += bytes_of(std::int32_t{12}, -1, 0, 2, 1, 3, -1, 1, 1, 1, 3, 0, 2);
  return {"ply_strips", "cut.ply", bytes, io::parse_ply, never};
}

/// A strip that follows a joint, in a buffer of its own text. In mm and y up, so that the numbers
/// are whole.
MeshSample gltf_sample() {
  std::string binary;
  for (const Vec3& p : tetrahedron().positions) {
    binary += bytes_of(static_cast<float>(p.x), static_cast<float>(p.z), static_cast<float>(-p.y));
  }
  for (int v = 0; v < 4; ++v) binary += bytes_of(std::uint8_t{0}, 0, 0, 0);
  for (int v = 0; v < 4; ++v) binary += bytes_of(1.0F, 0, 0, 0);
  binary += bytes_of(std::uint16_t{0}, 2, 1, 3, 0, 2);
  const std::string text =
      R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0,"skin":0,"children":[1]},{}],)"
      R"("skins":[{"joints":[1]}],"meshes":[{"primitives":[{"mode":5,"indices":3,)"
      R"("attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2}}]}],"accessors":[)"
      R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)"
      R"({"bufferView":1,"componentType":5121,"count":4,"type":"VEC4"},)"
      R"({"bufferView":2,"componentType":5126,"count":4,"type":"VEC4"},)"
      R"({"bufferView":3,"componentType":5123,"count":6,"type":"SCALAR"}],"bufferViews":[)"
      R"({"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":16},)"
      R"({"buffer":0,"byteOffset":64,"byteLength":64},)"
      R"({"buffer":0,"byteOffset":128,"byteLength":12}],)"
      R"("buffers":[{"byteLength":140,"uri":"data:application/octet-stream;base64,)" +
      base64(binary) + "\"}]}";
  const auto parse = [](std::span<const std::byte> bytes, const std::string& name) {
    return io::parse_gltf_in(bytes, name, {}, 1.0);
  };
  return {"gltf", "cut.gltf", text, parse, never};
}

Result<TriangleMesh> joined_3mf(std::span<const std::byte> bytes, const std::string& name) {
  io::StatedUnit unit;
  auto parsed = io::parse_3mf(bytes, name, unit);
  if (!parsed) return parsed.error();
  return io::joined(std::move(parsed.value().assembly));
}

/// A part and a modifier that a slicer merged into one mesh and names beside it, in a color, and
/// put in place by a component. Nothing is packed, so that every byte of the text is cut and
/// flipped.
MeshSample threemf_parts_sample() {
  std::string vertices;
  std::string triangles;
  for (std::uint32_t part = 0; part < 2; ++part) {
    for (const Vec3& p : tetrahedron().positions) {
      vertices += "<vertex x=\"" + std::to_string(p.x - 5.0) + "\" y=\"" + std::to_string(p.y) +
                  "\" z=\"" + std::to_string(p.z) + "\"/>";
    }
    for (const auto& [a, b, c] : tetrahedron().triangles) {
      const auto corner = [&](std::uint32_t v) { return std::to_string(v + 4 * part); };
      triangles += "<triangle v1=\"" + corner(a) + "\" v2=\"" + corner(b) + "\" v3=\"" + corner(c) +
                   "\" pid=\"1\" p1=\"1\"/>";
    }
  }
  const std::string model =
      R"(<model unit="millimeter"><resources><basematerials id="1"><base name="a" )"
      R"(displaycolor="#12"/><base name="b" displaycolor="#0A0b0C80"/></basematerials>)"
      R"(<object id="7" pid="1" pindex="0"><mesh><vertices>)" +
      vertices + "</vertices><triangles>" + triangles +
      R"(</triangles></mesh></object><object id="8" name="two"><components><component )"
      R"(objectid="7" transform="1 0 0 0 1 0 0 0 1 5 0 0"/></components></object></resources>)"
      R"(<build><item objectid="8"/></build></model>)";
  const std::string config =
      R"(<config><object id="7"><metadata key="name" value="a &amp; b"/><volume firstid="0" )"
      R"(lastid="3"><metadata key="name" value="a"/></volume><volume firstid="4" lastid="7">)"
      R"(<metadata key="volume_type" value="ParameterModifier"/></volume></object></config>)";
  return {"threemf_parts", "cut.3mf",
          zip_of({relations(), stored("3D/a.model", model),
                  stored("Metadata/Slic3r_PE_model.config", config)}),
          joined_3mf, never};
}

}  // namespace

std::vector<MeshSample> mesh_samples() {
  return {obj_sample(),
          obj_utf16_sample(true),
          obj_utf16_sample(false),
          ply_strips_sample(),
          gltf_sample(),
          stl_ascii_sample(),
          ply_ascii_sample(),
          ply_big_sample(),
          {"stl_binary", "cut.stl", written("a.stl"), io::parse_stl, never},
          {"ply_little", "cut.ply", written("a.ply"), io::parse_ply, never},
          {"glb", "cut.glb", written("a.glb"), io::parse_glb, never},
          {"threemf", "cut.3mf", written("a.3mf"), joined_3mf, never},
          threemf_parts_sample()};
}

std::ostream& operator<<(std::ostream& out, const MeshSample& sample) { return out << sample.id; }

}  // namespace argil::test
