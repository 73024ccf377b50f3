// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/project_file.h"

#include <csignal>
#include <cstring>
#include <fstream>
#include <limits>
#include <memory>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <tbb/global_control.h>

#include "argil/engine/storage.h"
#include "argil/io/safe_file.h"

#include "clay/clay_access.h"
#include "field/level_stack.h"
#include "field/nesting.h"
#include "file/file_seal.h"
#include "support/effort.h"

namespace argil::io {
namespace {

using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;

/// A path of this test's own, removed at the end.
class OwnFile {
 public:
  explicit OwnFile(const std::string& name = "project.vdb")
      : path_(fs::path(testing::TempDir()) /
              (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + "." +
               name)) {}
  ~OwnFile() { fs::remove(path_); }
  OwnFile(const OwnFile&) = delete;
  OwnFile& operator=(const OwnFile&) = delete;
  const fs::path& path() const { return path_; }
  void write(const std::string& bytes) const {
    fs::remove(path_);  // ext4 waits for the disk where a file is written over
    std::ofstream(path_, std::ios::binary | std::ios::trunc) << bytes;
  }
  std::string read() const {
    std::ostringstream text;
    text << std::ifstream(path_, std::ios::binary).rdbuf();
    return text.str();
  }

 private:
  fs::path path_;
};

/// A ball with an engraving, so that there are several levels.
Clay engraved_ball() {
  auto ball = Clay::ball(4.0, {0.1, 0.1});
  EXPECT_TRUE(ball) << ball.error().message;
  Stroke stroke;
  stroke.tool = {Action::carve, Shape::ball, {0.5, 0.5, 0.5}, 1.0};
  for (const double x : {-1.0, 0.0, 1.0}) stroke.samples.push_back({0.0, {x, 0.0, 4.0}, {}, 1.0});
  const auto report = ball.value().apply(stroke);
  EXPECT_TRUE(report) << report.error().message;
  return std::move(ball).value();
}

std::string error_of(const fs::path& file) {
  const auto clay = load_project(file);
  if (clay) return "";
  EXPECT_EQ(clay.error().kind, ErrorKind::bad_input) << clay.error().message;
  EXPECT_THAT(clay.error().message, HasSubstr(file.string()));
  return clay.error().message;
}

TEST(ProjectFile, LoadsTheBitsItSaved) {
  const OwnFile file;
  const Clay clay = engraved_ball();
  ASSERT_GT(clay.level_count(), 1);
  const auto saved = save_project(file.path(), clay);
  ASSERT_TRUE(saved) << saved.error().message;
  const auto loaded = load_project(file.path());
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded.value().hash(), clay.hash());
  EXPECT_EQ(loaded.value().options().voxel_mm, 0.1);
  EXPECT_EQ(loaded.value().options().tolerance_voxels, 0.1);
  EXPECT_EQ(loaded.value().level_count(), clay.level_count());
  EXPECT_THAT(loaded.value().validate(), testing::IsEmpty());
}

Clay ball_with_edges(double radius_mm) {
  ClayOptions options{.voxel_mm = 0.1};
  options.edge_radius_mm = radius_mm;
  return Clay::ball(2.0, options).value();
}

TEST(ProjectFile, KeepsTheRadiusOfEdges) {
  const OwnFile file;
  for (const double radius : {0.0, 0.3}) {
    ASSERT_TRUE(save_project(file.path(), ball_with_edges(radius)));
    const auto loaded = load_project(file.path());
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded.value().options().edge_radius_mm, radius);
  }
  ASSERT_TRUE(save_project(file.path(), engraved_ball()));
  EXPECT_EQ(load_project(file.path()).value().options().edge_radius_mm, std::nullopt);
}

/// Holds some of it firmly, some not, and with `invert` all the rest.
Clay masked_ball(bool invert) {
  Clay clay = engraved_ball();
  Stroke stroke;
  stroke.tool = {Action::mask, Shape::ball, {1.5, 1.5, 1.5}, 0.4};
  stroke.samples.push_back({0.0, {0.5, -3.8, 0.3}, {}, 1.0});
  stroke.samples.push_back({1.0, {0.5, -3.2, 1.3}, {}, 1.0});
  EXPECT_TRUE(clay.apply(stroke));
  if (invert) {
    EXPECT_TRUE(clay.apply(MaskEdit::invert));
  }
  return clay;
}

TEST(ProjectFile, KeepsTheMaskToTheBit) {
  for (const bool invert : {false, true}) {
    const OwnFile file;
    const Clay clay = masked_ball(invert);
    ASSERT_TRUE(save_project(file.path(), clay));
    const auto loaded = load_project(file.path());
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded.value().hash(), clay.hash());
    EXPECT_NE(loaded.value().hash(), engraved_ball().hash());
    EXPECT_EQ(loaded.value().mask_at({0.5, -3.5, 0.5}), clay.mask_at({0.5, -3.5, 0.5}));
    EXPECT_EQ(loaded.value().mask_at({0, 0, 100}), invert ? 1.0 : 0.0);
    EXPECT_THAT(loaded.value().validate(), testing::IsEmpty());
    openvdb::initialize();
    openvdb::io::File other(file.path().string());
    other.open();
    EXPECT_TRUE(other.hasGrid("mask"));
    const auto format = other.getMetadata()->getMetadata<openvdb::Int32Metadata>("argil_format");
    EXPECT_EQ(format->value(), 2) << "older programs must refuse it";
  }
}

TEST(ProjectFile, WithoutAMaskIsOfTheFirstFormat) {
  const OwnFile file;
  Clay clay = masked_ball(true);
  ASSERT_TRUE(clay.apply(MaskEdit::clear));
  ASSERT_TRUE(save_project(file.path(), clay));
  openvdb::initialize();
  openvdb::io::File other(file.path().string());
  other.open();
  EXPECT_FALSE(other.hasGrid("mask"));
  const auto format = other.getMetadata()->getMetadata<openvdb::Int32Metadata>("argil_format");
  EXPECT_EQ(format->value(), 1);
}

/// The clay without one leaf of level 1, hash and seal right.
Clay without_leaf(const Clay& clay, const Coord& place) {
  const LevelStack& whole = levels_of(clay);
  auto levels = std::make_unique<LevelStack>(clay.options().voxel_mm, whole.count());
  for (int level = 0; level < whole.count(); ++level) {
    levels->grid(level).setTree(whole.grid(level).tree().copy());
  }
  levels->erase_leaf(1, place, levels->band_mm(1));
  return clay_of_levels(std::move(levels), clay.options());
}

/// The first fault by asking every leaf in turn.
std::optional<NestingFault> fault_of_each_leaf(const LevelStack& stack) {
  for (int level = 0; level < stack.top(); ++level) {
    for (const Coord& origin : stack.sorted_origins(level)) {
      if (auto fault = nesting_fault(stack, level, origin)) return fault;
    }
  }
  return std::nullopt;
}

TEST(ProjectFile, RefusesLevelsThatDoNotNest) {
  const OwnFile file;
  const Clay whole = engraved_ball();
  ASSERT_FALSE(first_nesting_fault(levels_of(whole)));
  int sound = 0;
  int alone = 0;
  int uneven = 0;
  for (const Coord& place : levels_of(whole).sorted_origins(1)) {
    const Clay clay = without_leaf(whole, place);
    const auto fault = first_nesting_fault(levels_of(clay));
    const auto expected = fault_of_each_leaf(levels_of(clay));
    ASSERT_EQ(fault.has_value(), expected.has_value());
    if (fault) {
      ASSERT_EQ(fault->origin, expected->origin);
    }
    const bool is_alone = fault && fault->kind == NestingFault::Kind::no_parent;
    int& seen = !fault ? sound : is_alone ? alone : uneven;
    if (++seen > test::effort(5, 100'000)) continue;  // usually some of each kind
    ASSERT_TRUE(save_project(file.path(), clay));
    const std::string error = error_of(file.path());
    EXPECT_EQ(error.empty(), !fault) << error;
    if (!fault) continue;
    EXPECT_THAT(error, AllOf(HasSubstr("has levels that do not nest: the leaf at ("),
                             HasSubstr(is_alone ? "of level 0 lacks its parent in level 1; use an"
                                                : "of level 0 lacks the parent of a neighbour in "
                                                  "level 1; use an older copy")));
    EXPECT_THAT(clay.validate(),
                testing::Contains(testing::StartsWith(
                    is_alone ? "leaf without a parent" : "neighbours differ by more than one")));
  }
  EXPECT_GT(alone, 0);
  EXPECT_GT(uneven, 0);
}

TEST(ProjectFile, ContinuesWhereItWasSaved) {
  const OwnFile file;
  Clay clay = engraved_ball();
  ASSERT_TRUE(save_project(file.path(), clay));
  auto loaded = load_project(file.path());
  ASSERT_TRUE(loaded) << loaded.error().message;
  Stroke stroke;
  stroke.tool = {Action::add, Shape::ball, {1.5, 1.5, 1.5}, 1.0};
  stroke.samples.push_back({0.0, {0.5, -3.8, 0.3}, {}, 1.0});
  ASSERT_TRUE(clay.apply(stroke));
  ASSERT_TRUE(loaded.value().apply(stroke));
  EXPECT_EQ(loaded.value().hash(), clay.hash());
}

TEST(ProjectFile, OpensInOtherPrograms) {
  const OwnFile file;
  const Clay clay = engraved_ball();
  ASSERT_TRUE(save_project(file.path(), clay));
  openvdb::initialize();
  openvdb::io::File other(file.path().string());
  other.open();
  const auto grids = other.getGrids();
  ASSERT_EQ(grids->size(), static_cast<std::size_t>(clay.level_count()));
  for (const auto& grid : *grids) {
    EXPECT_EQ(grid->getGridClass(), openvdb::GRID_LEVEL_SET);
    EXPECT_TRUE(grid->isType<openvdb::FloatGrid>());
  }
  EXPECT_EQ(other.getMetadata()->metaValue<std::string>("argil_units"), "mm");
}

TEST(ProjectFile, SaysInsideAndOutsideInTheTilesOfFinerLevels) {
  const OwnFile file;
  auto ball = Clay::ball(40.0, {0.1, 0.1});
  ASSERT_TRUE(ball) << ball.error().message;
  Stroke engraving;
  engraving.tool = {Action::carve, Shape::ball, {0.5, 0.5, 0.5}, 1.0};
  engraving.samples.push_back({0.0, {1.0, 1.0, 39.9}, {}, 1.0});
  ASSERT_TRUE(ball.value().apply(engraving));
  ASSERT_TRUE(save_project(file.path(), ball.value()));
  openvdb::initialize();
  openvdb::io::File other(file.path().string());
  other.open();
  const auto finest = openvdb::gridConstPtrCast<openvdb::FloatGrid>(other.readGrid("surface_0"));
  const auto at = [&](double x, double y, double z) {
    return finest->tree().getValue(
        openvdb::Coord::round(finest->worldToIndex(openvdb::Vec3d(x, y, z))));
  };
  EXPECT_LT(at(1.0, 1.0, 10.0), 0.0F);      // below the engraving
  EXPECT_LT(at(-10.0, 10.0, -10.0), 0.0F);  // another octant of the lattice, without a leaf
  EXPECT_GT(at(1.0, 1.0, 60.0), 0.0F);
  EXPECT_GT(at(-50.0, -50.0, -50.0), 0.0F);
}

/// What a tile says is what LevelStack::sample, which looks everywhere, says of its middle.
TEST(ProjectFile, GivesEveryTileTheSignOfItsMiddle) {
  const Clay clay = engraved_ball();
  const LevelStack& stack = levels_of(clay);
  class Judge final : public LevelVisitor {
   public:
    Judge(const LevelStack& levels, int level) : levels_(levels), level_(level) {}
    void see_tile(const NodeCoord&, float, bool) override { ADD_FAILURE() << "a tile of the root"; }
    void see_branch(const StoredBranch& branch, std::span<const LeafView> leaves) override {
      const int along = branch.is_lower() ? 16 : 32;
      const int side = branch.is_lower() ? storage::kLeafSide : storage::kLowerSide;
      std::size_t children = 0;
      for (int n = 0; n < along * along * along; n += branch.is_lower() ? 1 : 37) {
        const auto slot = static_cast<std::size_t>(n);
        if ((branch.children[slot / 64] >> (slot % 64) & 1U) != 0) {
          ++children;
          continue;
        }
        const Coord middle(branch.origin[0] + n / (along * along) * side + side / 2,
                           branch.origin[1] + n / along % along * side + side / 2,
                           branch.origin[2] + n % along * side + side / 2);
        const float band = levels_.band_mm(level_);
        const bool is_inside = levels_.sample(level_, middle) < 0.0F;
        ASSERT_EQ(branch.values[slot], is_inside ? -band : band) << level_ << " " << middle;
        inside += is_inside ? 1 : 0;
      }
      if (branch.is_lower()) {
        EXPECT_EQ(children, leaves.size());
      }
    }
    int inside = 0;

   private:
    const LevelStack& levels_;
    int level_;
  };
  for (int level = 0; level < stack.top(); ++level) {
    Judge judge(stack, level);
    StoredClay(clay).show_level(level, judge);
    EXPECT_GT(judge.inside, 0) << level;
  }
}

TEST(ProjectFileGolden, HasTheSameBytesAndHashForAnyNumberOfThreads) {
  const OwnFile file;
  const Clay clay = masked_ball(false);
  std::string first;
  for (const std::size_t threads : {1U, 2U, 7U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    ASSERT_TRUE(save_project(file.path(), clay));
    const std::string bytes = file.read();
    if (first.empty()) first = bytes;
    EXPECT_TRUE(bytes == first) << threads << " threads";
    const auto loaded = load_project(file.path());
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded.value().hash(), clay.hash());
  }
}

/// Neither takes a large project's time once it is told to stop, and nothing is lost.
TEST(ProjectFile, OpensAndSavesNothingOnceInterrupted) {
  const OwnFile file;
  const Clay clay = engraved_ball();
  ASSERT_TRUE(save_project(file.path(), clay));
  const std::string before = file.read();
  install_interrupt_cleanup();
  ASSERT_EQ(std::raise(SIGINT), 0);
  const auto loaded = load_project(file.path());
  const auto saved = save_project(file.path(), Clay::ball(4.0, {0.1, 0.1}).value());
  forget_interrupt();
  ASSERT_FALSE(loaded);
  EXPECT_EQ(loaded.error().kind, ErrorKind::interrupted);
  EXPECT_THAT(loaded.error().message, HasSubstr("interrupted while opening"));
  ASSERT_FALSE(saved);
  EXPECT_EQ(saved.error().kind, ErrorKind::interrupted);
  EXPECT_THAT(saved.error().message, HasSubstr("it is as it was before"));
  EXPECT_TRUE(file.read() == before);
  EXPECT_TRUE(load_project(file.path()));
}

TEST(ProjectFile, RefusesEveryTruncation) {
  const OwnFile file;
  ASSERT_TRUE(save_project(file.path(), engraved_ball()));
  const std::string bytes = file.read();
  const OwnFile cut("cut.vdb");
  const std::size_t step = test::effort<std::size_t>(13 * 97, 97);
  for (std::size_t length = 0; length < bytes.size(); length += step) {
    cut.write(bytes.substr(0, length));
    EXPECT_NE(error_of(cut.path()), "") << "cut after " << length << " bytes";
  }
}

TEST(ProjectFile, RefusesChangedBytes) {
  const OwnFile file;
  ASSERT_TRUE(save_project(file.path(), engraved_ball()));
  const std::string bytes = file.read();
  const OwnFile changed("changed.vdb");
  for (std::size_t at = 8; at < bytes.size(); at += bytes.size() / 61) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x40);
    changed.write(damaged);
    EXPECT_NE(error_of(changed.path()), "") << "byte " << at;
  }
}

TEST(ProjectFile, SaysWhatItIsNot) {
  const OwnFile file;
  file.write("");
  EXPECT_THAT(error_of(file.path()), HasSubstr("is empty"));
  file.write("solid cube\nendsolid cube\n");
  EXPECT_THAT(error_of(file.path()), HasSubstr("is not a VDB file"));

  openvdb::initialize();
  auto ball = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(5.0F, {}, 0.5F);
  ball->setName("surface_0");
  openvdb::io::File(file.path().string()).write({ball});
  EXPECT_THAT(error_of(file.path()), HasSubstr("is a VDB but not a project of Argil"));
}

TEST(ProjectFile, NamesDamage) {
  const OwnFile file;
  ASSERT_TRUE(save_project(file.path(), engraved_ball()));
  std::string bytes = file.read();
  file.write(bytes.substr(0, bytes.size() - 1));
  EXPECT_THAT(error_of(file.path()),
              HasSubstr("is damaged: its " + std::to_string(bytes.size() - 1)));
}

TEST(ProjectFile, ReadsItsOwnFormatAndSaysWhichOthersAre) {
  const OwnFile file;
  ASSERT_TRUE(save_project(file.path(), engraved_ball()));
  const std::string bytes = file.read();
  const std::string key = std::string("argil_format") + '\5' + std::string(3, '\0') + "int32" +
                          '\4' + std::string(3, '\0');
  const std::size_t at = bytes.find(key);
  ASSERT_NE(at, std::string::npos);
  const auto with_format = [&](char format) {
    std::string changed = bytes.substr(0, bytes.size() - kSealBytes);
    changed[at + key.size()] = format;
    file.write(changed);
    EXPECT_TRUE(seal_file(file.path()));
    return error_of(file.path());
  };
  EXPECT_EQ(with_format(1), "");
  EXPECT_THAT(with_format(2), HasSubstr("has no grid 'mask', which its format holds"));
  EXPECT_THAT(with_format(99), HasSubstr("has format 99 and this program reads up to 3; open it "
                                         "with a newer argil"));
  EXPECT_THAT(with_format(0), HasSubstr("has format 0, which no argil ever wrote"));
}

/// The bytes of a project whose description says another number under this name, sealed again.
void write_with_number(const OwnFile& file, std::string bytes, const std::string& name,
                       double number) {
  const std::string key =
      name + '\6' + std::string(3, '\0') + "double" + '\10' + std::string(3, '\0');
  const std::size_t at = bytes.find(key);
  ASSERT_NE(at, std::string::npos);
  bytes.resize(bytes.size() - kSealBytes);
  std::memcpy(bytes.data() + at + key.size(), &number, sizeof number);
  file.write(bytes);
  ASSERT_TRUE(seal_file(file.path()));
}

TEST(ProjectFile, RefusesOptionsThatNoClayCanHave) {
  const OwnFile file;
  ASSERT_TRUE(save_project(file.path(), engraved_ball()));
  const std::string bytes = file.read();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double tolerance : {nan, -0.1, 0.0, 1e308}) {
    write_with_number(file, bytes, "argil_tolerance_voxels", tolerance);
    EXPECT_THAT(error_of(file.path()), HasSubstr("says what no clay can be: tolerance_voxels is "));
  }
  for (const double voxel : {nan, -0.1, 0.0, 1e-6, 1e8, 1e300}) {
    write_with_number(file, bytes, "argil_voxel_mm", voxel);
    EXPECT_THAT(error_of(file.path()), HasSubstr("says what no clay can be: voxel_mm is "));
  }
  write_with_number(file, bytes, "argil_tolerance_voxels", 0.1);
  EXPECT_EQ(error_of(file.path()), "");
  ASSERT_TRUE(save_project(file.path(), ball_with_edges(0.3)));
  const std::string with_edges = file.read();
  for (const double edge : {nan, -0.1, 1e4}) {
    write_with_number(file, with_edges, "argil_edge_radius_mm", edge);
    EXPECT_THAT(error_of(file.path()), HasSubstr("says what no clay can be: edge_radius_mm is "));
  }
}

/// What can be made can be saved, and what was saved can be read.
TEST(ProjectFile, HoldsTheFinestAndTheCoarsestClay) {
  const OwnFile file;
  for (const auto& [radius_mm, voxel_mm] :
       {std::pair{10.0 * kLeastVoxelMm, kLeastVoxelMm}, std::pair{kMaxReachMm, kMostVoxelMm}}) {
    const auto clay = Clay::ball(radius_mm, {voxel_mm, 0.1});
    ASSERT_TRUE(clay) << clay.error().message;
    ASSERT_TRUE(save_project(file.path(), clay.value()));
    const auto loaded = load_project(file.path());
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded.value().hash(), clay.value().hash());
  }
}

/// A node of a coarse level is many of the finest, which int32 must hold.
TEST(ProjectFile, RefusesCoarseLeavesFartherThanTheFinestMayBe) {
  const OwnFile file;
  const Clay ball = engraved_ball();
  const LevelStack& whole = levels_of(ball);
  for (const int node : {kMaxNode >> 1, -(kMaxNode >> 1)}) {
    auto levels = std::make_unique<LevelStack>(ball.options().voxel_mm, whole.count());
    for (int level = 0; level < whole.count(); ++level) {
      levels->grid(level).setTree(whole.grid(level).tree().copy());
    }
    const std::vector<float> values(kLeafNodes, 0.5F * levels->band_mm(levels->top()));
    levels->set_leaf(levels->top(), Coord(0, node, 0), values.data());
    ASSERT_TRUE(save_project(file.path(), clay_of_levels(std::move(levels), ball.options())));
    EXPECT_THAT(error_of(file.path()), HasSubstr("or out of reach; use an older copy"));
  }
}

TEST(ProjectFile, LeavesTheClayAloneWhenSaved) {
  const OwnFile file;
  const Clay clay = engraved_ball();
  const std::uint64_t before = clay.hash();
  ASSERT_TRUE(save_project(file.path(), clay));
  EXPECT_EQ(clay.hash(), before);
  EXPECT_THAT(clay.validate(), testing::IsEmpty());
}

TEST(ProjectFile, KeepsTheOldFileWhenTheDiskDoesNotTakeTheNew) {
  const Clay clay = engraved_ball();
  const auto saved = save_project("no such folder/project.vdb", clay);
  ASSERT_FALSE(saved);
  EXPECT_EQ(saved.error().kind, ErrorKind::disk);
}

}  // namespace
}  // namespace argil::io
