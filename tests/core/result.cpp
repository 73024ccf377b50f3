// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/core/result.h"

#include <memory>

#include <gtest/gtest.h>

namespace argil {
namespace {

Result<int> half(int number) {
  if (number % 2 != 0) return Error{ErrorKind::bad_input, "odd"};
  return number / 2;
}

TEST(Result, HoldsAValue) {
  const auto result = half(8);
  ASSERT_TRUE(result.ok());
  EXPECT_TRUE(static_cast<bool>(result));
  EXPECT_EQ(result.value(), 4);
}

TEST(Result, HoldsAnError) {
  const auto result = half(7);
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().kind, ErrorKind::bad_input);
  EXPECT_EQ(result.error().message, "odd");
}

TEST(Result, MovesAValueThatCannotBeCopied) {
  Result<std::unique_ptr<int>> result = std::make_unique<int>(5);
  const std::unique_ptr<int> taken = std::move(result).value();
  EXPECT_EQ(*taken, 5);
}

TEST(Result, TellsValueFromErrorOfTheSameType) {
  EXPECT_TRUE((Result<std::string, Error>(std::string("text")).ok()));
}

TEST(ResultOfNothing, IsSuccessByDefault) {
  EXPECT_TRUE(Result<void>{}.ok());
  const Result<void> failed = Error{ErrorKind::disk, "full"};
  EXPECT_FALSE(failed.ok());
  EXPECT_EQ(failed.error().kind, ErrorKind::disk);
}

}  // namespace
}  // namespace argil
