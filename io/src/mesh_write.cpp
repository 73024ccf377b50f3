// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_write.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <functional>
#include <limits>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "mesh_bodies.h"
#include "zip_write.h"

namespace argil::io {
namespace {

using Sink = std::function<void(std::string_view)>;

/// Gathers small pieces of text or bytes and hands them on in large ones, asking now and then
/// whether to go on.
class Chunks {
 public:
  Chunks(Sink sink, const Progress& progress, std::size_t steps)
      : sink_(std::move(sink)), progress_(progress), steps_(steps) {
    buffer_.reserve(kChunk + kLongestStep);
  }

  Chunks& text(std::string_view piece) {
    buffer_.append(piece);
    return *this;
  }
  template <class Number>
  Chunks& number(Number value) {
    std::array<char, 32> digits;
    const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
    buffer_.append(digits.data(), end);
    return *this;
  }
  template <class T>
  Chunks& raw(const T& value) {
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), &value, sizeof value);
    buffer_.append(bytes.data(), bytes.size());
    return *this;
  }

  /// After each vertex or triangle. False when the writing shall stop.
  bool step() {
    ++done_;
    if (buffer_.size() < kChunk) return !stopped_;
    flush();
    stopped_ = progress_ && !progress_("write", static_cast<double>(done_) /
                                                    static_cast<double>(std::max(steps_, done_)));
    return !stopped_;
  }
  void flush() {
    sink_(buffer_);
    buffer_.clear();
  }

 private:
  static constexpr std::size_t kChunk = std::size_t{1} << 18;
  static constexpr std::size_t kLongestStep = 512;
  Sink sink_;
  const Progress& progress_;
  std::size_t steps_;
  std::size_t done_ = 0;
  bool stopped_ = false;
  std::string buffer_;
};

/// Not inline: g++ 12.2 -O3 forgets the rounding where the floats become doubles again
/// (MeshRepair.LeavesTheBytesOfUntouchedTriangles).
[[gnu::noinline]] std::array<float, 3> floats(const Vec3& p) noexcept {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

Error stopped() { return {ErrorKind::interrupted, "interrupted while writing a mesh"}; }

/// Calls `one` for every item, stopping when the reader of the progress asks for it.
template <class Items, class One>
Result<void> write_each(Chunks& chunks, const Items& items, const One& one) {
  for (const auto& item : items) {
    one(item);
    if (!chunks.step()) return stopped();
  }
  return {};
}

Result<void> write_obj(Chunks& chunks, const TriangleMesh& mesh) {
  chunks.text("# Argil, unit millimetre\n");
  Result<void> written = write_each(chunks, mesh.positions, [&](const Vec3& p) {
    const auto [x, y, z] = floats(p);
    chunks.text("v ").number(x).text(" ").number(y).text(" ").number(z).text("\n");
  });
  if (!written) return written;
  return write_each(chunks, mesh.triangles, [&](const Triangle& t) {
    chunks.text("f ").number(t[0] + 1ULL).text(" ").number(t[1] + 1ULL).text(" ");
    chunks.number(t[2] + 1ULL).text("\n");
  });
}

Result<void> write_ply(Chunks& chunks, const TriangleMesh& mesh, const WriteOptions& options) {
  const bool has_colors = !options.colors.empty();
  const Vec3* const first = mesh.positions.data();
  chunks.text("ply\nformat binary_little_endian 1.0\ncomment Argil, unit millimetre\n");
  chunks.text("element vertex ").number(mesh.positions.size());
  chunks.text("\nproperty float x\nproperty float y\nproperty float z\n");
  if (has_colors) {
    chunks.text("property uchar red\nproperty uchar green\nproperty uchar blue\n");
  }
  chunks.text("element face ");
  chunks.number(mesh.triangles.size());
  chunks.text("\nproperty list uchar int vertex_indices\nend_header\n");
  Result<void> written = write_each(chunks, mesh.positions, [&](const Vec3& p) {
    chunks.raw(floats(p));
    if (has_colors) chunks.raw(options.colors[static_cast<std::size_t>(&p - first)]);
  });
  if (!written) return written;
  return write_each(chunks, mesh.triangles,
                    [&](const Triangle& t) { chunks.raw(std::uint8_t{3}).raw(t); });
}

Result<void> write_stl(Chunks& chunks, const TriangleMesh& mesh) {
  std::string header = "Argil binary STL, unit millimetre";  // never beginning with "solid"
  header.resize(80);
  chunks.text(header).raw(static_cast<std::uint32_t>(mesh.triangles.size()));
  return write_each(chunks, mesh.triangles, [&](const Triangle& t) {
    const std::array<std::array<float, 3>, 3> corners{
        floats(mesh.positions[t[0]]), floats(mesh.positions[t[1]]), floats(mesh.positions[t[2]])};
    std::array<Vec3, 3> p;
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = {double{corners[i][0]}, double{corners[i][1]}, double{corners[i][2]}};
    }
    chunks.raw(floats(normalized(cross(p[1] - p[0], p[2] - p[0])))).raw(corners);
    chunks.raw(std::uint16_t{0});
  });
}

/// One number of a box's corner as JSON, exactly.
std::string corner_text(const Vec3& corner) {
  std::string text = "[";
  for (std::size_t a = 0; a < 3; ++a) {
    std::array<char, 32> digits;
    const double value = double{static_cast<float>(corner[a])};
    const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
    text.append(a == 0 ? "" : ",").append(digits.data(), end);
  }
  return text + "]";
}

/// Vertices stay in mm with z up, bit for bit; a node brings them to glTF's metres and y up.
std::string glb_json(const TriangleMesh& mesh, const WriteOptions& options) {
  const std::string vertices = std::to_string(mesh.positions.size());
  const std::string points = std::to_string(12 * mesh.positions.size());
  const std::string triangles = std::to_string(12 * mesh.triangles.size());
  Box3 box;
  for (const Vec3& p : mesh.positions) box.include(p);
  std::string text =
      R"({"asset":{"version":"2.0","generator":"Argil"},"scene":0,)"
      R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"name":)" +
      nlohmann::json(options.title).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace) +
      R"(,"matrix":[0.001,0,0,0,0,0,-0.001,0,0,0.001,0,0,0,0,0,1]}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)"
      R"("buffers":[{"byteLength":)" +
      std::to_string(12 * (mesh.positions.size() + mesh.triangles.size())) +
      R"(}],"bufferViews":[{"buffer":0,"byteLength":)" + points +
      R"(,"target":34962},{"buffer":0,"byteOffset":)" + points + R"(,"byteLength":)" + triangles +
      R"(,"target":34963}],)" + R"("accessors":[{"bufferView":0,"componentType":5126,"count":)" +
      vertices + R"(,"type":"VEC3","min":)" + corner_text(box.min) + R"(,"max":)" +
      corner_text(box.max) + R"(},{"bufferView":1,"componentType":5125,"count":)" +
      std::to_string(3 * mesh.triangles.size()) + R"(,"type":"SCALAR"}]})";
  text.resize((text.size() + 3) / 4 * 4, ' ');
  return text;
}

Result<void> write_glb(Chunks& chunks, const TriangleMesh& mesh, const WriteOptions& options) {
  const std::string json = glb_json(mesh, options);
  const std::size_t binary = 12 * (mesh.positions.size() + mesh.triangles.size());
  const std::size_t whole = 12 + 8 + json.size() + 8 + binary;
  if (whole > std::numeric_limits<std::uint32_t>::max()) {
    return Error{ErrorKind::bad_input,
                 "the mesh takes more than the 4 GB of a GLB file; write .3mf or .ply"};
  }
  const auto size = [](std::size_t bytes) { return static_cast<std::uint32_t>(bytes); };
  chunks.text("glTF").raw(std::uint32_t{2}).raw(size(whole));
  chunks.raw(size(json.size())).text("JSON").text(json);
  chunks.raw(size(binary)).text(std::string_view("BIN\0", 4));
  Result<void> written =
      write_each(chunks, mesh.positions, [&](const Vec3& p) { chunks.raw(floats(p)); });
  if (!written) return written;
  return write_each(chunks, mesh.triangles, [&](const Triangle& t) { chunks.raw(t); });
}

std::string xml_escaped(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    }
  }
  return escaped;
}

constexpr std::string_view kContentTypes =
    R"(<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
 <Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
 <Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>
</Types>
)";
constexpr std::string_view kRelationships =
    R"(<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
 <Relationship Target="/3D/3dmodel.model" Id="rel0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>
</Relationships>
)";

/// One mesh as an object; `name` is left out when empty.
Result<void> write_object(Chunks& chunks, std::size_t id, const std::string& name,
                          const TriangleMesh& mesh) {
  chunks.text("  <object id=\"").number(id).text("\" type=\"model\"");
  if (!name.empty()) chunks.text(" name=\"").text(xml_escaped(name)).text("\"");
  chunks.text(">\n   <mesh>\n    <vertices>\n");
  Result<void> written = write_each(chunks, mesh.positions, [&](const Vec3& p) {
    const auto [x, y, z] = floats(p);
    chunks.text("<vertex x=\"").number(x).text("\" y=\"").number(y).text("\" z=\"").number(z);
    chunks.text("\"/>\n");
  });
  if (!written) return written;
  chunks.text("    </vertices>\n    <triangles>\n");
  written = write_each(chunks, mesh.triangles, [&](const Triangle& t) {
    chunks.text("<triangle v1=\"").number(t[0]).text("\" v2=\"").number(t[1]).text("\" v3=\"");
    chunks.number(t[2]).text("\"/>\n");
  });
  chunks.text("    </triangles>\n   </mesh>\n  </object>\n");
  return written;
}

/// An object for each part, and one of components that holds them where they are.
Result<void> write_parts(Chunks& chunks, const TriangleMesh& mesh, const WriteOptions& options,
                         std::size_t& last_id) {
  const std::vector<TriangleMesh> parts = split_mesh(mesh, options.parts);
  for (const TriangleMesh& part : parts) {
    const std::string name = options.title + " " + std::to_string(++last_id);
    if (Result<void> written = write_object(chunks, last_id, name, part); !written) return written;
  }
  ++last_id;
  chunks.text("  <object id=\"").number(last_id).text("\" type=\"model\" name=\"");
  chunks.text(xml_escaped(options.title)).text("\">\n   <components>\n");
  for (std::size_t id = 1; id < last_id; ++id) {
    chunks.text("    <component objectid=\"").number(id).text("\"/>\n");
    if (!chunks.step()) return stopped();
  }
  chunks.text("   </components>\n  </object>\n");
  return {};
}

Result<void> write_model(Chunks& chunks, const TriangleMesh& mesh, const WriteOptions& options) {
  chunks.text(R"(<?xml version="1.0" encoding="UTF-8"?>
<model unit="millimeter" xml:lang="en-US" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02" xmlns:argil="urn:argil:certificate">
 <metadata name="Title">)");
  chunks.text(xml_escaped(options.title))
      .text("</metadata>\n <metadata name=\"Application\">Argil</metadata>");
  for (const auto& [name, value] : options.metadata) {
    chunks.text("\n <metadata name=\"").text(xml_escaped(name)).text("\">");
    chunks.text(xml_escaped(value)).text("</metadata>");
  }
  chunks.text("\n <resources>\n");
  std::size_t last_id = 0;
  Result<void> written = options.parts.empty() ? write_object(chunks, ++last_id, "", mesh)
                                               : write_parts(chunks, mesh, options, last_id);
  chunks.text(" </resources>\n <build>\n  <item objectid=\"").number(last_id);
  chunks.text("\"/>\n </build>\n</model>\n");
  return written;
}

Result<void> write_entry(ZipWriter& zip, const std::string& name, std::string_view content) {
  zip.begin(name);
  zip.write(content);
  return zip.end();
}

Result<void> write_3mf(OutputFile& out, const TriangleMesh& mesh, const WriteOptions& options,
                       const Progress& progress) {
  ZipWriter zip(out);
  Result<void> written = write_entry(zip, "[Content_Types].xml", kContentTypes);
  if (written) written = write_entry(zip, "_rels/.rels", kRelationships);
  if (!written) return written;
  zip.begin("3D/3dmodel.model");
  Chunks chunks([&](std::string_view data) { zip.write(data); }, progress,
                mesh.positions.size() + mesh.triangles.size());
  written = write_model(chunks, mesh, options);
  if (!written) return written;
  chunks.flush();
  written = zip.end();
  zip.finish();
  return written;
}

Result<void> writable(const TriangleMesh& mesh) {
  constexpr std::size_t kMost = std::numeric_limits<std::int32_t>::max();  // PLY's int
  if (mesh.triangles.empty())
    return Error{ErrorKind::bad_input, "the mesh has no triangles to write"};
  if (mesh.triangles.size() > kMost || mesh.positions.size() > kMost) {
    return Error{ErrorKind::bad_input, "the mesh has more than 2147483647 triangles; split it"};
  }
  for (const Vec3& p : mesh.positions) {
    const auto [x, y, z] = floats(p);
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
  return Error{ErrorKind::bad_input,
               file.string() + ": the ending '" + ending +
                   "' is not a mesh format known here; use .obj, .stl, .ply, .glb or .3mf"};
}

TriangleMesh rounded_to_float(TriangleMesh mesh) {
  for (Vec3& p : mesh.positions) {
    const auto [x, y, z] = floats(p);
    p = {double{x}, double{y}, double{z}};
  }
  return mesh;
}

Result<void> write_format(OutputFile& out, MeshFormat format, const TriangleMesh& mesh_mm,
                          const WriteOptions& options, const Progress& progress) {
  if (Result<void> fits = writable(mesh_mm); !fits) return fits;
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
  if (format == MeshFormat::threemf) return write_3mf(out, mesh_mm, options, progress);
  Chunks chunks([&](std::string_view data) { out.write(data); }, progress,
                mesh_mm.positions.size() + mesh_mm.triangles.size());
  Result<void> written = format == MeshFormat::obj   ? write_obj(chunks, mesh_mm)
                         : format == MeshFormat::ply ? write_ply(chunks, mesh_mm, options)
                         : format == MeshFormat::glb ? write_glb(chunks, mesh_mm, options)
                                                     : write_stl(chunks, mesh_mm);
  chunks.flush();
  return written;
}

}  // namespace argil::io
