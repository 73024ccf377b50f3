// SPDX-License-Identifier: GPL-3.0-or-later
// 3MF, core specification 1.3: a ZIP archive of the content types, the relationship that names the
// model, and the model. Coordinates are the shortest decimals that give the same floats back.
#include "mesh_format/3mf_write.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>
#include <string_view>

#include "argil/mesh/rounding.h"

#include "format/xml_text.h"
#include "format/zip_write.h"
#include "mesh_format/chunks.h"

namespace argil::io {
namespace {

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

Error too_much_text(const std::string& bytes, std::uint64_t most) {
  return {ErrorKind::bad_input,
          "the mesh is too large for a 3MF: " + bytes + " bytes of text, which must be less than " +
              std::to_string(most) + "; write .stl or .ply, or remove triangles"};
}

/// The model as XML: a group of colors, where there are any, the meshes, the objects of components
/// and the build. Numbers of objects go on from one to the next.
class ModelWriter {
 public:
  /// `chunks` go to `zip`; without one all goes through them. Stops where `zip` has `most` bytes of
  /// text.
  ModelWriter(Chunks& chunks, ZipWriter* zip, const ThreemfModel& model, std::uint64_t most)
      : chunks_(chunks), zip_(zip), model_(model), most_(most) {}

  Result<void> write();

 private:
  void write_head();
  void write_colors();
  template <class Items, class One>
  Result<void> write_records(const Items& items, const One& one);
  Result<void> write_mesh(const ThreemfObject& object);
  Result<void> write_components(const AssemblyItem& item);
  void write_placement(const char* element, std::size_t id, const Affine& to_mm);
  void begin_object(const std::string& name);
  static bool is_grouped(const AssemblyItem& item) {
    return item.placements.size() > 1 || !item.name.empty();
  }

  Chunks& chunks_;
  ZipWriter* zip_;
  const ThreemfModel& model_;
  std::uint64_t most_;
  std::map<Srgb, std::size_t> colors_;  ///< the place of each in its group
  std::size_t last_id_ = 0;
  std::size_t first_object_ = 0;
};

void ModelWriter::write_head() {
  chunks_.text(R"(<?xml version="1.0" encoding="UTF-8"?>
<model unit="millimeter" xml:lang="en-US" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02" xmlns:argil="urn:argil:certificate">
 <metadata name="Title">)");
  chunks_.text(xml_escaped(plain_name(model_.title, Assembly::kLongestName)))
      .text("</metadata>\n <metadata name=\"Application\">Argil</metadata>");
  for (const auto& [name, value] : model_.metadata) {
    chunks_.text("\n <metadata name=\"").text(xml_escaped(name)).text("\">");
    chunks_.text(xml_escaped(value)).text("</metadata>");
  }
  chunks_.text("\n <resources>\n");
}

/// Each color once, in the order of the objects; a material has to have a name.
void ModelWriter::write_colors() {
  for (const ThreemfObject& object : model_.objects) {
    if (!object.color || !colors_.try_emplace(*object.color, colors_.size()).second) continue;
    if (colors_.size() == 1) {
      chunks_.text("  <basematerials id=\"").number(++last_id_).text("\">\n");
    }
    const auto [red, green, blue] = *object.color;
    std::array<char, 8> code;
    std::snprintf(code.data(), code.size(), "#%02X%02X%02X", red, green, blue);
    chunks_.text("   <base name=\"").text(code.data()).text("\" displaycolor=\"");
    chunks_.text(code.data()).text("\"/>\n");
    chunks_.step();
  }
  if (!colors_.empty()) chunks_.text("  </basematerials>\n");
}

void ModelWriter::begin_object(const std::string& name) {
  chunks_.text("  <object id=\"").number(++last_id_).text("\" type=\"model\"");
  if (!name.empty())
    chunks_.text(" name=\"").text(xml_escaped(plain_name(name, Assembly::kLongestName))).text("\"");
}

/// A piece of the text, deflated by itself.
struct DeflatedPiece {
  Piece text;
  Deflater deflater;
  std::string_view packed;
  std::uint32_t crc = 0;
};

/// As write_each. A few are text like any other: by themselves they would take more.
template <class Items, class One>
Result<void> ModelWriter::write_records(const Items& items, const One& one) {
  constexpr std::size_t kFew = 512;
  if (zip_ == nullptr || items.size() < kFew) return write_each(chunks_, items, one);
  chunks_.flush();
  const auto make = [&](const ItemRange& range, DeflatedPiece& piece) {
    piece.text.clear();
    for (std::size_t i = range.begin; i < range.end; ++i) one(items[i], piece.text);
    piece.packed = piece.deflater.packed(piece.text.all());
    piece.crc = crc_of(piece.text.all());
  };
  const auto use = [&](const ItemRange& range, const DeflatedPiece& piece) {
    zip_->write_deflated(piece.packed, piece.text.all().size(), piece.crc);
    return zip_->entry_bytes() < most_ && chunks_.step_past(range.end - range.begin);
  };
  if (make_in_order<DeflatedPiece>(items.size(), make, use)) return {};
  const std::uint64_t bytes = zip_->entry_bytes();
  if (bytes < most_) return writing_stopped();
  return too_much_text(std::to_string(bytes) + " and more", most_);
}

Result<void> ModelWriter::write_mesh(const ThreemfObject& object) {
  begin_object(object.name);
  if (object.color) {
    chunks_.text(" pid=\"1\" pindex=\"").number(colors_.at(*object.color)).text("\"");
  }
  chunks_.text(">\n   <mesh>\n    <vertices>\n");
  Result<void> written = write_records(object.mesh->positions, [](const Vec3& p, Piece& to) {
    const auto [x, y, z] = mesh::floats_of(p);
    to.text("<vertex x=\"").number(x).text("\" y=\"").number(y).text("\" z=\"").number(z);
    to.text("\"/>\n");
  });
  if (!written) return written;
  chunks_.text("    </vertices>\n    <triangles>\n");
  written = write_records(object.mesh->triangles, [](const Triangle& t, Piece& to) {
    to.text("<triangle v1=\"").number(t[0]).text("\" v2=\"").number(t[1]).text("\" v3=\"");
    to.number(t[2]).text("\"/>\n");
  });
  chunks_.text("    </triangles>\n   </mesh>\n  </object>\n");
  return written;
}

void ModelWriter::write_placement(const char* element, std::size_t id, const Affine& to_mm) {
  chunks_.text(element).text(" objectid=\"").number(id).text("\"");
  if (!to_mm.is_identity()) {
    chunks_.text(" transform=\"");
    for (std::size_t i = 0; i < 12; ++i) {
      if (i > 0) chunks_.text(" ");
      chunks_.number(to_mm.rows[i / 3][i % 3]);
    }
    chunks_.text("\"");
  }
  chunks_.text("/>\n");
}

Result<void> ModelWriter::write_components(const AssemblyItem& item) {
  begin_object(item.name);
  chunks_.text(">\n   <components>\n");
  for (const PlacedObject& placed : item.placements) {
    write_placement("    <component", first_object_ + placed.object, placed.to_mm);
    if (!chunks_.step()) return writing_stopped();
  }
  chunks_.text("   </components>\n  </object>\n");
  return {};
}

Result<void> ModelWriter::write() {
  write_head();
  write_colors();
  first_object_ = last_id_ + 1;
  for (const ThreemfObject& object : model_.objects) {
    if (Result<void> written = write_mesh(object); !written) return written;
  }
  std::size_t group = last_id_;
  for (const AssemblyItem& item : *model_.items) {
    if (!is_grouped(item)) continue;
    if (Result<void> written = write_components(item); !written) return written;
  }
  chunks_.text(" </resources>\n <build>\n");
  for (const AssemblyItem& item : *model_.items) {
    if (is_grouped(item)) {
      write_placement("  <item", ++group, {});
    } else {
      write_placement("  <item", first_object_ + item.placements[0].object,
                      item.placements[0].to_mm);
    }
    if (!chunks_.step()) return writing_stopped();
  }
  chunks_.text(" </build>\n</model>\n");
  return {};
}

Result<void> write_entry(ZipWriter& zip, const std::string& name, std::string_view content) {
  zip.begin(name);
  zip.write(content);
  return zip.end();
}

/// What the model takes at most, without looking at its numbers.
std::uint64_t most_text(const ThreemfModel& model) {
  // Of the lines that ModelWriter writes, with the longest float (-1.17549435e-38) and index.
  constexpr std::uint64_t kVertex = 25 + 3 * 15;
  constexpr std::uint64_t kTriangle = 30 + 3 * 10;
  constexpr std::uint64_t kPlacement = 400;
  constexpr std::uint64_t kLongestEscape = 6;
  constexpr std::uint64_t kObject = 400 + kLongestEscape * Assembly::kLongestName;
  std::uint64_t bytes = 2 * kObject;
  for (const auto& [name, value] : model.metadata) {
    bytes += kObject + kLongestEscape * (name.size() + value.size());
  }
  for (const ThreemfObject& object : model.objects) {
    bytes += kObject + kVertex * object.mesh->positions.size() +
             kTriangle * object.mesh->triangles.size();
  }
  for (const AssemblyItem& item : *model.items) {
    bytes += kObject + kPlacement * (1 + item.placements.size());
  }
  return bytes;
}

/// What progress is counted in.
std::size_t steps_of(const ThreemfModel& model) {
  std::size_t steps = model.items->size();
  for (const ThreemfObject& object : model.objects) {
    steps += object.mesh->positions.size() + object.mesh->triangles.size();
  }
  return steps;
}

}  // namespace

Result<void> check_3mf_size(const ThreemfModel& model, const Progress& progress,
                            std::uint64_t most) {
  if (most_text(model) < most) return {};
  std::uint64_t bytes = 0;
  const Progress not_begun = [&](std::string_view stage, double) {
    return !progress || progress(stage, 0.0);
  };
  Chunks chunks([&](std::string_view text) { bytes += text.size(); }, not_begun, steps_of(model));
  const Result<void> counted = ModelWriter(chunks, nullptr, model, most).write();
  if (!counted) return counted;
  chunks.flush();
  if (bytes < most) return {};
  return too_much_text(std::to_string(bytes), most);
}

Result<void> write_3mf(OutputFile& out, const ThreemfModel& model, const Progress& progress,
                       std::uint64_t most) {
  ZipWriter zip(out);
  Result<void> written = write_entry(zip, "[Content_Types].xml", kContentTypes);
  if (written) written = write_entry(zip, "_rels/.rels", kRelationships);
  if (!written) return written;
  zip.begin("3D/3dmodel.model");
  Chunks chunks([&](std::string_view data) { zip.write(data); }, progress, steps_of(model));
  written = ModelWriter(chunks, &zip, model, most).write();
  if (!written) return written;
  chunks.flush();
  if (zip.entry_bytes() >= most) return too_much_text(std::to_string(zip.entry_bytes()), most);
  written = zip.end();
  zip.finish();
  return written;
}

}  // namespace argil::io
