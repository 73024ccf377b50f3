// SPDX-License-Identifier: GPL-3.0-or-later
#include "xml_scan.h"

#include <algorithm>

namespace argil::io {
namespace {

bool is_xml_space(char c) noexcept { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
bool ends_name(char c) noexcept {
  return is_xml_space(c) || c == '/' || c == '>' || c == '=' || c == '<' || c == '"' || c == '\'';
}

}  // namespace

std::int64_t XmlScan::line() const noexcept {
  const std::string_view before = text_.substr(0, at_);
  return 1 + std::count(before.begin(), before.end(), '\n');
}

XmlScan::Event XmlScan::fail(const char* problem) {
  problem_ = problem;
  return Event::error;
}

bool XmlScan::skip_past(std::string_view mark) {
  const std::size_t found = text_.find(mark, at_);
  if (found == std::string_view::npos) return false;
  at_ = found + mark.size();
  return true;
}

void XmlScan::skip_blanks() noexcept {
  while (at_ < text_.size() && is_xml_space(text_[at_])) ++at_;
}

std::string_view XmlScan::take_name() noexcept {
  const std::size_t begin = at_;
  while (at_ < text_.size() && !ends_name(text_[at_])) ++at_;
  return text_.substr(begin, at_ - begin);
}

std::string_view XmlScan::attribute(std::string_view name) const noexcept {
  for (const Attribute& attribute : attributes_) {
    if (attribute.name == name) return attribute.value;
  }
  return {};
}

bool XmlScan::take_attribute() {
  Attribute attribute;
  attribute.name = take_name();
  attribute.name.remove_prefix(attribute.name.rfind(':') + 1);  // npos + 1 is 0
  skip_blanks();
  if (attribute.name.empty() || at_ >= text_.size() || text_[at_] != '=') return false;
  ++at_;
  skip_blanks();
  if (at_ >= text_.size() || (text_[at_] != '"' && text_[at_] != '\'')) return false;
  const std::size_t close = text_.find(text_[at_], at_ + 1);
  if (close == std::string_view::npos) return false;
  attribute.value = text_.substr(at_ + 1, close - at_ - 1);
  attributes_.push_back(attribute);
  at_ = close + 1;
  return true;
}

XmlScan::Event XmlScan::open_tag() {
  const std::string_view whole = take_name();
  name_ = whole.substr(whole.rfind(':') + 1);
  if (name_.empty()) return fail("an element has no name");
  attributes_.clear();
  for (;;) {
    skip_blanks();
    if (at_ >= text_.size()) return fail("the text ends within an element");
    if (text_[at_] == '>') {
      ++at_;
      break;
    }
    if (text_.substr(at_).starts_with("/>")) {
      at_ += 2;
      close_pending_ = true;
      break;
    }
    if (!take_attribute()) return fail("an attribute is not of the form name=\"value\"");
  }
  open_.push_back(whole);
  seen_root_ = true;
  return Event::open;
}

XmlScan::Event XmlScan::close_tag() {
  const std::string_view whole = take_name();
  skip_blanks();
  if (at_ >= text_.size() || text_[at_] != '>') return fail("a closing tag does not end");
  ++at_;
  if (open_.empty() || open_.back() != whole) return fail("a closing tag fits no open element");
  open_.pop_back();
  name_ = whole.substr(whole.rfind(':') + 1);
  return Event::close;
}

XmlScan::Event XmlScan::next() {
  if (close_pending_) {
    close_pending_ = false;
    open_.pop_back();
    return Event::close;
  }
  for (;;) {
    at_ = std::min(text_.find('<', at_), text_.size());
    if (at_ == text_.size()) {
      if (!open_.empty() || !seen_root_) return fail("the text ends with elements still open");
      return Event::end;
    }
    const std::string_view rest = text_.substr(++at_);
    if (rest.starts_with('/')) {
      ++at_;
      return close_tag();
    }
    if (!rest.starts_with('!') && !rest.starts_with('?')) return open_tag();
    const bool skipped = rest.starts_with("!--")        ? (at_ += 3, skip_past("-->"))
                         : rest.starts_with("![CDATA[") ? skip_past("]]>")
                         : rest.starts_with('?')        ? skip_past("?>")
                                                        : skip_past(">");
    if (!skipped) return fail("a comment or declaration does not end");
  }
}

}  // namespace argil::io
