// SPDX-License-Identifier: GPL-3.0-or-later
// Archives made to unpack to more than they hold, each through the whole reader of 3MF.
#include "format/zip_read.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include "mesh_format/mesh_read.h"
#include "support/bytes/zip_maker.h"

namespace argil::io {
namespace {

using test::crc_of;
using test::little_endian;
using test::PackedEntry;
using test::relations;
using test::stored;
using test::zip_of;
using testing::HasSubstr;

/// Of one text behind another.
std::uint32_t crc_behind(std::uint32_t front, std::uint32_t back, std::size_t back_bytes) {
  return static_cast<std::uint32_t>(crc32_combine(front, back, static_cast<z_off_t>(back_bytes)));
}

/// Without the header of zlib, and so that whatever is deflated next may follow.
std::string deflated_piece(const std::string& text) {
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, 9, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string packed(deflateBound(&stream, static_cast<uLong>(text.size())) + 16, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  EXPECT_EQ(deflate(&stream, Z_FULL_FLUSH), Z_OK);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

/// `front`, then so many MiB of blanks, then `back`, deflated; the blanks only once.
PackedEntry blown_up(const std::string& name, const std::string& front, int blanks_mib,
                     const std::string& back) {
  const std::string blanks(1 << 20, ' ');
  const std::string piece = deflated_piece(blanks);
  const std::uint32_t blanks_crc = crc_of(blanks);
  PackedEntry entry{name, deflated_piece(front), static_cast<std::uint32_t>(front.size()),
                    crc_of(front)};
  for (int n = 0; n < blanks_mib; ++n) {
    entry.packed += piece;
    entry.bytes += static_cast<std::uint32_t>(blanks.size());
    entry.crc = crc_behind(entry.crc, blanks_crc, blanks.size());
  }
  entry.packed += deflated_piece(back) + std::string("\x03\0", 2);  // and the last, empty block
  entry.bytes += static_cast<std::uint32_t>(back.size());
  entry.crc = crc_behind(entry.crc, crc_of(back), back.size());
  return entry;
}

constexpr const char* kVertices =
    R"(<vertices><vertex x="0" y="0" z="0"/><vertex x="3" y="0" z="0"/>)"
    R"(<vertex x="0" y="3" z="0"/><vertex x="0" y="0" z="3"/></vertices>)";
constexpr const char* kTriangles =
    R"(<triangles><triangle v1="0" v2="2" v3="1"/><triangle v1="0" v2="1" v3="3"/>)"
    R"(<triangle v1="1" v2="2" v3="3"/><triangle v1="2" v2="0" v3="3"/></triangles>)";

std::string model_front(const std::string& vertices = kVertices) {
  return R"(<model unit="millimeter"><resources><object id="1"><mesh>)" + vertices + kTriangles +
         "</mesh></object></resources>";
}

Result<TriangleMesh> read_3mf(const std::string& archive) {
  StatedUnit unit;
  auto parsed = parse_3mf(std::as_bytes(std::span(archive)), "a.3mf", unit);
  if (!parsed) return parsed.error();
  return joined(std::move(parsed.value().assembly));
}

std::string refusal_of_3mf(const std::string& archive) {
  const auto read = read_3mf(archive);
  if (read) return "accepted";
  EXPECT_EQ(read.error().kind, ErrorKind::bad_input);
  return read.error().message;
}

constexpr const char* kBuild = R"(<build><item objectid="1"/></build></model>)";

/// A model that requires the extension `x` of this namespace.
std::string requiring(const std::string& space) {
  std::string model = model_front() + kBuild;
  const std::string needs = " xmlns:x=\"" + space + "\" requiredextensions=\"x\"";
  return zip_of({relations(), stored("3D/a.model", model.insert(sizeof "<model" - 1, needs))});
}

TEST(ReadThreemf, RefusesRequiredExtensionsByNameUnlessTheyLeaveTheMesh) {
  for (const std::string known : {"material/2015/02", "production/2015/06", "slice/2015/07"}) {
    const auto read = read_3mf(requiring("http://schemas.microsoft.com/3dmanufacturing/" + known));
    EXPECT_TRUE(read) << read.error().message;
  }
  EXPECT_THAT(
      refusal_of_3mf(requiring("http://schemas.3mf.io/3dmanufacturing/implicit/2023/12")),
      HasSubstr("a.3mf: 3D/a.model:1: it requires the extension "
                "'3dmanufacturing/implicit/2023/12', which is not read here; export without it"));
  EXPECT_THAT(refusal_of_3mf(requiring("")), HasSubstr("requires the extension 'x'"));
}

TEST(ReadZip, UnpacksWhatPacksWell) {
  const auto read =
      read_3mf(zip_of({relations(), blown_up("3D/a.model", model_front(), 20, kBuild)}));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read.value().triangles.size(), 4U);
}

TEST(ReadZip, RefusesABombByWhatItSaysOfItself) {
  const auto bomb = zip_of({relations(), blown_up("3D/a.model", model_front(), 2000, kBuild)});
  EXPECT_LT(bomb.size(), 3'000'000U);
  EXPECT_THAT(refusal_of_3mf(bomb),
              testing::AllOf(HasSubstr("a.3mf: '3D/a.model' unpacks to 2097 MB, and of an archive"),
                             HasSubstr(" MB are read; export the file again")));
}

/// Each part alone is within the limit.
TEST(ReadZip, RefusesABombInSeveralParts) {
  const std::string item = R"(<item objectid="1" p:path="/3D/)";
  const std::string start = "<model><resources/><build>" + item + "b.model\"/>" + item +
                            "c.model\"/>" + item + "d.model\"/></build></model>";
  std::vector<PackedEntry> entries{relations(), stored("3D/a.model", start)};
  for (const char* name : {"3D/b.model", "3D/c.model", "3D/d.model"}) {
    entries.push_back(blown_up(name, model_front(), 60, "</model>"));
  }
  EXPECT_THAT(refusal_of_3mf(zip_of(entries)), HasSubstr("'3D/d.model' unpacks to 62 MB"));
  entries.pop_back();
  EXPECT_THAT(refusal_of_3mf(zip_of(entries)),
              HasSubstr("the model part '/3D/d.model' is missing"));
}

TEST(ReadZip, RefusesAnEntryThatUnpacksToMoreThanItSays) {
  PackedEntry bomb = blown_up("3D/a.model", model_front(), 300, kBuild);
  bomb.bytes = 1'000'000;
  EXPECT_THAT(refusal_of_3mf(zip_of({relations(), bomb})), HasSubstr("does not unpack"));
}

TEST(ReadZip, RefusesAnEntryThatSaysMoreThanItsBytesCanUnpackTo) {
  PackedEntry model = blown_up("3D/a.model", model_front(), 0, kBuild);
  model.bytes = static_cast<std::uint32_t>(1032 * model.packed.size() + 65);
  EXPECT_THAT(refusal_of_3mf(zip_of({relations(), model})),
              HasSubstr("'3D/a.model' in its archive says that its " +
                        std::to_string(model.packed.size()) + " bytes unpack to"));
}

/// The bytes of one as those of all: they would unpack to any number of times their size.
TEST(ReadZip, RefusesEntriesWithinOthers) {
  std::vector<PackedEntry> entries{relations(), relations()};
  EXPECT_THAT(refusal_of_3mf(zip_of(entries, true)),
              HasSubstr("'_rels/.rels' in its archive lies within another"));
  std::string outside = zip_of({relations()});
  const std::size_t packed_at = outside.find("PK\x01\x02") + 20;
  outside.replace(packed_at, 4, little_endian(outside.size(), 4));
  EXPECT_THAT(refusal_of_3mf(outside), HasSubstr("lies outside the file"));
}

TEST(ReadThreemf, NamesTheVertexThatIsPlacedBeyondAKilometre) {
  const std::string vertices =
      R"(<vertices><vertex x="0" y="0" z="0"/><vertex x="3" y="0" z="0"/>)"
      R"(<vertex x="0" y="2e6" z="0"/><vertex x="0" y="0" z="3"/></vertices>)";
  EXPECT_THAT(
      refusal_of_3mf(zip_of({relations(), stored("3D/a.model", model_front(vertices) + kBuild)})),
      HasSubstr("a.3mf: /3D/a.model: vertex 2 (from 0) of object 1, as it is placed: a coordinate "
                "is 2e+06 mm from the origin"));
}

}  // namespace
}  // namespace argil::io
