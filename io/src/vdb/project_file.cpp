// SPDX-License-Identifier: GPL-3.0-or-later
// A project is one VDB file with a grid for each level, the finest first, the mask, `argil_*`
// metadata and the seal behind all (file_seal.h). Loading checks seal, header, grids, nesting and
// hash, in this order, and names what is wrong.
#include "argil/io/project_file.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <deque>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <openvdb/openvdb.h>

#include "argil/core/hash_text.h"
#include "argil/core/no_throw.h"
#include "argil/engine/storage.h"
#include "argil/io/safe_file.h"

#include "file/file_bytes.h"
#include "file/file_seal.h"
#include "vdb/project_header.h"
#include "vdb/vdb_read.h"
#include "vdb/vdb_transform.h"
#include "vdb/vdb_write.h"

namespace argil::io {
namespace {

namespace fs = std::filesystem;

// ---- saving ------------------------------------------------------------------------------------

void add_grids(const PieceHeader& piece, const StoredClay& clay, std::vector<GridToWrite>& grids) {
  const Placement& at = piece.look.placement;
  for (int level = 0; level < clay.level_count(); ++level) {
    grids.push_back({piece.level_name(level), openvdb::GRID_LEVEL_SET, clay.voxel_mm(level),
                     clay.band_mm(level),
                     [&clay, level](LevelVisitor& to) { clay.show_level(level, to); }, at});
  }
  if (clay.has_mask()) {
    grids.push_back({piece.mask_name(), openvdb::GRID_FOG_VOLUME, piece.mask_voxel_mm(),
                     clay.mask_elsewhere(), [&clay](LevelVisitor& to) { clay.show_mask(to); }, at});
  }
}

Result<void> write_project(const fs::path& file, const ProjectHeader& header,
                           std::span<const StoredClay> clays, std::uint64_t hash) {
  assert(clays.size() == header.pieces.size());
  std::vector<GridToWrite> grids;
  for (std::size_t n = 0; n < clays.size(); ++n) add_grids(header.pieces[n], clays[n], grids);
  return replace_file(file, [&](const fs::path& temporary) -> Result<void> {
    auto saved = write_vdb(temporary, project_metadata(header), hash, grids);
    if (saved) return seal_file(temporary);
    if (saved.error().kind != ErrorKind::interrupted) return saved;
    return Error{ErrorKind::interrupted,
                 "interrupted while writing '" + file.string() + "'; it is as it was before"};
  });
}

// ---- loading -----------------------------------------------------------------------------------

bool contains_text(std::span<const std::byte> bytes, std::string_view text) {
  const auto* begin = reinterpret_cast<const char*>(bytes.data());
  return std::string_view(begin, bytes.size()).find(text) != std::string_view::npos;
}

constexpr std::array<unsigned char, 8> kVdbMagic{0x20, 0x42, 0x44, 0x56, 0, 0, 0, 0};
constexpr std::size_t kHead = 4096;  // the file's metadata stand at its front

/// What stands before the seal, or why this is no project.
Result<std::span<const std::byte>> checked_bytes(const fs::path& file,
                                                 std::span<const std::byte> bytes) {
  if (bytes.empty())
    return refused_project(file, "is empty; give a project that argil saved (NAME.vdb)");
  const bool vdb = bytes.size() >= kVdbMagic.size() &&
                   std::equal(kVdbMagic.begin(), kVdbMagic.end(), bytes.begin(),
                              [](unsigned char a, std::byte b) { return std::byte{a} == b; });
  if (!vdb) {
    return refused_project(
        file,
        "is not a VDB file; give a project that argil saved, or make one of a mesh "
        "with 'argil import'");
  }
  if (const auto body = unsealed(bytes)) return *body;
  if (contains_text(bytes.first(std::min(kHead, bytes.size())), "argil_format")) {
    return refused_project(
        file, "is damaged: its " + std::to_string(bytes.size()) +
                  " bytes do not match their checksum (cut off, changed, or saved again "
                  "by another program); use an older copy");
  }
  return refused_project(
      file,
      "is a VDB but not a project of Argil, or cut off near its beginning; give a "
      "file that argil saved");
}

/// The grids of a file by name, and whether each was read.
using GridNames = std::map<std::string, bool>;

GridNames names_in(const VdbContent& content) {
  GridNames names;
  for (const NamedGrid& grid : content.grids) names.try_emplace(grid.name, grid.is_read);
  return names;
}

/// Hands the grids of one piece to the clay that is made of them, and keeps what it learned.
class PieceReader {
 public:
  PieceReader(const fs::path& file, const PieceHeader& header)
      : file_(file),
        header_(header),
        builder_(header.options, header.levels),
        fits_(static_cast<std::size_t>(header.levels) + 1, false) {}

  /// Null where the grid does not fit. `level`: levels() for the mask; each once.
  LevelSink* sink_for(const GridHead& head, int level);
  /// What is wrong, in one order; else the clay with its hash.
  Result<BuiltClay> finish(const GridNames& grids) &&;

  /// Of levels, then of the mask, if there is one.
  std::vector<std::string> grid_names() const;

 private:
  Result<void> check_grid(const GridNames& grids, const std::string& name) const;
  Result<void> check_level(const GridNames& grids, int level) const;
  Result<void> check_mask(const GridNames& grids) const;
  Result<void> check_nesting() const;
  bool is_placed(const GridHead& head, double voxel_mm) const {
    return *head.transform == *grid_transform(voxel_mm, header_.look.placement);
  }

  const fs::path& file_;
  const PieceHeader& header_;
  ClayBuilder builder_;
  /// Of levels and mask: whether the grid has the transform and background that it should have, so
  /// that it was taken.
  std::vector<bool> fits_;
};

std::vector<std::string> PieceReader::grid_names() const {
  std::vector<std::string> names;
  for (int level = 0; level < header_.levels; ++level) names.push_back(header_.level_name(level));
  if (header_.has_mask) names.push_back(header_.mask_name());
  return names;
}

LevelSink* PieceReader::sink_for(const GridHead& head, int level) {
  const bool is_mask = level == header_.levels;
  const bool fits = is_mask ? is_placed(head, header_.mask_voxel_mm())
                            : head.background == builder_.band_mm(level) &&
                                  is_placed(head, builder_.voxel_mm(level));
  fits_[static_cast<std::size_t>(level)] = fits;
  if (!fits) return nullptr;
  return is_mask ? &builder_.mask(head.background) : &builder_.level(level);
}

/// Success where there is a grid of that name that was read; the error names what it is instead.
Result<void> PieceReader::check_grid(const GridNames& grids, const std::string& name) const {
  const auto found = grids.find(name);
  if (found != grids.end() && found->second) return {};
  if (found != grids.end()) {
    return refused_project(file_,
                           "has a grid '" + name + "' that is not of type float on cubic voxels");
  }
  if (name == header_.mask_name()) {
    return refused_project(file_,
                           "has no grid '" + name + "', which its format holds; use an older copy");
  }
  return refused_project(file_, "has no grid '" + name + "'; it says it has " +
                                    std::to_string(header_.levels) + " levels; use an older copy");
}

Result<void> PieceReader::check_level(const GridNames& grids, int level) const {
  const std::string name = header_.level_name(level);
  if (auto there = check_grid(grids, name); !there) return there;
  if (!fits_[static_cast<std::size_t>(level)]) {
    return refused_project(file_,
                           "has a grid '" + name + "' of another voxel size or place than it says");
  }
  if (builder_.is_sound(level)) return {};
  return refused_project(file_, "has a grid '" + name +
                                    "' with values beyond its band, or out of reach; use an older "
                                    "copy");
}

Result<void> PieceReader::check_mask(const GridNames& grids) const {
  const std::string name = header_.mask_name();
  if (auto there = check_grid(grids, name); !there) return there;
  if (!fits_.back()) {
    return refused_project(
        file_, "has a grid '" + name + "' of another voxel size or place; use an older copy");
  }
  if (builder_.is_mask_sound()) return {};
  return refused_project(
      file_, "has a grid '" + name + "' that holds no fractions from 0 to 1; use an older copy");
}

/// What works on a clay counts on the coarser leaves that a finer one requires.
Result<void> PieceReader::check_nesting() const {
  const auto problem = builder_.nesting_problem();
  if (!problem) return {};
  std::string at = "(" + std::to_string(problem->origin[0]) + ", ";
  at.append(std::to_string(problem->origin[1])).append(", ");
  at.append(std::to_string(problem->origin[2])).append(")");
  return refused_project(
      file_, "has levels that do not nest: the leaf at " + at + " of level " +
                 std::to_string(problem->level) + " lacks " +
                 (problem->lacks_parent ? "its parent" : "the parent of a neighbour") +
                 " in level " + std::to_string(problem->level + 1) + "; use an older copy");
}

Result<BuiltClay> PieceReader::finish(const GridNames& grids) && {
  for (int level = 0; level < header_.levels; ++level) {
    if (auto sound = check_level(grids, level); !sound) return sound.error();
  }
  if (header_.has_mask) {
    if (auto sound = check_mask(grids); !sound) return sound.error();
  }
  if (auto nested = check_nesting(); !nested) return nested.error();
  return std::move(builder_).finish();
}

/// Hands each grid that the file's description promises to its piece.
class ProjectReader {
 public:
  explicit ProjectReader(const fs::path& file) : file_(file) {}

  Result<Sculpture> read(std::span<const std::byte> body);

 private:
  LevelSink* sink_for(const openvdb::MetaMap& meta, const GridHead& head);
  void take_header(const openvdb::MetaMap& meta);
  Result<Sculpture> finish(const VdbContent& content);
  Result<void> check_hash(std::uint64_t hash) const;

  const fs::path& file_;
  std::optional<Result<ProjectHeader>> header_;
  std::deque<PieceReader> pieces_;  ///< once the header is sound; they stay where they are
  struct Wanted {
    PieceReader* piece;
    int level;
  };
  std::map<std::string, Wanted> wanted_;  ///< grids that have not come yet
};

void ProjectReader::take_header(const openvdb::MetaMap& meta) {
  if (header_) return;
  header_ = read_project_header(file_, meta);
  if (!*header_) return;
  for (const PieceHeader& header : header_->value().pieces) {
    PieceReader& piece = pieces_.emplace_back(file_, header);
    int level = 0;
    for (const std::string& name : piece.grid_names()) wanted_[name] = {&piece, level++};
  }
}

LevelSink* ProjectReader::sink_for(const openvdb::MetaMap& meta, const GridHead& head) {
  take_header(meta);
  // The first grid of a name counts, as far as it fits.
  const auto node = wanted_.extract(head.name);
  return node ? node.mapped().piece->sink_for(head, node.mapped().level) : nullptr;
}

Result<void> ProjectReader::check_hash(std::uint64_t hash) const {
  const std::string& told = header_->value().hash;
  if (hash_text(hash) == told) return {};
  return refused_project(file_, "holds a clay with hash " + hash_text(hash) + " but says " + told +
                                    "; use an older copy");
}

Result<Sculpture> ProjectReader::finish(const VdbContent& content) {
  take_header(content.meta);  // where there is no grid that would have asked for it
  if (!*header_) return header_->error();
  ProjectHeader& header = header_->value();
  std::vector<Sculpture::ReadyPiece> ready;
  std::uint64_t hash = 0;
  const GridNames grids = names_in(content);
  for (std::size_t n = 0; n < pieces_.size(); ++n) {
    auto built = std::move(pieces_[n]).finish(grids);
    if (!built) return built.error();
    hash = built.value().hash;
    ready.push_back({header.pieces[n].look, std::move(built.value().clay)});
  }
  auto sculpture = Sculpture::of(std::move(ready), header.active);
  if (!sculpture) return refused_project(file_, "cannot be: " + sculpture.error().message);
  // That of a clay alone is known already.
  if (!sculpture.value().is_plain()) hash = sculpture.value().hash();
  if (auto same = check_hash(hash); !same) return same.error();
  return sculpture;
}

Result<Sculpture> ProjectReader::read(std::span<const std::byte> body) {
  const auto content = read_vdb(body, [&](const openvdb::MetaMap& meta, const GridHead& head) {
    return sink_for(meta, head);
  });
  if (content) return finish(content.value());
  if (content.error().kind == ErrorKind::interrupted) {
    return Error{ErrorKind::interrupted, "interrupted while opening '" + file_.string() + "'"};
  }
  return refused_project(file_,
                         "cannot be read: it " + content.error().message + "; use an older copy");
}

std::string names_of(const Sculpture& sculpture) {
  constexpr std::size_t kMostShown = 200;
  std::string names;
  for (std::size_t n = 0; n < sculpture.piece_count() && names.size() < kMostShown; ++n) {
    names.append(names.empty() ? "'" : ", '").append(sculpture.look(n).name).append("'");
  }
  return names;
}

}  // namespace

Result<void> save_project(const fs::path& file, const Clay& clay) {
  return no_throw(file.string(), [&]() -> Result<void> {
    openvdb::initialize();
    const std::array clays{StoredClay(clay)};
    const std::uint64_t hash = clay.hash();
    return write_project(file, header_of(clay, hash), clays, hash);
  });
}

Result<void> save_sculpture(const fs::path& file, const Sculpture& sculpture) {
  return no_throw(file.string(), [&]() -> Result<void> {
    openvdb::initialize();
    std::vector<StoredClay> clays;
    for (std::size_t n = 0; n < sculpture.piece_count(); ++n) {
      clays.emplace_back(sculpture.clay(n));
    }
    const std::uint64_t hash = sculpture.hash();
    return write_project(file, header_of(sculpture, hash), clays, hash);
  });
}

bool holds_project(const fs::path& file) {
  std::array<char, kHead> head{};
  std::ifstream in(file, std::ios::binary);
  in.read(head.data(), head.size());
  const std::string_view read(head.data(), static_cast<std::size_t>(in.gcount()));
  const auto same = [](unsigned char a, char b) { return a == static_cast<unsigned char>(b); };
  return read.size() > kVdbMagic.size() &&
         std::equal(kVdbMagic.begin(), kVdbMagic.end(), read.begin(), same) &&
         read.find("argil_format") != std::string_view::npos;
}

std::string stated_hash(const fs::path& file) {
  std::array<char, kHead> head{};
  std::ifstream in(file, std::ios::binary);
  in.read(head.data(), head.size());
  const std::string_view read(head.data(), static_cast<std::size_t>(in.gcount()));
  // Name, type and value, each behind its length of four bytes.
  constexpr std::string_view kKey("argil_hash\x06\0\0\0string\x10\0\0\0", 24);
  const std::size_t at = read.find(kKey);
  if (at == std::string_view::npos) return {};
  return std::string(read.substr(at + kKey.size(), 16));
}

Result<Sculpture> load_sculpture(const fs::path& file) {
  return no_throw(file.string(), [&]() -> Result<Sculpture> {
    const auto bytes = read_file_bytes(file);
    if (!bytes) return bytes.error();
    const auto body = checked_bytes(file, bytes.value());
    if (!body) return body.error();
    openvdb::initialize();
    return ProjectReader(file).read(body.value());
  });
}

Result<Clay> load_project(const fs::path& file) {
  auto sculpture = load_sculpture(file);
  if (!sculpture) return sculpture.error();
  if (sculpture.value().piece_count() == 1) return std::move(sculpture.value()).take_clay();
  return refused_project(file, "has several pieces, " + names_of(sculpture.value()) +
                                   ", where one clay is wanted; merge them first");
}

}  // namespace argil::io
