// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/mesh_offer.h"

#include <cmath>
#include <cstdint>
#include <fstream>
#include <numbers>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/io/mesh_file.h"
#include "argil/io/project_file.h"

#include "document/document_worker.h"
#include "support/scratch.h"
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

TEST_F(DocumentThreadTest, RefusesToOfferAMeshWithoutExtent) {
  std::ofstream(folder_ / "point.obj") << "v 1 2 3\nv 1 2 3\nv 1 2 3\nf 1 2 3\n";
  thread_.send(LookAtMesh{folder_ / "point.obj", 1});
  settle();
  const auto said = errors();
  ASSERT_EQ(said.size(), 1U);
  EXPECT_THAT(said[0], HasSubstr("point.obj"));
  EXPECT_THAT(said[0], HasSubstr("0 mm across"));
  EXPECT_TRUE(thread_.state().offer->file.empty());
}

TEST(MeshOffers, ShowTheOutlineOfThinTrianglesWithoutGaps) {
  const test::ScratchFolder folder;
  // A disk that stands, as a fan of slivers about a point of its rim.
  constexpr int kSides = 900;
  TriangleMesh disk;
  for (int n = 0; n < kSides; ++n) {
    const double angle = 2.0 * std::numbers::pi * n / kSides;
    disk.positions.push_back({10.0 * std::cos(angle), 0.0, 10.0 * std::sin(angle)});
  }
  for (std::uint32_t n = 1; n + 1 < kSides; ++n) disk.triangles.push_back({0, n, n + 1});
  ASSERT_TRUE(io::write_mesh(folder / "disk.stl", disk).ok());
  const auto offer = look_at_mesh(folder / "disk.stl");
  ASSERT_TRUE(offer.ok()) << offer.error().message;
  EXPECT_NEAR(covered(offer.value().along_y), 0.785, 0.02);
  EXPECT_EQ(offer.value().along_y.runs.size(), 160U) << "one a row";
  EXPECT_EQ(offer.value().along_z.runs.size(), 1U) << "a line";
}

TEST(MeshOffers, StopWhenToldTo) {
  const test::ScratchFolder folder;
  ASSERT_TRUE(io::write_mesh(folder / "ball.stl", test::ball_mesh(20.0, 4)).ok());
  int told = 0;
  const auto stopped =
      look_at_mesh(folder / "ball.stl", [&](std::string_view, double) { return ++told < 4; });
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().kind, ErrorKind::interrupted);
  EXPECT_EQ(told, 4);
}

TEST(MeshOffers, AreMadeOnlyOfTheMeshThatWasAskedForLast) {
  const test::ScratchFolder folder;
  std::ofstream(folder / "broken.obj") << "v 0 0 0\nf 1 2 3\n";
  ASSERT_TRUE(io::write_mesh(folder / "ball.stl", test::ball_mesh(20.0, 2)).ok());
  Outbox outbox;
  DocumentWorker worker(outbox, folder.path());
  outbox.want_look(2);
  worker.perform(LookAtMesh{folder / "broken.obj", 1});
  EXPECT_TRUE(outbox.take_notices().empty());
  worker.perform(LookAtMesh{folder / "ball.stl", 2});
  worker.show();
  ASSERT_NE(outbox.state().offer, nullptr);
  EXPECT_EQ(outbox.state().offer->number, 2);
  EXPECT_EQ(outbox.state().offer->file, folder / "ball.stl");
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
