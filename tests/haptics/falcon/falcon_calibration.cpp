// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/falcon/falcon_calibration.h"

#include <string>

#include <gtest/gtest.h>

#include "support/scratch.h"

namespace argil::haptics {
namespace {

constexpr const char* kHead = "argil_falcon_calibration = 1\nset = libnifalcon\n";

Result<FalconCalibration> parse(const std::string& text) {
  return parse_falcon_calibration(text, "cal.txt");
}

std::string calibration_refusal(const std::string& text) {
  const auto parsed = parse(text);
  if (parsed.ok()) return "";
  EXPECT_EQ(parsed.error().kind, ErrorKind::bad_input);
  return parsed.error().message;
}

void expect_same_calibration(const FalconCalibration& a, const FalconCalibration& b) {
  const FalconGeometry& g = a.geometry;
  const FalconGeometry& h = b.geometry;
  EXPECT_EQ(g.arm_mm, h.arm_mm);
  EXPECT_EQ(g.rod_mm, h.rod_mm);
  EXPECT_EQ(g.stub_mm, h.stub_mm);
  EXPECT_EQ(g.hinge_radial_mm, h.hinge_radial_mm);
  EXPECT_EQ(g.joint_radial_mm, h.joint_radial_mm);
  EXPECT_EQ(g.hinge_tangential_mm, h.hinge_tangential_mm);
  EXPECT_EQ(g.joint_tangential_mm, h.joint_tangential_mm);
  EXPECT_EQ(g.leg_deg, h.leg_deg);
  EXPECT_EQ(g.counts_per_turn, h.counts_per_turn);
  EXPECT_EQ(g.gear_ratio, h.gear_ratio);
  EXPECT_EQ(g.tick_zero_deg, h.tick_zero_deg);
  EXPECT_EQ(g.words_per_nm, h.words_per_nm);
  EXPECT_EQ(a.center_mm, b.center_mm);
  EXPECT_EQ(a.pulled_out_mm, b.pulled_out_mm);
  EXPECT_EQ(a.gravity_n, b.gravity_n);
  EXPECT_EQ(a.mass_kg, b.mass_kg);
  EXPECT_EQ(a.damping_n_s_per_m, b.damping_n_s_per_m);
}

/// What is installed says in the file what the program has built in, to the last bit.
TEST(FalconCalibration, TheShippedFilesAreTheNamedSets) {
  for (const std::string set : {"libnifalcon", "martin-hillier"}) {
    SCOPED_TRACE(set);
    const auto read = read_falcon_calibration("haptics/calibration/" + set + ".txt");
    ASSERT_TRUE(read.ok()) << read.error().message;
    const auto named = named_falcon_calibration(set);
    ASSERT_TRUE(named.ok());
    expect_same_calibration(read.value(), named.value());
    // and none of it comes from the set's name
    std::string text = test::content_of("haptics/calibration/" + set + ".txt");
    const std::string other = set == "libnifalcon" ? "martin-hillier" : "libnifalcon";
    text.replace(text.find("set = " + set), 6 + set.size(), "set = " + other);
    const auto renamed = parse(text);
    ASSERT_TRUE(renamed.ok());
    expect_same_calibration(renamed.value(), named.value());
  }
  EXPECT_FALSE(named_falcon_calibration("novint").ok());
}

TEST(FalconCalibration, ReadsCommentsBlanksAndWindowsLines) {
  const auto read = parse(
      "\n# a device\n  argil_falcon_calibration=1\r\n\tset = martin-hillier # of 2009\r\n\r\n"
      "gravity_n = 0, 0.5 ,-1e-3\r\nmass_kg = 0.5");
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read.value().gravity_n, (Vec3{0.0, 0.5, -1e-3}));
  EXPECT_EQ(read.value().mass_kg, 0.5);
  EXPECT_EQ(read.value().geometry.gear_ratio, 7.62);
}

TEST(FalconCalibration, NamesTheLineAndWhatItMustBe) {
  const std::string head = kHead;
  const std::pair<std::string, std::string> all[] = {
      {"", "must begin with"},
      {"argil_falcon_calibration = 1\n", "must begin with"},
      {"set = libnifalcon\n", "cal.txt:1: must be 'argil_falcon_calibration = 1'"},
      {"argil_falcon_calibration = 2\n", "cal.txt:1: must be"},
      {"argil_falcon_calibration = 1\narm_mm = 60\n", "cal.txt:2: must be 'set ="},
      {"argil_falcon_calibration = 1\nset = novint\n", "must be libnifalcon or martin-hillier"},
      {head + "arm_mm 60\n", "cal.txt:3: must be 'key = value'"},
      {head + "arm_mm = 60\narm_mm = 60\n", "cal.txt:4: 'arm_mm' stands twice"},
      {head + "arm = 60\n", "cal.txt:3: 'arm' is no key"},
      {head + "arm_mm = 60 mm\n", "'arm_mm' is '60 mm'; must be a number from 10 to 200"},
      {head + "arm_mm = nan\n", "must be a number"},
      {head + "arm_mm = inf\n", "must be a number"},
      {head + "arm_mm =\n", "must be a number"},
      {head + "arm_mm = 1,2\n", "must be a number"},
      {head + "words_per_nm = 0\n", "must be a number from 100 to 100000"},
      {head + "leg_deg = 1, 2\n", "three numbers parted by commas"},
      {head + "gravity_n = 0, 9, 0\n", "each from -3 to 3"},
      {head + "rod_mm = 30\n", "cannot reach its center_mm"},
      {head + "pulled_out_mm = 60\n", "pulled out further than its arm reaches"},
      {head + std::string(70000, '#'), "longer than 64 KiB"},
  };
  for (const auto& [text, said] : all) {
    EXPECT_NE(calibration_refusal(text).find(said), std::string::npos) << calibration_refusal(text);
  }
}

TEST(FalconCalibration, NamesAFileThatCannotBeRead) {
  const auto read = read_falcon_calibration("no such file.txt");
  ASSERT_FALSE(read.ok());
  EXPECT_NE(read.error().message.find("no such file.txt"), std::string::npos);
  EXPECT_FALSE(read_falcon_calibration(".").ok());
}

}  // namespace
}  // namespace argil::haptics
