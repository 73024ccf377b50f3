// SPDX-License-Identifier: GPL-3.0-or-later
// What slicers keep beside the model of a 3MF. PrusaSlicer:
//   <object id="1"><metadata type="object" key="name" value="Lamp"/>
//     <volume firstid="0" lastid="11"><metadata type="volume" key="name" value="Foot"/> ...
// Bambu Studio and OrcaSlicer:
//   <object id="8"><metadata key="name" value="Lamp"/>
//     <part id="1" subtype="normal_part"><metadata key="name" value="Foot"/> ...
#include "mesh_format/3mf_names.h"

#include <string_view>

#include "argil/io/assembly.h"

#include "format/text_scan.h"
#include "format/xml_text.h"

namespace argil::io {
namespace {

constexpr std::size_t kMostSlicerParts = 1'000'000;

class SlicerObjectsParser {
 public:
  explicit SlicerObjectsParser(XmlScan::TakePiece text) : xml_(std::move(text)) {}

  Result<SlicerObjects> parse();

 private:
  Result<void> opened();
  Result<void> part();
  void metadata();
  void closed();
  Error fail(const std::string& message) const {
    return {ErrorKind::bad_input, "line " + std::to_string(xml_.line()) + ": " + message};
  }

  XmlScan xml_;
  SlicerObjects objects_;
  SlicerObject* object_ = nullptr;
  SlicerPart* part_ = nullptr;
  std::size_t parts_ = 0;
};

Result<void> SlicerObjectsParser::part() {
  if (++parts_ > kMostSlicerParts) {
    return fail("it has more than " + std::to_string(kMostSlicerParts) + " parts");
  }
  if (xml_.name() == "volume") {
    part_ = &object_->ranges.emplace_back();
    if (!read_integer(xml_.attribute("firstid"), part_->first_triangle) ||
        !read_integer(xml_.attribute("lastid"), part_->last_triangle)) {
      return fail("a volume has no firstid or lastid");
    }
    return {};
  }
  std::int64_t id = 0;
  if (!read_integer(xml_.attribute("id"), id)) return fail("a part has no id");
  part_ = &object_->components[id];
  const std::string_view kind = xml_.attribute("subtype");
  part_->is_printed = kind.empty() || kind == "normal_part";
  return {};
}

void SlicerObjectsParser::metadata() {
  const std::string_view key = xml_.attribute("key");
  const std::string_view value = xml_.attribute("value");
  if (key == "name") {
    (part_ != nullptr ? part_->name : object_->name) =
        plain_name(xml_unescaped(value), Assembly::kLongestName);
  }
  if (part_ == nullptr) return;
  if (key == "volume_type") part_->is_printed = value == "ModelPart";
  if (key == "modifier" && value == "1") part_->is_printed = false;
}

Result<void> SlicerObjectsParser::opened() {
  const std::string_view name = xml_.name();
  if (name == "object" && object_ == nullptr) {
    std::int64_t id = 0;
    if (!read_integer(xml_.attribute("id"), id)) return fail("an object has no id");
    object_ = &objects_[id];
    *object_ = {};
    return {};
  }
  if (object_ == nullptr) return {};
  if ((name == "volume" || name == "part") && part_ == nullptr) return part();
  if (name == "metadata") metadata();
  return {};
}

void SlicerObjectsParser::closed() {
  const std::string_view name = xml_.name();
  if (name == "volume" || name == "part") part_ = nullptr;
  if (name == "object") object_ = nullptr;
  if (object_ == nullptr) part_ = nullptr;
}

Result<SlicerObjects> SlicerObjectsParser::parse() {
  for (;;) {
    switch (xml_.next()) {
      case XmlScan::Event::open:
        if (Result<void> read = opened(); !read) return read.error();
        break;
      case XmlScan::Event::close:
        closed();
        break;
      case XmlScan::Event::end:
        return std::move(objects_);
      case XmlScan::Event::error:
        return fail(xml_.problem());
    }
  }
}

}  // namespace

Result<SlicerObjects> read_slicer_objects(XmlScan::TakePiece text) {
  return SlicerObjectsParser(std::move(text)).parse();
}

bool covers_triangles(const SlicerObject& object, std::size_t triangles) {
  const auto count = static_cast<std::int64_t>(triangles);
  std::int64_t next = 0;
  for (const SlicerPart& part : object.ranges) {
    const bool is_next = part.first_triangle == next && part.last_triangle >= next;
    if (!is_next || part.last_triangle >= count) return false;
    next = part.last_triangle + 1;
  }
  return next == count;
}

}  // namespace argil::io
