// SPDX-License-Identifier: GPL-3.0-or-later
#include "format/xml_scan.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace argil::io {
namespace {

/// Gives a text so many bytes at a time.
XmlScan::TakePiece in_pieces(std::string_view text, std::size_t size) {
  return [text, size](std::string& to) mutable {
    const std::string_view piece = text.substr(0, size);
    to += piece;
    text.remove_prefix(piece.size());
    return !piece.empty();
  };
}

/// What a scan says, an event in each string, with the value of the attribute `a`.
std::vector<std::string> events_of(XmlScan xml) {
  std::vector<std::string> events;
  for (;;) {
    switch (xml.next()) {
      case XmlScan::Event::open:
        events.push_back("+" + std::string(xml.name()) + " " + std::string(xml.attribute("a")));
        break;
      case XmlScan::Event::close:
        events.push_back("-" + std::string(xml.name()));
        break;
      case XmlScan::Event::end:
        events.push_back("end in line " + std::to_string(xml.line()));
        return events;
      case XmlScan::Event::error:
        events.push_back("line " + std::to_string(xml.line()) + ": " + xml.problem());
        return events;
    }
  }
}

constexpr std::string_view kText =
    "<?xml version=\"1.0\"?>\n<!DOCTYPE x>\n<!-- <a> -- > -->\n"
    "<n:one n:a='1 > 0'>text<two a=\"2\" />\n<![CDATA[<three>]]]></n:one\n>\n<!-- end -->";

TEST(XmlScan, SaysTheSameHoweverTheTextIsCutIntoPieces) {
  const std::vector<std::string> whole = events_of(XmlScan(in_pieces(kText, kText.size())));
  EXPECT_THAT(whole, testing::ElementsAre("+one 1 > 0", "+two 2", "-two", "-one", "end in line 7"));
  for (std::size_t size = 1; size < kText.size(); ++size) {
    EXPECT_EQ(events_of(XmlScan(in_pieces(kText, size))), whole) << size;
  }
}

TEST(XmlScan, EndsInAnErrorWhereverTheTextIsCutOff) {
  const std::size_t last = kText.rfind("<!-- end");
  for (std::size_t size = 0; size + 2 < last; ++size) {
    const std::string cut(kText.substr(0, size));
    EXPECT_THAT(events_of(XmlScan(in_pieces(cut, 7))).back(), testing::StartsWith("line ")) << cut;
  }
}

/// A gigabyte of comment, and one of elements: what has been read is forgotten.
TEST(XmlScan, HoldsAPieceOfALongText) {
  const auto longest_held = [](const std::string& piece, std::size_t times) {
    std::size_t longest = 0;
    XmlScan xml([&, n = std::size_t{0}](std::string& text) mutable {
      if (n > times) return false;
      text += n == 0 ? "<all><!-- " : n == times ? "--></all>" : piece;
      longest = std::max(longest, text.size());
      ++n;
      return true;
    });
    while (xml.next() != XmlScan::Event::end) EXPECT_EQ(xml.problem(), "");
    return longest;
  };
  EXPECT_LT(longest_held(std::string(100'000, 'x'), 1000), 1'000'000U);
  std::string elements = "-->";
  for (int i = 0; i < 10'000; ++i) elements += "<v/>";
  EXPECT_LT(longest_held(elements + "<!--", 100), 1'000'000U);
}

TEST(XmlScan, RefusesWhatNoProgramWrites) {
  std::string deep;
  for (std::size_t i = 0; i <= XmlScan::kDeepestElement; ++i) deep += "<a>";
  EXPECT_THAT(events_of(XmlScan(in_pieces(deep, 100))).back(), testing::HasSubstr("256 deep"));
  const std::string tag = "<a b='" + std::string(2 * XmlScan::kLongestTag, 'x') + "'/>";
  EXPECT_THAT(events_of(XmlScan(in_pieces(tag, 4096))).back(), testing::StartsWith("line 1: "));
}

}  // namespace
}  // namespace argil::io
