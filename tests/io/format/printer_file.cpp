// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/printer_file.h"

#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/scratch.h"

namespace argil::io {
namespace {

using testing::HasSubstr;

class PrinterFile : public testing::Test {
 protected:
  std::string refusal(const std::string& text) {
    test::fill(folder_ / "p.json", text);
    const auto read = read_printer(folder_ / "p.json");
    return read ? "accepted" : read.error().message;
  }
  test::ScratchFolder folder_;
};

TEST_F(PrinterFile, OfTheThreeGenericPrintersAreRead) {
  const auto printers = std::filesystem::path("printers");
  const mesh::Printer filament = read_printer(printers / "filament.json").value();
  EXPECT_EQ(filament.name, "filament");
  EXPECT_EQ(filament.max_overhang_deg, 50.0);
  EXPECT_FALSE(filament.needs_drains);
  EXPECT_TRUE(read_printer(printers / "resin.json").value().needs_drains);
  const mesh::Printer service = read_printer(printers / "service.json").value();
  EXPECT_EQ(service.max_triangles, 1'000'000);
  EXPECT_EQ(service.max_file_mb, 64.0);
}

TEST_F(PrinterFile, IsRefusedWithTheKeyAndTheRange) {
  EXPECT_THAT(refusal("{"), HasSubstr("not JSON"));
  EXPECT_THAT(refusal("{\"name\":\"a\"}"), HasSubstr("argil_printer"));
  const std::string deep = std::string(200'000, '[') + std::string(200'000, ']');
  EXPECT_THAT(refusal("{\"argil_printer\":" + deep + "}"), HasSubstr("nests more than 64 deep"));
  EXPECT_THAT(refusal("{\"argil_printer\":2,\"name\":\"a\"}"), HasSubstr("is 2; must be 1"));
  const auto with = [&](const std::string& rest) {
    return refusal("{\"argil_printer\":1,\"name\":\"a\"," + rest + "}");
  };
  EXPECT_THAT(with("\"bed\":[1,2,3]"), HasSubstr("did you mean 'bed_mm'"));
  EXPECT_THAT(with("\"bed_mm\":[1,2,0]"), HasSubstr("greater than 0"));
  EXPECT_THAT(with("\"bed_mm\":[1,1e308,3]"), HasSubstr("at most 1e6"));
  EXPECT_EQ(with("\"bed_mm\":[1,1e6,3]"), "accepted");
  for (const char* key :
       {"min_wall_mm", "min_gap_mm", "min_part_mm3", "max_triangles", "max_file_mb"}) {
    const std::string name = std::string("\"") + key + "\":";
    EXPECT_THAT(with(name + "1e308"), HasSubstr("is 1e+308; must be")) << key;
    EXPECT_THAT(with(name + "NaN"), HasSubstr("not JSON")) << key;
    EXPECT_THAT(with(name + "1e999"), HasSubstr("must be finite")) << key;
  }
  EXPECT_THAT(with("\"min_wall_mm\":-1"), HasSubstr("is -1; must be"));
  EXPECT_THAT(with("\"max_overhang_deg\":90"), HasSubstr("below 90"));
  EXPECT_THAT(with("\"needs_drains\":1"), HasSubstr("true or false"));
  EXPECT_THAT(with("\"max_triangles\":1e300"), HasSubstr("must be"));
  EXPECT_EQ(with("\"max_file_mb\":0"), "accepted");
  EXPECT_FALSE(read_printer(folder_ / "gone.json").ok());
}

}  // namespace
}  // namespace argil::io
