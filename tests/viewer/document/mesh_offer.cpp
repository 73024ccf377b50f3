// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/mesh_offer.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/io/mesh_file.h"
#include "argil/io/project_file.h"

#include "support/shapes.h"
#include "viewer/document/document_fixture.h"

namespace argil::viewer {
namespace {

using testing::HasSubstr;

/// How many cells a silhouette covers, as a share of all.
double covered(const Silhouette& seen) {
  int cells = 0;
  for (const Silhouette::Run& run : seen.runs) cells += run.end - run.first;
  return static_cast<double>(cells) / (seen.columns * seen.rows);
}

TEST_F(DocumentThreadTest, LooksAtAMeshWithoutTouchingTheClay) {
  thread_.send(NewClay{ball(10.0)});
  settle();
  const auto number = thread_.state().number;
  TriangleMesh mesh = test::ball_mesh(20.0, 4);
  for (Vec3& p : mesh.positions) p.z *= 1.5;
  ASSERT_TRUE(io::write_mesh(folder_ / "egg.stl", mesh).ok());
  thread_.send(LookAtMesh{folder_ / "egg.stl", 7});
  settle();
  EXPECT_TRUE(errors().empty());
  const auto offer = thread_.state().offer;
  ASSERT_NE(offer, nullptr);
  EXPECT_EQ(offer->number, 7);
  EXPECT_EQ(offer->triangles, static_cast<std::int64_t>(mesh.triangles.size()));
  EXPECT_NEAR(offer->size_mm.x, 40.0, 0.1);
  EXPECT_NEAR(offer->size_mm.z, 60.0, 0.1);
  EXPECT_EQ(offer->parts, 1U);
  // A ball fills pi / 4 of its box, seen from anywhere along an axis.
  EXPECT_NEAR(covered(offer->along_y), 0.785, 0.02);
  EXPECT_NEAR(covered(offer->along_z), 0.785, 0.02);
  EXPECT_GT(offer->along_y.rows, offer->along_z.rows);
  EXPECT_EQ(thread_.state().number, number);
}

TEST_F(DocumentThreadTest, SaysWhatIsWrongWithAMeshThatCannotBeOffered) {
  std::ofstream(folder_ / "broken.obj") << "v 0 0 0\nf 1 2 3\n";
  thread_.send(LookAtMesh{folder_ / "broken.obj", 3});
  settle();
  const auto said = errors();
  ASSERT_EQ(said.size(), 1U);
  EXPECT_THAT(said[0], HasSubstr("broken.obj:2"));
  ASSERT_NE(thread_.state().offer, nullptr);
  EXPECT_EQ(thread_.state().offer->number, 3);
  EXPECT_TRUE(thread_.state().offer->file.empty());
}

TEST_F(DocumentThreadTest, ImportsAMeshAsItWasChosen) {
  ASSERT_TRUE(io::write_mesh(folder_ / "box.stl", test::box_mesh({10.0, 20.0, 40.0})).ok());
  ImportMesh wanted{folder_ / "box.stl", {}, true};
  wanted.how.voxel_mm = 1.0;
  wanted.how.preparation.size_mm = 80.0;
  wanted.how.preparation.frame.up = io::UpAxis::y;
  thread_.send(wanted);
  settle();
  EXPECT_TRUE(errors().empty());
  const ClayState state = thread_.state();
  EXPECT_EQ(state.voxel_mm, 1.0);
  const Vec3 size = state.bounds_mm.size();
  constexpr double kRoom = 4.5;  // that the bounds of a clay leave around it
  EXPECT_NEAR(size.x, 20.0, kRoom);
  EXPECT_NEAR(size.y, 80.0, kRoom);
  EXPECT_NEAR(size.z, 40.0, kRoom);
  EXPECT_TRUE(state.is_changed) << "it is nowhere else";
}

TEST_F(DocumentThreadTest, ImportsTheBodiesOfAMeshAsPiecesAndRefusesOpenOnesWhereAsked) {
  const TriangleMesh two =
      test::joined(test::ball_mesh(5.0, 3), test::ball_mesh(8.0, 3, {30.0, 0.0, 0.0}));
  ASSERT_TRUE(io::write_mesh(folder_ / "two.stl", two).ok());
  thread_.send(LookAtMesh{folder_ / "two.stl", 1});
  settle();
  EXPECT_EQ(thread_.state().offer->parts, 2U);
  ImportMesh wanted{folder_ / "two.stl", {}, true};
  wanted.how.voxel_mm = 0.5;
  wanted.how.keeps_parts = true;
  thread_.send(wanted);
  thread_.send(SaveProjectAs{folder_ / "two.vdb"});
  settle();
  EXPECT_TRUE(errors().empty());
  const auto saved = io::load_sculpture(folder_ / "two.vdb");
  ASSERT_TRUE(saved.ok());
  EXPECT_EQ(saved.value().piece_count(), 2U);
  EXPECT_EQ(saved.value().look(0).name, "two 1");

  ASSERT_TRUE(io::write_mesh(folder_ / "open.stl", test::without(two, 0)).ok());
  wanted = {folder_ / "open.stl", {}, true};
  wanted.how.voxel_mm = 0.5;
  wanted.how.preparation.repairs = false;
  thread_.send(wanted);
  settle();
  const auto said = errors();
  ASSERT_EQ(said.size(), 1U);
  EXPECT_THAT(said[0], HasSubstr("open edges"));
  EXPECT_EQ(thread_.state().file, folder_ / "two.vdb") << "what is open stays open";
}

}  // namespace
}  // namespace argil::viewer
