// SPDX-License-Identifier: GPL-3.0-or-later
#include "format/json_read.h"

#include <cstddef>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace argil::io {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string repeated(const std::string& text, std::size_t times) {
  std::string all;
  all.reserve(text.size() * times);
  for (std::size_t n = 0; n < times; ++n) all += text;
  return all;
}

/// A list in a list and so on under the key "a" of an object.
std::string nested_lists(std::size_t deep) {
  return "{\"a\":" + repeated("[", deep) + repeated("]", deep) + "}";
}

std::string refusal_of_json(const std::string& text) {
  const auto read = read_json_object(text, "f.json:3");
  if (read) return "accepted";
  EXPECT_EQ(read.error().kind, ErrorKind::bad_input);
  EXPECT_THAT(read.error().message, StartsWith("f.json:3: "));
  return read.error().message;
}

TEST(ReadJson, BuildsTheValueThatItsLibraryDoes) {
  const std::string text =
      R"( {"a":[1,-2,3.5e-7,true,false,null,[],{}],"b":{"a":{"a":[[{"x":"\u00e9\n"}]]},"":18446744073709551615}} )";
  const auto read = read_json_object(text, "f");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read.value(), Json::parse(text));
  EXPECT_EQ(read.value().dump(), Json::parse(text).dump());
}

TEST(ReadJson, TakesWhatNestsToTheLimitAndNothingDeeper) {
  EXPECT_EQ(refusal_of_json(nested_lists(kDeepestJson - 1)), "accepted");
  EXPECT_THAT(refusal_of_json(nested_lists(kDeepestJson)), HasSubstr("nests more than 64 deep"));
  for (const char* open : {"[", "{\"a\":"}) {
    const std::string deep = repeated(open, 1'000'000);  // overflowed the stack when it was shown
    EXPECT_THAT(refusal_of_json(deep), HasSubstr("nests more than 64 deep"));
    EXPECT_THAT(refusal_of_json("{\"a\":" + deep), HasSubstr("nests more than 64 deep"));
  }
  EXPECT_THAT(refusal_of_json(nested_lists(200'000)), HasSubstr("nests more than 64 deep"));
}

TEST(ReadJson, SaysWhatIsWrongAndWhere) {
  EXPECT_THAT(refusal_of_json("{\"a\":1,}"), HasSubstr("column 8: not JSON"));
  EXPECT_THAT(refusal_of_json(""), HasSubstr("not JSON"));
  EXPECT_THAT(refusal_of_json("{} {}"), HasSubstr("not JSON"));
  EXPECT_THAT(refusal_of_json("{\"a\":\"\xff\"}"), HasSubstr("not JSON"));
  EXPECT_THAT(refusal_of_json("{\"a\":1e999}"), HasSubstr("too large to represent"));
  EXPECT_THAT(refusal_of_json("{\"a\":1,\"b\":{\"a\":2,\"a\":3}}"),
              HasSubstr("key 'a' appears twice; keep one of them"));
  EXPECT_THAT(refusal_of_json("[1,2]"), HasSubstr("is [1,2]; must be a JSON object {...}"));
  EXPECT_THAT(refusal_of_json("[" + repeated("1,", 100) + "1]"),
              HasSubstr("1,1,1...; must be a JSON object"));
}

/// With nlohmann's own callback each of them had all before it looked through: two minutes.
TEST(ReadJson, ReadsAListOfManyObjects) {
  constexpr std::size_t kMany = 300'000;
  const auto read = read_json_object("{\"a\":[" + repeated("{},", kMany) + "{}]}", "f");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read.value().at("a").size(), kMany + 1);
}

}  // namespace
}  // namespace argil::io
