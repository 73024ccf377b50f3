// SPDX-License-Identifier: GPL-3.0-or-later
#include "format/xml_scan.h"

#include <algorithm>

namespace argil::io {
namespace {

/// Text that was read is dropped in pieces of this size: dropping each tag by itself would move the
/// rest of the buffer every time.
constexpr std::size_t kForgetBytes = 1 << 18;

bool is_xml_space(char c) noexcept { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
bool ends_name(char c) noexcept {
  return is_xml_space(c) || c == '/' || c == '>' || c == '=' || c == '<' || c == '"' || c == '\'';
}

/// A byte holds the count of so many: of whole registers, which std::count does not use.
std::int64_t count_lines(std::string_view text) noexcept {
  constexpr std::size_t kAtOnce = 192;
  std::int64_t count = 0;
  while (!text.empty()) {
    const std::string_view front = text.substr(0, kAtOnce);
    std::uint8_t lines = 0;
    for (const char c : front) lines = static_cast<std::uint8_t>(lines + (c == '\n' ? 1 : 0));
    count += lines;
    text.remove_prefix(front.size());
  }
  return count;
}

}  // namespace

std::int64_t XmlScan::line() const noexcept {
  return 1 + lines_before_ + count_lines(std::string_view(text_).substr(0, at_));
}

XmlScan::Event XmlScan::fail(const std::string& problem) {
  problem_ = problem;
  return Event::error;
}

void XmlScan::forget_read() {
  // Its lines still count for messages.
  lines_before_ = line() - 1;
  text_.erase(0, at_);
  at_ = 0;
}

bool XmlScan::skip_past(std::string_view mark) {
  for (;;) {
    const std::size_t found = text_.find(mark, at_);
    if (found != std::string::npos) {
      at_ = found + mark.size();
      return true;
    }
    // The end of the buffer may hold the first letters of the mark.
    at_ = std::max(at_, text_.size() - std::min(text_.size(), mark.size() - 1));
    forget_read();
    if (!take_(text_)) return false;
  }
}

void XmlScan::skip_blanks() noexcept {
  while (at_ < text_.size() && is_xml_space(text_[at_])) ++at_;
}

std::string_view XmlScan::take_name() noexcept {
  const std::size_t begin = at_;
  while (at_ < text_.size() && !ends_name(text_[at_])) ++at_;
  return std::string_view(text_).substr(begin, at_ - begin);
}

std::string_view XmlScan::attribute(std::string_view name) const noexcept {
  for (const Attribute& attribute : attributes_) {
    if (attribute.name == name) return attribute.value;
  }
  return {};
}

bool XmlScan::is_plain(const PlainForm& form, std::array<std::string_view, 3>& values) noexcept {
  if (close_pending_ || open_.size() == kDeepestElement) return false;
  skip_blanks();
  std::string_view rest = std::string_view(text_).substr(at_);
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (!rest.starts_with(form[n])) return false;
    rest.remove_prefix(form[n].size());
    const std::size_t end = std::min(rest.find('"'), rest.size());
    values[n] = rest.substr(0, end);
    rest.remove_prefix(end);
  }
  if (!rest.starts_with(form.back())) return false;
  rest.remove_prefix(form.back().size());
  if (rest.starts_with(' ')) rest.remove_prefix(1);
  if (!rest.starts_with("/>")) return false;
  plain_end_ = text_.size() - rest.size() + 2;
  return true;
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
  if (close == std::string::npos) return false;
  attribute.value = std::string_view(text_).substr(at_ + 1, close - at_ - 1);
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
    if (text_.compare(at_, 2, "/>") == 0) {
      at_ += 2;
      close_pending_ = true;
      break;
    }
    if (!take_attribute()) return fail("an attribute is not of the form name=\"value\"");
  }
  if (open_.size() == kDeepestElement) {
    return fail("elements stand in one another more than " + std::to_string(kDeepestElement) +
                " deep");
  }
  open_.emplace_back(whole);
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
  while (find_tag()) {
    const char kind = text_[at_ + 1];
    if (kind != '!' && kind != '?') return whole_tag();
    if (!skip_declaration()) return fail("a comment or declaration does not end");
  }
  const bool is_cut = at_ < text_.size() || !open_.empty() || !seen_root_;
  return is_cut ? fail("the text ends with elements still open") : Event::end;
}

/// To the next '<', with enough behind it to tell what it begins. False at the end of the text.
bool XmlScan::find_tag() {
  constexpr std::size_t kLongestBegin = 9;  // <![CDATA[
  for (;;) {
    at_ = std::min(text_.find('<', at_), text_.size());
    if (at_ >= kForgetBytes) forget_read();
    if (text_.size() - at_ >= kLongestBegin) return true;
    if (!take_(text_)) return text_.size() - at_ >= 2;
  }
}

bool XmlScan::skip_declaration() {
  const std::string_view tag = std::string_view(text_).substr(at_);
  const std::string_view mark = tag.starts_with("<!--")        ? "-->"
                                : tag.starts_with("<![CDATA[") ? "]]>"
                                : tag.starts_with("<?")        ? "?>"
                                                               : ">";
  at_ += mark == "-->" ? 4 : 2;
  return skip_past(mark);
}

/// The tag that begins here; what looks wrong with it may be that only its front has come.
XmlScan::Event XmlScan::whole_tag() {
  const std::size_t begin = at_;
  for (;;) {
    const bool closes = text_[begin + 1] == '/';
    at_ = begin + (closes ? 2 : 1);
    const Event event = closes ? close_tag() : open_tag();
    if (event != Event::error) return event;
    if (text_.size() - begin > kLongestTag || !take_(text_)) return event;
  }
}

}  // namespace argil::io
