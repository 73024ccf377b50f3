// SPDX-License-Identifier: GPL-3.0-or-later
#include "file/temporary_name.h"

#include <gtest/gtest.h>

namespace argil::io {
namespace {

TEST(TemporaryName, HasTheTitleOfItsTarget) {
  for (const char* name : {"out/flask.3mf", "flask.2-4.3mf", ".hidden.3mf", "a.b.3mf"}) {
    const std::filesystem::path target = name;
    const std::filesystem::path temporary = temporary_name(target);
    EXPECT_NE(temporary.filename(), target.filename());
    EXPECT_EQ(temporary.parent_path(), target.parent_path());
    EXPECT_EQ(temporary.extension(), target.extension());
    EXPECT_EQ(title_of(temporary), target.stem().string());
    EXPECT_EQ(title_of(target), target.stem().string());
  }
}

}  // namespace
}  // namespace argil::io
