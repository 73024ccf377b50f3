// SPDX-License-Identifier: GPL-3.0-or-later
#include "format/xml_scan.h"

#include <algorithm>
#include <array>
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

/// The same values whether plain elements are passed or not, wherever the text is cut; what is not
/// quite plain is left to next().
TEST(XmlScan, PassesPlainElementsAsNextReadsThem) {
  constexpr XmlScan::PlainForm kForm{"<v x=\"", "\" y=\"", "\" z=\"", "\""};
  constexpr std::string_view kElements =
      "<all>\n <v x=\"1\" y=\"2\" z=\"3\"/>\n<v x=\"4\" y=\"\" z=\"6\" /><v x='7' y='8' z='9'/>"
      "<v x=\"a\" y=\"b\" z=\"c\" w=\"d\"/><v x=\"e\" y=\"f\" z=\"g\"></v><v y=\"i\" x=\"h\" "
      "z=\"j\"/>"
      "<!-- --><v x=\"k\" y=\"l\" z=\"m\"/></all>";
  const auto values_of = [&](std::size_t size, bool passes, std::size_t& passed) {
    XmlScan xml(in_pieces(kElements, size));
    std::vector<std::string> all;
    const auto add = [&](std::string_view x, std::string_view y, std::string_view z) {
      all.push_back(std::string(x) + " " + std::string(y) + " " + std::string(z));
    };
    for (;;) {
      std::array<std::string_view, 3> values;
      while (passes && xml.is_plain(kForm, values)) {
        add(values[0], values[1], values[2]);
        xml.pass_plain();
        ++passed;
      }
      const XmlScan::Event event = xml.next();
      if (event == XmlScan::Event::open && xml.name() == "v") {
        add(xml.attribute("x"), xml.attribute("y"), xml.attribute("z"));
      }
      if (event == XmlScan::Event::end) return all;
      if (event == XmlScan::Event::error) return std::vector{xml.problem()};
    }
  };
  std::size_t passed = 0;
  const auto told = values_of(kElements.size(), false, passed);
  EXPECT_THAT(told,
              testing::ElementsAre("1 2 3", "4  6", "7 8 9", "a b c", "e f g", "h i j", "k l m"));
  EXPECT_EQ(values_of(kElements.size(), true, passed), told);
  EXPECT_EQ(passed, 2U);  // behind a comment next() comes first
  for (std::size_t size = 1; size < kElements.size(); ++size) {
    EXPECT_EQ(values_of(size, true, passed), told) << size;
  }
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
