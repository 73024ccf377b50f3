// SPDX-License-Identifier: GPL-3.0-or-later
// Masks by outlines as lines of a script.
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/io/session.h"
#include "argil/io/stroke_script.h"

#include "support/scratch.h"

namespace argil {
namespace {

using testing::HasSubstr;

class ScriptOutline : public testing::Test {
 protected:
  Result<io::StrokeScript> read(const std::string& line) {
    std::ofstream(folder_ / "s.jsonl") << "{\"argil_strokes\":1}\n" << line << "\n";
    return io::read_stroke_script(folder_ / "s.jsonl");
  }
  std::string refusal(const std::string& line) {
    const auto script = read(line);
    return script ? std::string() : script.error().message;
  }
  test::ScratchFolder folder_;
};

TEST_F(ScriptOutline, IsReadWithAllItsKeys) {
  const auto script =
      read(R"({"mask":"outline","position_mm":[1,2,3],"orientation":[0,1,0,0],"parallel":true,)"
           R"("loops":[[[0,0],[1,0],[0,1.5]]],"frees":true,"front_only":true})");
  ASSERT_TRUE(script.ok()) << script.error().message;
  const auto& outline = std::get<MaskOutline>(script.value().steps.at(0));
  EXPECT_EQ(outline.view.eye_mm, (Vec3{1, 2, 3}));
  EXPECT_EQ(outline.view.orientation, (Quat{0, 1, 0, 0}));
  EXPECT_TRUE(outline.view.is_parallel && outline.frees && outline.front_only);
  ASSERT_EQ(outline.loops.size(), 1U);
  EXPECT_EQ(outline.loops[0][2], (PicturePoint{0.0, 1.5}));
}

TEST_F(ScriptOutline, IsRefusedByLineAndKey) {
  EXPECT_THAT(refusal(R"({"mask":"outline"})"), HasSubstr(":2: key 'loops' is missing"));
  EXPECT_THAT(refusal(R"({"mask":"outline","loops":[[[0,0],[1,0],[0]]]})"), HasSubstr("'loops'"));
  EXPECT_THAT(refusal(R"({"mask":"outline","loops":[7]})"), HasSubstr("'loops'"));
  EXPECT_THAT(refusal(R"({"mask":"outline","loops":[[[0,0],[1,0]]]})"), HasSubstr("2 points"));
  EXPECT_THAT(refusal(R"({"mask":"outline","loops":[[[0,0],[1,0],[0,1]]],"frees":1})"),
              HasSubstr("'frees'"));
  EXPECT_THAT(refusal(R"({"mask":"outline","loops":[[[0,0],[1,0],[0,1]]],"other":1})"),
              HasSubstr("'other'"));
}

/// The journal writes it so that a recovery has the same bits.
TEST_F(ScriptOutline, IsRepeatedFromTheJournalToTheBit) {
  MaskOutline outline{{{0.1, -33.3, 0.7}, {0.7, 0.71, 0.01, 0.02}, false},
                      {{{-0.1, -0.1}, {0.12345678901, -0.1}, {0.1, 1.0 / 7.0}}}};
  std::uint64_t hash = 0;
  {
    auto session = io::Session::create(folder_ / "p.vdb",
                                       Clay::ball(10.0, ClayOptions{.voxel_mm = 0.4}).value());
    ASSERT_TRUE(session.ok());
    ASSERT_TRUE(io::apply_step(session.value().sculpture(), outline).ok());
    session.value().record(outline);
    outline.frees = true;
    outline.front_only = true;
    outline.view.orientation = {1.4, 1.42, 0.02, 0.04};
    outline.loops[0][0] = {-0.05, 0.0};
    ASSERT_TRUE(io::apply_step(session.value().sculpture(), outline).ok());
    session.value().record(outline);
    ASSERT_TRUE(session.value().flush().ok());
    hash = session.value().sculpture().hash();
  }
  auto opened = io::Session::open(folder_ / "p.vdb");
  ASSERT_TRUE(opened.ok()) << opened.error().message;
  EXPECT_EQ(opened.value().recovered_steps(), 2);
  EXPECT_EQ(opened.value().sculpture().hash(), hash);
  EXPECT_TRUE(opened.value().sculpture().clay().has_mask());
}

}  // namespace
}  // namespace argil
