// SPDX-License-Identifier: GPL-3.0-or-later
// 3MF, core specification 1.3: a ZIP archive of the content types, the relationship that names the
// model, and the model. Coordinates are the shortest decimals that give the same floats back.
#include <cassert>
#include <string>
#include <string_view>
#include <vector>

#include "argil/mesh/bodies.h"
#include "argil/mesh/rounding.h"

#include "format/zip_write.h"
#include "mesh_format/chunks.h"

namespace argil::io {
namespace {

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
        // XML 1.0 has no other control characters, not even escaped.
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
    const auto [x, y, z] = mesh::floats_of(p);
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
  assert(options.parts.size() == mesh.triangles.size());
  const std::vector<TriangleMesh> parts = mesh::split_mesh(mesh, options.parts);
  for (const TriangleMesh& part : parts) {
    const std::string name = options.title + " " + std::to_string(++last_id);
    if (Result<void> written = write_object(chunks, last_id, name, part); !written) return written;
  }
  ++last_id;
  chunks.text("  <object id=\"").number(last_id).text("\" type=\"model\" name=\"");
  chunks.text(xml_escaped(options.title)).text("\">\n   <components>\n");
  for (std::size_t id = 1; id < last_id; ++id) {
    chunks.text("    <component objectid=\"").number(id).text("\"/>\n");
    if (!chunks.step()) return writing_stopped();
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

}  // namespace

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

}  // namespace argil::io
