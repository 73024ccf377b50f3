// SPDX-License-Identifier: GPL-3.0-or-later
#include "vdb/vdb_read.h"

#include <cmath>
#include <csignal>
#include <memory>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <openvdb/tools/LevelSetUtil.h>
#include <tbb/global_control.h>

#include "argil/io/project_file.h"
#include "argil/io/safe_file.h"

#include "clay/tree_walk.h"
#include "file/file_seal.h"
#include "support/effort.h"
#include "support/scratch.h"
#include "vdb/vdb_tree.h"
#include "vdb/vdb_write.h"

namespace argil::io {
namespace {

using testing::HasSubstr;

VdbGrid::Ptr sphere(float radius, const openvdb::Vec3f& center) {
  return openvdb::tools::createLevelSetSphere<VdbGrid>(radius, center, 0.5F);
}

/// As OpenVDB writes them where grids have their offsets, which its streams to memory do not.
std::string written(const openvdb::GridCPtrVec& grids, std::uint32_t compression) {
  openvdb::initialize();
  const test::ScratchFolder folder;
  openvdb::io::File file((folder / "a.vdb").string());
  file.setCompression(compression);
  openvdb::MetaMap meta;
  meta.insertMeta("name", openvdb::StringMetadata("some"));
  meta.insertMeta("size", openvdb::DoubleMetadata(0.25));
  meta.insertMeta("box", openvdb::Vec3IMetadata({1, 2, 3}));
  file.write(grids, meta);
  file.close();
  return test::content_of(folder / "a.vdb");
}

/// Makes an OpenVDB tree of what it is handed.
class VdbTreeSink final : public LevelSink {
 public:
  explicit VdbTreeSink(VdbTree& tree) : tree_(tree) {}

  void add_tile(const NodeCoord& origin, float value, bool is_active) override {
    tree_.root().addTile(coord_of(origin), value, is_active);
  }

  void add_branch(const StoredBranch& branch) override {
    if (branch.is_lower()) {
      auto* upper = tree_.probeNode<VdbUpperNode>(coord_of(branch.origin));
      upper->addChild(node_of<VdbLowerNode>(branch).release());
    } else {
      tree_.root().addChild(node_of<VdbUpperNode>(branch).release());
    }
  }

  std::vector<float*> add_leaves(std::span<const StoredLeaf> leaves) override {
    std::vector<float*> values;
    for (const StoredLeaf& stored : leaves) {
      VdbLeaf* const leaf = tree_.touchLeaf(coord_of(stored.origin));
      VdbLeaf::NodeMaskType active;
      for (openvdb::Index word = 0; word < VdbLeaf::NodeMaskType::WORD_COUNT; ++word) {
        active.getWord<openvdb::Index64>(word) = stored.active[word];
      }
      leaf->setValueMask(active);
      values.push_back(leaf->buffer().data());
    }
    filled_.assign(leaves.size(), 0);
    return values;
  }

  void leaf_is_filled(std::size_t n) override { ++filled_[n]; }
  const std::vector<int>& filled() const { return filled_; }

 private:
  template <class Node>
  std::unique_ptr<Node> node_of(const StoredBranch& branch) const {
    const auto is_set = [](std::span<const std::uint64_t> mask, std::size_t bit) {
      return (mask[bit / 64] >> (bit % 64) & 1U) != 0;
    };
    auto node = std::make_unique<Node>(coord_of(branch.origin), tree_.background(), false);
    for (openvdb::Index n = 0; n < Node::NUM_VALUES; ++n) {
      if (!is_set(branch.children, n)) {
        node->addTile(n, branch.values[n], is_set(branch.active, n));
      }
    }
    return node;
  }

  VdbTree& tree_;
  std::vector<int> filled_;  ///< how often each leaf was said to be filled
};

/// What a file says, and its grids as OpenVDB has them.
struct ReadBack {
  openvdb::MetaMap meta;
  struct Named {
    std::string name;
    VdbGrid::Ptr grid;  ///< null where it was not read
  };
  std::vector<Named> grids;
};

Result<ReadBack> read(const std::string& bytes) {
  struct Taken {
    VdbGrid::Ptr grid;
    std::unique_ptr<VdbTreeSink> sink;
  };
  std::vector<Taken> taken;
  const auto content =
      read_vdb(std::as_bytes(std::span(bytes)),
               [&](const openvdb::MetaMap&, const GridHead& head) -> LevelSink* {
                 const auto grid = VdbGrid::create(head.background);
                 grid->setName(head.name);
                 grid->setTransform(head.transform);
                 taken.push_back({grid, std::make_unique<VdbTreeSink>(grid->tree())});
                 return taken.back().sink.get();
               });
  if (!content) return content.error();
  for (const Taken& one : taken) EXPECT_THAT(one.sink->filled(), testing::Each(1));
  ReadBack back{content.value().meta, {}};
  auto next = taken.begin();
  for (const NamedGrid& named : content.value().grids) {
    back.grids.push_back({named.name, named.is_read ? (next++)->grid : nullptr});
  }
  EXPECT_EQ(next, taken.end());
  return back;
}

void expect_same(const VdbGrid& a, const VdbGrid& b) {
  ASSERT_TRUE(a.tree().hasSameTopology(b.tree()));
  EXPECT_EQ(a.background(), b.background());
  EXPECT_EQ(a.transform(), b.transform());
  auto ours = a.tree().cbeginValueAll();
  for (auto theirs = b.tree().cbeginValueAll(); theirs; ++theirs, ++ours) {
    ASSERT_TRUE(ours);
    ASSERT_EQ(*ours, *theirs) << ours.getCoord();
    ASSERT_EQ(ours.getCoord(), theirs.getCoord());
    ASSERT_EQ(ours.isValueOn(), theirs.isValueOn());
  }
  EXPECT_FALSE(ours);
}

/// Grids whose nodes have inactive values of every kind that OpenVDB tells apart.
std::vector<VdbGrid::Ptr> all_kinds() {
  std::vector<VdbGrid::Ptr> grids{sphere(5.0F, {0.0F, 0.0F, 0.0F}),
                                  sphere(7.0F, {-2048.0F, 1024.0F, 3.0F})};
  VdbGrid::Ptr fog = grids[0]->deepCopy();
  openvdb::tools::sdfToFogVolume(*fog);
  grids.push_back(fog);
  VdbGrid::Ptr other = VdbGrid::create(2.0F);
  other->setTransform(openvdb::math::Transform::createLinearTransform(0.3));
  const auto put = [&](const Coord& at, float value, bool is_on) {
    if (is_on) {
      other->tree().setValueOn(at, value);
    } else {
      other->tree().setValueOff(at, value);
    }
  };
  for (int n = 0; n < 8 * 8; ++n) {
    put({n, 0, 0}, 0.5F, true);        // one other inactive value, many active ones
    put({n, 8, 0}, 7.0F, n % 3 == 0);  // background or another
    put({n, 16, 0}, n % 2 == 0 ? 3.0F : 4.0F, n % 5 == 0);  // two others and the background
    put({n, 24, 0}, n % 2 == 0 ? 2.0F : -2.0F, n % 7 == 0);
    for (int j = 32; j < 40; ++j) {
      for (int k = 0; k < 8; ++k) put({n, j, k}, k % 2 == 0 ? 3.0F : 4.0F, j % 2 == 0);
    }
  }
  other->tree().addTile(1, Coord(0, 0, 64), 5.0F, true);
  other->tree().addTile(2, Coord(0, 0, 256), -1.0F, false);
  other->tree().addTile(3, Coord(4096, 0, 0), 6.0F, true);
  other->tree().addTile(3, Coord(-4096, 0, 0), -6.0F, false);
  grids.push_back(other);
  grids.push_back(VdbGrid::create(1.0F));
  for (std::size_t n = 0; n < grids.size(); ++n) grids[n]->setName("grid " + std::to_string(n));
  return grids;
}

TEST(ReadVdb, HasTheBitsThatOpenVdbWrote) {
  const auto grids = all_kinds();
  const openvdb::GridCPtrVec all(grids.begin(), grids.end());
  for (const std::uint32_t compression :
       {0U, 1U, 2U, 3U, 4U, 6U}) {  // none, zip and blosc, each with and without the active mask
    SCOPED_TRACE(compression);
    const auto content = read(written(all, compression));
    ASSERT_TRUE(content) << content.error().message;
    EXPECT_EQ(content.value().meta.metaValue<std::string>("name"), "some");
    EXPECT_EQ(content.value().meta.metaValue<double>("size"), 0.25);
    EXPECT_FALSE(content.value().meta["box"]) << "of a type that is not used";
    ASSERT_EQ(content.value().grids.size(), grids.size());
    for (std::size_t n = 0; n < grids.size(); ++n) {
      EXPECT_EQ(content.value().grids[n].name, grids[n]->getName());
      ASSERT_TRUE(content.value().grids[n].grid);
      expect_same(*content.value().grids[n].grid, *grids[n]);
    }
  }
}

TEST(ReadVdb, LeavesOutWhatIsOfAnotherType) {
  const auto mask = openvdb::BoolGrid::create(false);
  mask->tree().setValueOn(Coord(1, 2, 3));
  mask->setName("mask");
  const auto stretched = sphere(5.0F, {0.0F, 0.0F, 0.0F});
  stretched->setTransform(openvdb::math::Transform::createLinearTransform(
      openvdb::math::Mat4d(1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 1)));
  stretched->setName("stretched");
  const auto round = sphere(5.0F, {0.0F, 0.0F, 0.0F});
  round->setName("round");
  const auto content = read(written({mask, stretched, round}, 6));
  ASSERT_TRUE(content) << content.error().message;
  ASSERT_EQ(content.value().grids.size(), 3U);
  EXPECT_FALSE(content.value().grids[0].grid);
  EXPECT_FALSE(content.value().grids[1].grid);
  ASSERT_TRUE(content.value().grids[2].grid);
  expect_same(*content.value().grids[2].grid, *round);
}

TEST(ReadVdb, RefusesEveryTruncationAndSaysWhere) {
  const std::string whole = written({sphere(3.0F, {0.0F, 0.0F, 0.0F})}, 6);
  ASSERT_TRUE(read(whole));
  const std::size_t step = test::effort<std::size_t>(97, 7);
  for (std::size_t size = 0; size < whole.size(); size += size < 1000 ? 1 : step) {
    const auto cut = read(whole.substr(0, size));
    ASSERT_FALSE(cut) << size;
    EXPECT_THAT(cut.error().message, HasSubstr("(byte ")) << size;
  }
}

/// Bytes changed, numbers replaced by extremes, pieces cut, repeated and swapped: whatever comes
/// out is a tree of finite numbers, or refused.
TEST(ReadVdbProperty, IsHarmedByNoMutant) {
  const auto grids = all_kinds();
  std::vector<std::string> sound;
  for (const std::uint32_t compression : {0U, 3U, 6U}) {
    sound.push_back(written({grids[0], grids[3]}, compression));
  }
  std::mt19937_64 random(1);
  const auto below = [&](std::size_t end) { return random() % end; };
  int read_whole = 0;
  const int mutants = test::effort(600, 20'000);
  for (int n = 0; n < mutants; ++n) {
    std::string mutant = sound[below(sound.size())];
    const std::size_t changes = 1 + below(4);
    for (std::size_t change = 0; change < changes; ++change) {
      // Half of them in the first bytes, where lengths and offsets stand.
      const std::size_t at = below(below(2) == 0 ? 2000 : mutant.size() - 16);
      switch (below(5)) {
        case 0:
          mutant[at] = static_cast<char>(random());
          break;
        case 1: {
          constexpr std::uint64_t kExtremes[] = {
              0,          1,          0x7fffffff, 0x80000000, 0xffffffff,           ~0ULL,
              1ULL << 63, 0x7f800000, 0x7fc00000, 1ULL << 40, 0x7ff0000000000000ULL};
          const std::uint64_t number = kExtremes[below(std::size(kExtremes))];
          std::memcpy(mutant.data() + at, &number, below(2) == 0 ? 4 : 8);
          break;
        }
        case 2:
          mutant.erase(at, 1 + below(64));
          break;
        case 3:
          mutant.insert(at, mutant.substr(below(mutant.size()), 1 + below(64)));
          break;
        default:
          std::swap(mutant[at], mutant[below(mutant.size())]);
      }
    }
    const auto content = read(mutant);
    if (!content) continue;
    ++read_whole;
    for (const ReadBack::Named& named : content.value().grids) {
      if (!named.grid) continue;
      for (auto value = named.grid->tree().cbeginValueAll(); value; ++value) {
        ASSERT_TRUE(std::isfinite(*value));
      }
    }
  }
  EXPECT_GT(read_whole, mutants / 100) << "some reach the values";
}

// ---- writing -----------------------------------------------------------------------------------

/// As write_vdb writes them.
std::string written_by_us(const std::vector<VdbGrid::Ptr>& grids) {
  const test::ScratchFolder folder;
  std::vector<GridToWrite> shown;
  for (const VdbGrid::Ptr& grid : grids) {
    shown.push_back({grid->getName(), grid->getGridClass(), grid->voxelSize()[0],
                     grid->background(),
                     [grid](LevelVisitor& to) { show_tree(grid->tree(), to); }});
  }
  openvdb::MetaMap meta;
  meta.insertMeta("name", openvdb::StringMetadata("some"));
  const auto done = write_vdb(folder / "a.vdb", meta, 7, shown);
  EXPECT_TRUE(done) << done.error().message;
  return test::content_of(folder / "a.vdb");
}

TEST(WriteVdb, IsReadByOpenVdbAndByUs) {
  openvdb::initialize();
  const auto grids = all_kinds();
  const std::string bytes = written_by_us(grids);
  const auto ours = read(bytes);
  ASSERT_TRUE(ours) << ours.error().message;
  const test::ScratchFolder folder;
  test::fill(folder / "a.vdb", bytes);
  openvdb::io::File file((folder / "a.vdb").string());
  file.open();
  EXPECT_EQ(file.getMetadata()->metaValue<std::string>("name"), "some");
  const auto theirs = file.getGrids();
  ASSERT_EQ(theirs->size(), grids.size());
  for (std::size_t n = 0; n < grids.size(); ++n) {
    SCOPED_TRACE(n);
    expect_same(*ours.value().grids[n].grid, *grids[n]);
    const auto grid = openvdb::gridPtrCast<VdbGrid>((*theirs)[n]);
    ASSERT_TRUE(grid);
    expect_same(*grid, *grids[n]);
    EXPECT_EQ(grid->getGridClass(), grids[n]->getGridClass());
    EXPECT_EQ(grid->metaValue<openvdb::Int64>("file_voxel_count"),
              static_cast<openvdb::Int64>(grids[n]->activeVoxelCount()));
    const openvdb::CoordBBox box = grids[n]->evalActiveVoxelBoundingBox();
    EXPECT_EQ(grid->metaValue<openvdb::Vec3i>("file_bbox_min"), box.min().asVec3i());
    EXPECT_EQ(grid->metaValue<openvdb::Vec3i>("file_bbox_max"), box.max().asVec3i());
  }
}

/// What compresses well is no larger than OpenVDB makes it, nor is what does not.
TEST(WriteVdb, IsNoLargerThanOpenVdbsFiles) {
  for (const VdbGrid::Ptr& grid : all_kinds()) {
    EXPECT_LE(written_by_us({grid}).size(), written({grid}, 6).size());
  }
}

/// Whoever comes after the interrupt is told, also where it comes between two looks.
TEST(WriteVdb, StopsInTheMiddle) {
  install_interrupt_cleanup();
  const test::ScratchFolder folder;
  int shown = 0;
  GridToWrite grid{"a", openvdb::GRID_LEVEL_SET, 0.5, 1.5F, [&](LevelVisitor&) {
                     if (++shown == 2) std::raise(SIGINT);
                   }};
  const auto done = write_vdb(folder / "a.vdb", {}, 1, std::vector<GridToWrite>{grid, grid, grid});
  forget_interrupt();
  EXPECT_EQ(shown, 2);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().kind, ErrorKind::interrupted);
}

TEST(WriteVdb, TellsWhenTheDiskDoesNotTakeIt) {
  const auto done = write_vdb("/dev/full", {}, 0, {});
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().kind, ErrorKind::disk);
}

TEST(WriteVdbGolden, HasTheSameBytesForAnyNumberOfThreads) {
  std::string first;
  for (const std::size_t threads : {1U, 2U, 7U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const std::string bytes = written_by_us({sphere(40.0F, {0.0F, 0.0F, 0.0F})});
    if (first.empty()) first = bytes;
    EXPECT_TRUE(bytes == first) << threads << " threads";
  }
}

}  // namespace
}  // namespace argil::io
