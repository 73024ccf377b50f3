// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/mesh_samples.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <ostream>

#include "argil/io/mesh_file.h"

#include "format/mesh_read.h"
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

}  // namespace

std::vector<MeshSample> mesh_samples() {
  return {obj_sample(),
          stl_ascii_sample(),
          ply_ascii_sample(),
          ply_big_sample(),
          {"stl_binary", "cut.stl", written("a.stl"), io::parse_stl, never},
          {"ply_little", "cut.ply", written("a.ply"), io::parse_ply, never},
          {"glb", "cut.glb", written("a.glb"), io::parse_glb, never},
          {"threemf", "cut.3mf", written("a.3mf"), io::parse_3mf, never}};
}

std::ostream& operator<<(std::ostream& out, const MeshSample& sample) { return out << sample.id; }

}  // namespace argil::test
