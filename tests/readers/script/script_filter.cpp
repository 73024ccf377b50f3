// SPDX-License-Identifier: GPL-3.0-or-later
// Edits of the mask that look at the surface, as lines of a script.
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/io/session.h"
#include "argil/io/stroke_script.h"

#include "support/scratch.h"
#include "support/stroke_maker.h"

namespace argil {
namespace {

using testing::HasSubstr;

class ScriptFilter : public testing::Test {
 protected:
  Result<io::StrokeScript> read(const std::string& line) {
    std::ofstream(folder_ / "s.jsonl") << "{\"argil_strokes\":1}\n" << line << "\n";
    return io::read_stroke_script(folder_ / "s.jsonl");
  }
  MaskFilter filter_of(const std::string& line) {
    const auto script = read(line);
    EXPECT_TRUE(script.ok()) << script.error().message;
    return script ? std::get<MaskFilter>(script.value().steps.at(0)) : MaskFilter{};
  }
  std::string refusal(const std::string& line) {
    const auto script = read(line);
    return script ? std::string() : script.error().message;
  }
  test::ScratchFolder folder_;
};

TEST_F(ScriptFilter, IsReadWithAllItsKeys) {
  EXPECT_EQ(std::get<MaskGrow>(filter_of(R"({"mask":"grow","by_mm":1.5})")).by_mm, 1.5);
  EXPECT_EQ(std::get<MaskGrow>(filter_of(R"({"mask":"shrink","by_mm":0.25})")).by_mm, -0.25);
  const auto usual = std::get<MaskCavity>(filter_of(R"({"mask":"cavity","radius_mm":2})"));
  EXPECT_EQ(usual.radius_mm, 2.0);
  EXPECT_EQ(usual.factor, 1.0);
  EXPECT_FALSE(usual.is_inverted);
  const auto cavity = std::get<MaskCavity>(
      filter_of(R"({"mask":"cavity","radius_mm":0.7,"factor":-3,"inverted":true})"));
  EXPECT_EQ(cavity.radius_mm, 0.7);
  EXPECT_EQ(cavity.factor, -3.0);
  EXPECT_TRUE(cavity.is_inverted);
}

TEST_F(ScriptFilter, IsRefusedByLineAndKey) {
  EXPECT_THAT(refusal(R"({"mask":"grow"})"), HasSubstr(":2: key 'by_mm' is missing"));
  EXPECT_THAT(refusal(R"({"mask":"grow","by_mm":0})"), HasSubstr("key 'by_mm' is 0"));
  EXPECT_THAT(refusal(R"({"mask":"shrink","by_mm":-1})"), HasSubstr("key 'by_mm' is -1"));
  EXPECT_THAT(refusal(R"({"mask":"grow","by_mm":1e300})"), HasSubstr("by_mm of the mask"));
  EXPECT_THAT(refusal(R"({"mask":"grow","by_mm":1,"radius_mm":1})"), HasSubstr("'radius_mm'"));
  EXPECT_THAT(refusal(R"({"mask":"cavity"})"), HasSubstr("key 'radius_mm' is missing"));
  EXPECT_THAT(refusal(R"({"mask":"cavity","radius_mm":1,"factor":"x"})"), HasSubstr("'factor'"));
  EXPECT_THAT(refusal(R"({"mask":"cavity","radius_mm":1,"factor":0})"), HasSubstr("factor of"));
  EXPECT_THAT(refusal(R"({"mask":"cavity","radius_mm":1,"inverted":1})"), HasSubstr("'inverted'"));
  EXPECT_THAT(refusal(R"({"mask":"cavity","radius_mm":1,"by_mm":1})"), HasSubstr("'by_mm'"));
}

/// The journal writes it so that a recovery has the same bits.
TEST_F(ScriptFilter, IsRepeatedFromTheJournalToTheBit) {
  std::uint64_t hash = 0;
  {
    auto session = io::Session::create(folder_ / "p.vdb",
                                       Clay::ball(10.0, ClayOptions{.voxel_mm = 0.4}).value());
    ASSERT_TRUE(session.ok());
    const auto sculpt = [&](const io::ScriptStep& step) {
      ASSERT_TRUE(io::apply_step(session.value().sculpture(), step).ok());
      session.value().record(step);
    };
    sculpt(stroke_of(Action::mask, 3.0, 1.0, {{0, 0, 10}, {3, 0, 9.5}}));
    sculpt(MaskFilter(MaskGrow{1.0 / 3.0}));
    sculpt(MaskFilter(MaskGrow{-0.1234567890123}));
    sculpt(MaskEdit::sharpen);
    hash = session.value().sculpture().hash();
    sculpt(MaskFilter(MaskCavity{1.1, -1.0 / 7.0, true}));
    sculpt(io::HistoryStep::undo);
    ASSERT_TRUE(session.value().flush().ok());
  }
  auto opened = io::Session::open(folder_ / "p.vdb");
  ASSERT_TRUE(opened.ok()) << opened.error().message;
  EXPECT_EQ(opened.value().recovered_steps(), 6);
  EXPECT_EQ(opened.value().sculpture().hash(), hash);
  EXPECT_TRUE(opened.value().sculpture().clay().has_mask());
}

}  // namespace
}  // namespace argil
