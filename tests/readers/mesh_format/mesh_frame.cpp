// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/mesh_frame.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/io/mesh_file.h"

#include "support/scratch.h"
#include "support/shapes.h"

namespace argil::io {
namespace {

using test::ScratchFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A box that neither rests on an axis' zero nor is too small to be likely.
TriangleMesh likely_box() { return test::box_mesh({20, 30, 40}); }

FramedMesh read_back(const ScratchFolder& folder, const std::string& name, const TriangleMesh& mesh,
                     const MeshFrame& wanted = {}) {
  EXPECT_TRUE(write_mesh(folder / name, mesh));
  auto read = read_framed_mesh(folder / name, wanted);
  EXPECT_TRUE(read) << read.error().message;
  return read ? std::move(read).value() : FramedMesh();
}

TEST(MeshFrame, LeavesEveryBitWhereNothingIsSaid) {
  const ScratchFolder folder;
  for (const std::string name : {"a.obj", "a.stl", "a.ply", "a.glb", "a.3mf"}) {
    const FramedMesh framed = read_back(folder, name, likely_box());
    EXPECT_EQ(framed.mesh.positions, read_mesh(folder / name).value().positions) << name;
    EXPECT_THAT(frame_doubts(folder / name, framed.frame), IsEmpty()) << name;
    const bool states = name == "a.glb" || name == "a.3mf";
    EXPECT_EQ(framed.frame.unit_source, states ? FrameSource::file : FrameSource::assumed) << name;
    EXPECT_EQ(framed.frame.unit, name == "a.glb" ? LengthUnit::m : LengthUnit::mm) << name;
    EXPECT_EQ(framed.frame.up, name == "a.glb" ? UpAxis::y : UpAxis::z) << name;
  }
}

TEST(MeshFrame, MultipliesByTheUnitThatIsGiven) {
  const ScratchFolder folder;
  for (const auto& [unit, mm] :
       std::vector<std::pair<LengthUnit, double>>{{LengthUnit::mm, 1.0},
                                                  {LengthUnit::cm, 10.0},
                                                  {LengthUnit::m, 1000.0},
                                                  {LengthUnit::in, 25.4}}) {
    for (const std::string name : {"a.obj", "a.stl", "a.ply", "a.3mf"}) {
      const FramedMesh framed = read_back(folder, name, likely_box(), {unit, {}});
      EXPECT_NEAR(framed.frame.largest_side_mm, 40.0 * mm, 1e-9 * mm) << name;
      EXPECT_EQ(framed.frame.unit_source, FrameSource::given);
    }
    // A GLB's numbers are 0.04 and metres, unless somebody says what they are.
    const FramedMesh glb = read_back(folder, "a.glb", likely_box(), {unit, {}});
    EXPECT_NEAR(glb.frame.largest_side_mm, 0.04 * mm, 1e-6 * mm);
  }
}

TEST(MeshFrame, TurnsYUpToZUpExactly) {
  const ScratchFolder folder;
  TriangleMesh mesh = likely_box();
  mesh.positions[0] = {1.25, 2.5, 3.75};
  for (const std::string name : {"a.obj", "a.ply", "a.3mf"}) {
    const FramedMesh framed = read_back(folder, name, mesh, {{}, UpAxis::y});
    EXPECT_EQ(framed.mesh.positions[0], (Vec3{1.25, -3.75, 2.5})) << name;
    EXPECT_EQ(framed.frame.up_source, FrameSource::given);
  }
  // As if a GLB's numbers had z up: x, y and z as they stand in the file.
  const FramedMesh upright = read_back(folder, "a.glb", mesh, {{}, UpAxis::z});
  EXPECT_NEAR(length(upright.mesh.positions[0] - Vec3{1.25, 3.75, -2.5}), 0.0, 1e-9);
  EXPECT_NEAR(signed_volume(upright.mesh), signed_volume(mesh), 1e-6);
}

TEST(MeshFrame, RefusesWhatAUnitTakesBeyondAKilometre) {
  const ScratchFolder folder;
  EXPECT_TRUE(write_mesh(folder / "a.stl", test::box_mesh({20, 30, 4000})));
  const auto read = read_framed_mesh(folder / "a.stl", {LengthUnit::m, {}});
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().kind, ErrorKind::bad_input);
  EXPECT_THAT(read.error().message, HasSubstr("a.stl: in m, a coordinate of vertex 1 is 2e+06 mm"));
}

TEST(MeshFrame, TellsAUnitThatTheSizeSpeaksFor) {
  const ScratchFolder folder;
  const auto guess = [&](double side, const std::string& name, const MeshFrame& wanted = {}) {
    return read_back(folder, name, test::box_mesh({side, side, side}), wanted)
        .frame.unit_looks_like;
  };
  EXPECT_EQ(guess(0.15, "a.obj"), LengthUnit::m);
  EXPECT_EQ(guess(2.0, "a.stl"), LengthUnit::in);
  EXPECT_EQ(guess(3.5, "a.ply"), std::nullopt);
  EXPECT_EQ(guess(0.15, "a.3mf"), std::nullopt);
  EXPECT_EQ(guess(0.15, "a.obj", {LengthUnit::mm, {}}), std::nullopt);
  EXPECT_EQ(guess(12'000.0, "a.glb"), LengthUnit::mm);
  EXPECT_EQ(guess(12'000.0, "a.3mf"), std::nullopt);
  FrameReport frame;
  frame.unit_looks_like = LengthUnit::m;
  frame.largest_side_mm = 0.15;
  EXPECT_THAT(frame_doubts("a.obj", frame),
              ElementsAre("'a.obj' states no unit, and in mm it is 0.15 mm across; if its numbers "
                          "are m (150 mm), give --unit m"));
}

/// A cone with its axis along y, on its base or on its tip.
TriangleMesh cone(bool on_tip) {
  constexpr int kSides = 16;
  TriangleMesh mesh;
  mesh.positions = {{0, on_tip ? 0.0 : 30.0, 0}, {0, on_tip ? 30.0 : 0.0, 0}};
  for (int n = 0; n < kSides; ++n) {
    const double angle = 2.0 * 3.14159265358979 * n / kSides;
    mesh.positions.push_back({10.0 * std::cos(angle), on_tip ? 30.0 : 0.0, 10.0 * std::sin(angle)});
  }
  for (std::uint32_t n = 0; n < kSides; ++n) {
    const std::uint32_t a = 2 + n;
    const std::uint32_t b = 2 + (n + 1) % kSides;
    mesh.triangles.push_back(on_tip ? Triangle{0, a, b} : Triangle{0, b, a});
    mesh.triangles.push_back(on_tip ? Triangle{1, b, a} : Triangle{1, a, b});
  }
  return mesh;
}

TEST(MeshFrame, TellsAMeshThatStandsAlongY) {
  const ScratchFolder folder;
  for (const bool on_tip : {false, true}) {
    const FramedMesh framed = read_back(folder, "a.obj", cone(on_tip));
    EXPECT_GT(signed_volume(framed.mesh), 0.0);
    EXPECT_EQ(framed.frame.up_looks_like, UpAxis::y) << on_tip;
    EXPECT_THAT(frame_doubts("a.obj", framed.frame),
                ElementsAre("'a.obj' does not say which axis is up, and was read with z up, but "
                            "looks as if it stands along y; if so, give --up y"));
    // Turned, it stands as it should; nor is anybody doubted who says what is up.
    EXPECT_EQ(
        read_back(folder, "b.obj", read_framed_mesh(folder / "a.obj", {{}, UpAxis::y}).value().mesh)
            .frame.up_looks_like,
        std::nullopt);
    EXPECT_EQ(read_back(folder, "a.obj", cone(on_tip), {{}, UpAxis::z}).frame.up_looks_like,
              std::nullopt);
  }
}

}  // namespace
}  // namespace argil::io
