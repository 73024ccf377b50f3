// SPDX-License-Identifier: GPL-3.0-or-later
// Projects of several pieces.
#include <cmath>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>

#include "argil/io/project_file.h"

#include "file/file_bytes.h"
#include "file/file_seal.h"
#include "support/scratch.h"
#include "support/stroke_maker.h"
#include "vdb/project_header.h"

namespace argil::io {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A ball, and a masked block that stands elsewhere, turned, coloured, locked and active.
Sculpture ball_and_block() {
  Sculpture sculpture(Clay::ball(5.0, {0.4, 0.1}).value(), {.name = "Ball"});
  AddPiece add;
  add.look = {.name = "Blöck/surface_0",
              .placement = {{20.0, -3.0, 1.5}, {0.6, 0.0, 0.0, 0.8}},
              .is_locked = true,
              .color = Rgb8{255, 128, 0}};
  Clay block = Clay::block({8.0, 4.0, 2.0}, {.voxel_mm = 0.25, .edge_radius_mm = 0.5}).value();
  EXPECT_TRUE(block.apply(MaskEdit::fill));
  add.clay = std::make_shared<const Clay>(std::move(block));
  EXPECT_TRUE(sculpture.apply(add));
  return sculpture;
}

class SculptureFile : public testing::Test {
 protected:
  /// What is said of a project whose description was changed, sealed again.
  std::string told_of(const std::function<void(openvdb::MetaMap&)>& change) {
    const Sculpture sculpture = ball_and_block();
    EXPECT_TRUE(save_sculpture(file_, sculpture));
    openvdb::initialize();
    openvdb::io::File in(file_.string());
    in.open();
    openvdb::GridPtrVec grids = *in.getGrids();
    openvdb::MetaMap meta(*in.getMetadata());
    in.close();
    change(meta);
    openvdb::io::File(file_.string()).write(grids, meta);
    EXPECT_TRUE(seal_file(file_));
    const auto loaded = load_sculpture(file_);
    return loaded ? "" : loaded.error().message;
  }

  test::ScratchFolder folder_;
  std::filesystem::path file_ = folder_ / "p.vdb";
};

TEST_F(SculptureFile, KeepsPiecesWithTheirLooks) {
  const Sculpture sculpture = ball_and_block();
  ASSERT_TRUE(save_sculpture(file_, sculpture));
  EXPECT_TRUE(holds_project(file_));
  const auto loaded = load_sculpture(file_);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded.value().hash(), sculpture.hash());
  EXPECT_EQ(loaded.value().active(), 1U);
  EXPECT_EQ(loaded.value().clay(0).hash(), sculpture.clay(0).hash());
  EXPECT_EQ(loaded.value().clay(1).hash(), sculpture.clay(1).hash());
  EXPECT_EQ(loaded.value().clay(1).options().edge_radius_mm, 0.5);
  const PieceLook& look = loaded.value().look(1);
  EXPECT_EQ(look.name, "Blöck/surface_0");
  EXPECT_EQ(look.placement.position_mm, (Vec3{20.0, -3.0, 1.5}));
  EXPECT_EQ(look.placement.orientation, sculpture.look(1).placement.orientation);
  EXPECT_TRUE(look.is_locked && look.is_visible);
  EXPECT_EQ(look.color, (Rgb8{255, 128, 0}));
  // The same bytes again.
  ASSERT_TRUE(save_sculpture(folder_ / "q.vdb", loaded.value()));
  EXPECT_EQ(read_file_bytes(folder_ / "q.vdb").value().size(),
            read_file_bytes(file_).value().size());
}

TEST_F(SculptureFile, OfAPlainSculptureIsThatOfItsClay) {
  const Clay clay = Clay::ball(5.0, {0.4, 0.1}).value();
  ASSERT_TRUE(save_project(file_, clay));
  ASSERT_TRUE(save_sculpture(folder_ / "q.vdb", Sculpture(Clay::ball(5.0, {0.4, 0.1}).value())));
  const auto bytes_of = [](const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  EXPECT_EQ(bytes_of(file_), bytes_of(folder_ / "q.vdb"));
}

TEST_F(SculptureFile, OfSeveralPiecesIsNoSingleClay) {
  ASSERT_TRUE(save_sculpture(file_, ball_and_block()));
  const auto clay = load_project(file_);
  ASSERT_FALSE(clay);
  EXPECT_EQ(clay.error().kind, ErrorKind::bad_input);
  EXPECT_THAT(clay.error().message, AllOf(HasSubstr("'Ball'"), HasSubstr("merge")));
}

TEST_F(SculptureFile, HoldsHundredsOfGrids) {
  Sculpture sculpture(Clay::ball(4.0, {0.5, 0.1}).value());
  for (int n = 0; n < 70; ++n) {
    ASSERT_TRUE(sculpture.apply(CopyPiece{"Clay", sculpture.free_name("Clay")}));
  }
  ASSERT_TRUE(save_sculpture(file_, sculpture));
  const auto loaded = load_sculpture(file_);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded.value().hash(), sculpture.hash());
}

/// Other programs see each piece where it stands.
TEST_F(SculptureFile, GridsStandWhereTheirPiecesDo) {
  const Sculpture sculpture = ball_and_block();
  ASSERT_TRUE(save_sculpture(file_, sculpture));
  openvdb::initialize();
  openvdb::io::File other(file_.string());
  other.open();
  for (std::size_t n = 0; n < 2; ++n) {
    const PieceLook& look = sculpture.look(n);
    const auto grid =
        openvdb::gridPtrCast<openvdb::FloatGrid>(other.readGrid(look.name + "/surface_0"));
    ASSERT_TRUE(grid);
    openvdb::tools::GridSampler<openvdb::FloatGrid, openvdb::tools::BoxSampler> sampler(*grid);
    for (const Vec3& p : {Vec3{3.9, 0.1, 0.9}, Vec3{3.6, 1.0, 0.2}, Vec3{0.5, 0.3, 1.1}}) {
      const double here = sculpture.clay(n).distance_at(p);
      if (std::abs(here) > 1.0) continue;  // beyond the finest band
      const Vec3 q = placed(look.placement, p);
      EXPECT_NEAR(sampler.wsSample({q.x, q.y, q.z}), here, 1e-5) << look.name;
    }
  }
}

TEST_F(SculptureFile, RefusesDescriptionsThatCannotBe) {
  EXPECT_EQ(told_of([](openvdb::MetaMap&) {}), "") << "OpenVDB's own copy is read";
  const auto text_of = [](openvdb::MetaMap& meta, const char* key) {
    return meta.getMetadata<openvdb::StringMetadata>(key)->value();
  };
  const auto with = [&](const char* key, const std::string& from, const std::string& to) {
    return told_of([&](openvdb::MetaMap& meta) {
      std::string text = text_of(meta, key);
      const std::size_t at = text.find(from);
      ASSERT_NE(at, std::string::npos) << text;
      meta.insertMeta(key, openvdb::StringMetadata(text.replace(at, from.size(), to)));
    });
  };
  constexpr const char* kFirst = "argil_piece_1";
  constexpr const char* kSecond = "argil_piece_2";
  EXPECT_THAT(with(kFirst, "\"Ball\"", "\"Blöck/surface_0\""), HasSubstr("two pieces"));
  EXPECT_THAT(with(kFirst, "\"Ball\"", "\"\""), HasSubstr("no name"));
  EXPECT_THAT(with(kFirst, "\"Ball\"", "\"Bell\""), HasSubstr("'Bell/surface_0'"));
  EXPECT_THAT(with(kFirst, "\"levels\":", "\"levels\":9"), HasSubstr("levels"));
  EXPECT_THAT(with(kFirst, "\"levels\":", "\"levels\":-"), HasSubstr("levels"));
  EXPECT_THAT(with(kFirst, "{", "["), HasSubstr(kFirst));
  EXPECT_THAT(with(kSecond, "20.0", "20.5"), HasSubstr("place"));
  EXPECT_THAT(with(kSecond, "20.0", "2e7"), HasSubstr("1 km"));
  EXPECT_THAT(with(kSecond, "0.25", "0.26"), HasSubstr("voxel size"));
  EXPECT_THAT(with(kSecond, "\"locked\":true", "\"locked\":false"), HasSubstr("hash"));
  EXPECT_THAT(with(kSecond, "#ff8000", "#ff80"), HasSubstr("'color'"));
  const auto count = [&](std::int32_t pieces, std::int32_t active) {
    return told_of([&](openvdb::MetaMap& meta) {
      meta.insertMeta("argil_pieces", openvdb::Int32Metadata(pieces));
      meta.insertMeta("argil_active_piece", openvdb::Int32Metadata(active));
    });
  };
  EXPECT_THAT(count(0, 0), HasSubstr("0 pieces"));
  EXPECT_THAT(count(2, 3), HasSubstr("number 3"));
  EXPECT_THAT(count(2, -1), HasSubstr("number -1"));
  EXPECT_THAT(count(1'000'000, 1), HasSubstr("1000000 pieces"));
  EXPECT_THAT(count(3, 1), HasSubstr("lacks"));
  EXPECT_THAT(count(2, 1), HasSubstr("hash")) << "another is active";
}

}  // namespace
}  // namespace argil::io
