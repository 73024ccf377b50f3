// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/printer_file.h"

#include <string_view>

#include "argil/core/no_throw.h"

#include "file/file_bytes.h"
#include "format/json_fields.h"

namespace argil::io {
namespace {

constexpr int kPrinterFormat = 1;

/// Not below 0, and below `limit`.
Result<void> read_bound(const Fields& fields, const char* key, double limit,
                        const std::string& range, double& out) {
  if (auto read = fields.number(key, out); !read || !fields.has(key)) return read;
  // Written so that NaN fails too.
  if (!(out >= 0.0 && out < limit)) return fields.wrong(key, range);
  return {};
}

Result<mesh::Printer> read_fields(const Fields& fields) {
  mesh::Printer printer;
  if (!fields.has("argil_printer")) {
    return fields.missing("argil_printer", "a printer profile starts with \"argil_printer\": 1");
  }
  if (fields.at("argil_printer") != kPrinterFormat) {
    return fields.wrong("argil_printer", "1, the format that this program knows");
  }
  auto known = fields.only({"argil_printer", "name", "bed_mm", "min_wall_mm", "min_gap_mm",
                            "max_overhang_deg", "needs_drains", "min_part_mm3", "max_triangles",
                            "max_file_mb"});
  if (!known) return known.error();
  if (!fields.has("name")) return fields.missing("name", "call the printer something");
  if (!fields.at("name").is_string()) return fields.wrong("name", "a text in quotes");
  printer.name = fields.at("name").get<std::string>();
  if (fields.has("bed_mm")) {
    if (auto read = fields.positive_triple("bed_mm", printer.bed_mm); !read) return read.error();
    if (!is_in_reach(printer.bed_mm)) {
      return fields.wrong("bed_mm", "three numbers greater than 0, at most 1e6");
    }
  }
  constexpr double kMost = 1e12;
  const std::string range = "a number from 0 (any) to 1e12";
  double triangles = 0.0;
  for (auto [key, out] :
       {std::pair{"min_wall_mm", &printer.min_wall_mm},
        std::pair{"min_gap_mm", &printer.min_gap_mm},
        std::pair{"min_part_mm3", &printer.min_part_mm3}, std::pair{"max_triangles", &triangles},
        std::pair{"max_file_mb", &printer.max_file_mb}}) {
    if (auto read = read_bound(fields, key, kMost, range, *out); !read) return read.error();
  }
  printer.max_triangles = static_cast<std::int64_t>(triangles);
  auto overhang = read_bound(fields, "max_overhang_deg", 90.0, "from 0 (any) to below 90 degrees",
                             printer.max_overhang_deg);
  if (!overhang) return overhang.error();
  if (auto read = fields.flag("needs_drains", printer.needs_drains); !read) return read.error();
  return printer;
}

}  // namespace

Result<mesh::Printer> read_printer(const std::filesystem::path& file) {
  return no_throw(file.string(), [&]() -> Result<mesh::Printer> {
    const auto bytes = read_file_bytes(file);
    if (!bytes) return bytes.error();
    const FileLine where{file.string(), 1};
    const auto* text = reinterpret_cast<const char*>(bytes.value().data());
    auto object = parse_object(where, std::string_view(text, bytes.value().size()));
    if (!object) return object.error();
    return read_fields(Fields(where, object.value()));
  });
}

}  // namespace argil::io
