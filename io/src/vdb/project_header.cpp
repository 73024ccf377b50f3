// SPDX-License-Identifier: GPL-3.0-or-later
// Formats 1 and 2 describe a clay alone, without and with a mask, by a value each. Format 3
// describes several pieces, each by a JSON object. The oldest format that holds all is written, so
// that older programs read what they can.
#include "vdb/project_header.h"

#include <cassert>
#include <memory>
#include <utility>

#include <openvdb/openvdb.h>

#include "argil/core/hash_text.h"
#include "argil/engine/storage.h"

#include "format/piece_look.h"

namespace argil::io {
namespace {

namespace fs = std::filesystem;

constexpr int kPlainFormat = 1;   // a clay without a mask; the oldest that is read
constexpr int kMaskedFormat = 2;  // and with one
constexpr int kPiecesFormat = 3;  // pieces; the newest that is read

std::string piece_key(std::size_t n) { return "argil_piece_" + std::to_string(n + 1); }

// ---- writing -----------------------------------------------------------------------------------

PieceHeader piece_header(const PieceLook& look, const Clay& clay, const std::string& front) {
  return {look, clay.options(), clay.level_count(), clay.has_mask(), front};
}

void put_plain(openvdb::MetaMap& meta, const PieceHeader& piece) {
  meta.insertMeta("argil_levels", openvdb::Int32Metadata(piece.levels));
  meta.insertMeta("argil_voxel_mm", openvdb::DoubleMetadata(piece.options.voxel_mm));
  meta.insertMeta("argil_tolerance_voxels",
                  openvdb::DoubleMetadata(piece.options.tolerance_voxels));
  if (const auto& edge = piece.options.edge_radius_mm) {
    meta.insertMeta("argil_edge_radius_mm", openvdb::DoubleMetadata(*edge));
  }
}

std::string piece_text(const PieceHeader& piece) {
  OrderedJson json;
  json["name"] = piece.look.name;
  json["levels"] = piece.levels;
  json["voxel_mm"] = piece.options.voxel_mm;
  json["tolerance_voxels"] = piece.options.tolerance_voxels;
  if (piece.options.edge_radius_mm) json["edge_radius_mm"] = *piece.options.edge_radius_mm;
  if (piece.has_mask) json["mask"] = true;
  put_look(json, piece.look);
  return json.dump();
}

bool is_plain(const ProjectHeader& header) { return header.pieces.front().grid_front.empty(); }

// ---- reading -----------------------------------------------------------------------------------

template <class T>
bool read_meta(const openvdb::MetaMap& meta, const std::string& name, T& out) {
  const auto found = meta.getMetadata<openvdb::TypedMetadata<T>>(name);
  if (found) out = found->value();
  return found != nullptr;
}

Result<std::int32_t> read_format(const fs::path& file, const openvdb::MetaMap& meta) {
  std::int32_t format = 0;
  if (!read_meta(meta, "argil_format", format)) {
    return refused_project(file, "has no 'argil_format'; give a file that argil saved");
  }
  if (format < kPlainFormat) {
    return refused_project(file, "has format " + std::to_string(format) +
                                     ", which no argil ever wrote; use an older copy");
  }
  if (format > kPiecesFormat) {
    return refused_project(
        file, "has format " + std::to_string(format) + " and this program reads up to " +
                  std::to_string(kPiecesFormat) + "; open it with a newer argil");
  }
  return format;
}

Error incomplete(const fs::path& file) {
  return refused_project(file,
                         "lacks a piece of its description (levels, voxel size, tolerance, hash); "
                         "use an older copy");
}

/// What either way of describing a clay may get wrong.
Result<void> check_piece(const fs::path& file, const PieceHeader& piece) {
  if (piece.levels < 1 || piece.levels > storage::kMostLevels) return incomplete(file);
  if (auto valid = validate_options(piece.options); !valid) {
    return refused_project(file, "says what no clay can be: " + valid.error().message);
  }
  return {};
}

Result<PieceHeader> read_plain(const fs::path& file, const openvdb::MetaMap& meta) {
  PieceHeader piece;
  std::int32_t levels = 0;
  const bool complete = read_meta(meta, "argil_levels", levels) &&
                        read_meta(meta, "argil_voxel_mm", piece.options.voxel_mm) &&
                        read_meta(meta, "argil_tolerance_voxels", piece.options.tolerance_voxels);
  if (!complete) return incomplete(file);
  if (double edge = 0.0; meta["argil_edge_radius_mm"]) {
    if (!read_meta(meta, "argil_edge_radius_mm", edge)) {
      return refused_project(file,
                             "has an 'argil_edge_radius_mm' that is no number; use an older copy");
    }
    piece.options.edge_radius_mm = edge;
  }
  piece.levels = levels;
  if (auto sound = check_piece(file, piece); !sound) return sound.error();
  return piece;
}

Result<PieceHeader> piece_of(const Fields& fields) {
  PieceHeader piece;
  auto read = fields.only({"name", "levels", "voxel_mm", "tolerance_voxels", "edge_radius_mm",
                           "mask", "position_mm", "orientation", "visible", "locked", "color"});
  for (const char* key : {"name", "levels", "voxel_mm", "tolerance_voxels"}) {
    if (read && !fields.has(key)) read = fields.missing(key, "use an older copy");
  }
  if (read && !fields.at("name").is_string()) read = fields.wrong("name", "a text");
  if (read && !fields.at("levels").is_number_unsigned()) read = fields.wrong("levels", "a count");
  if (read) read = fields.positive("voxel_mm", piece.options.voxel_mm);
  if (read) read = fields.positive("tolerance_voxels", piece.options.tolerance_voxels);
  if (read && fields.has("edge_radius_mm")) {
    read = fields.number("edge_radius_mm", piece.options.edge_radius_mm.emplace(0.0));
  }
  if (read) read = fields.flag("mask", piece.has_mask);
  if (read) read = read_look(fields, piece.look);
  if (!read) return read.error();
  piece.look.name = fields.at("name").get<std::string>();
  const auto levels = fields.at("levels").get<std::uint64_t>();
  piece.levels = levels > storage::kMostLevels ? 0 : static_cast<int>(levels);
  piece.grid_front = piece.look.name + "/";
  return piece;
}

Result<PieceHeader> read_piece(const fs::path& file, const openvdb::MetaMap& meta, std::size_t n) {
  std::string text;
  if (!read_meta(meta, piece_key(n), text)) return incomplete(file);
  const FileLine where{file.string() + ": " + piece_key(n), 1};
  const auto json = parse_object(where, text);
  if (!json) return json.error();
  auto piece = piece_of(Fields(where, json.value()));
  if (!piece) return piece;
  if (auto sound = check_piece(file, piece.value()); !sound) return sound.error();
  if (auto valid = validate_look(piece.value().look); !valid) {
    return refused_project(file, "says what no piece can be: " + valid.error().message);
  }
  return piece;
}

Result<void> read_pieces(const fs::path& file, const openvdb::MetaMap& meta,
                         ProjectHeader& header) {
  std::int32_t count = 0;
  std::int32_t active = 0;
  if (!read_meta(meta, "argil_pieces", count) || !read_meta(meta, "argil_active_piece", active)) {
    return incomplete(file);
  }
  constexpr auto kMost = static_cast<std::int32_t>(Sculpture::kMostPieces);
  if (count < 1 || count > kMost || active < 1 || active > count) {
    return refused_project(file, "says that it has " + std::to_string(count) +
                                     " pieces, of which number " + std::to_string(active) +
                                     " is active; use an older copy");
  }
  header.active = static_cast<std::size_t>(active - 1);
  for (std::size_t n = 0; n < static_cast<std::size_t>(count); ++n) {
    auto piece = read_piece(file, meta, n);
    if (!piece) return piece.error();
    for (const PieceHeader& other : header.pieces) {
      if (other.look.name != piece.value().look.name) continue;
      return refused_project(file, "has two pieces '" + other.look.name + "'; use an older copy");
    }
    header.pieces.push_back(std::move(piece).value());
  }
  return {};
}

}  // namespace

Error refused_project(const fs::path& file, const std::string& what) {
  return {ErrorKind::bad_input, "'" + file.string() + "' " + what};
}

std::string PieceHeader::level_name(int level) const {
  return grid_front + "surface_" + std::to_string(level);
}
std::string PieceHeader::mask_name() const { return grid_front + "mask"; }
double PieceHeader::mask_voxel_mm() const { return storage::kMaskVoxels * options.voxel_mm; }

ProjectHeader header_of(const Clay& clay, std::uint64_t hash) {
  return {{piece_header({}, clay, "")}, 0, hash_text(hash)};
}

ProjectHeader header_of(const Sculpture& sculpture, std::uint64_t hash) {
  if (sculpture.is_plain()) return header_of(sculpture.clay(), hash);
  ProjectHeader header{{}, sculpture.active(), hash_text(hash)};
  for (std::size_t n = 0; n < sculpture.piece_count(); ++n) {
    const PieceLook& look = sculpture.look(n);
    header.pieces.push_back(piece_header(look, sculpture.clay(n), look.name + "/"));
  }
  return header;
}

openvdb::MetaMap project_metadata(const ProjectHeader& header) {
  assert(!header.pieces.empty());
  const PieceHeader& first = header.pieces.front();
  openvdb::MetaMap meta;
  meta.insertMeta("creator", openvdb::StringMetadata("Argil"));
  const int format = !is_plain(header) ? kPiecesFormat
                     : first.has_mask  ? kMaskedFormat
                                       : kPlainFormat;
  meta.insertMeta("argil_format", openvdb::Int32Metadata(format));
  meta.insertMeta("argil_units", openvdb::StringMetadata("mm"));
  if (is_plain(header)) {
    put_plain(meta, first);
  } else {
    const auto count = static_cast<std::int32_t>(header.pieces.size());
    meta.insertMeta("argil_pieces", openvdb::Int32Metadata(count));
    meta.insertMeta("argil_active_piece",
                    openvdb::Int32Metadata(static_cast<std::int32_t>(header.active) + 1));
    for (std::size_t n = 0; n < header.pieces.size(); ++n) {
      meta.insertMeta(piece_key(n), openvdb::StringMetadata(piece_text(header.pieces[n])));
    }
  }
  meta.insertMeta("argil_hash", openvdb::StringMetadata(header.hash));
  return meta;
}

Result<ProjectHeader> read_project_header(const fs::path& file, const openvdb::MetaMap& meta) {
  const auto format = read_format(file, meta);
  if (!format) return format.error();
  ProjectHeader header;
  if (format.value() == kPiecesFormat) {
    if (auto read = read_pieces(file, meta, header); !read) return read.error();
  } else {
    auto plain = read_plain(file, meta);
    if (!plain) return plain.error();
    plain.value().has_mask = format.value() == kMaskedFormat;
    header.pieces.push_back(std::move(plain).value());
  }
  if (!read_meta(meta, "argil_hash", header.hash)) return incomplete(file);
  return header;
}

}  // namespace argil::io
