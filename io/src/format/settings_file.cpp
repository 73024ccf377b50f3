// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/settings_file.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string_view>
#include <utility>

#include "argil/core/no_throw.h"

#include "file/file_bytes.h"
#include "format/json_read.h"

namespace argil::io {
namespace {

constexpr std::size_t kMostSettingsBytes = 1'000'000;
constexpr const char* kSettingsKinds = "must be a text in quotes, a number, true or false";

/// Walks through a text and counts its lines in a number outside, which copies share.
class LineCounter {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  LineCounter(const char* at, int& line) : at_(at), line_(&line) {}
  reference operator*() const { return *at_; }
  LineCounter& operator++() {
    if (*at_ == '\n') ++*line_;
    ++at_;
    return *this;
  }
  friend bool operator==(const LineCounter& a, const LineCounter& b) { return a.at_ == b.at_; }
  friend bool operator!=(const LineCounter& a, const LineCounter& b) { return a.at_ != b.at_; }

 private:
  const char* at_;
  int* line_;
};

/// Takes what the parser finds, which stops at the first thing that is wrong.
class SettingsTaker final : public nlohmann::json_sax<Json> {
 public:
  SettingsTaker(std::string_view text, const int& line) : text_(text), line_(line) {}

  std::vector<SettingsEntry> take() { return std::move(entries_); }
  const std::string& problem() const noexcept { return problem_; }
  int problem_line() const noexcept { return problem_line_; }

  bool null() override { return fail(std::string("null is no value; it ") + kSettingsKinds); }
  bool boolean(bool value) override { return put(value); }
  bool number_integer(number_integer_t value) override { return put(static_cast<double>(value)); }
  bool number_unsigned(number_unsigned_t value) override { return put(static_cast<double>(value)); }
  bool number_float(number_float_t value, const string_t&) override { return put(value); }
  bool string(string_t& value) override { return put(std::move(value)); }
  bool binary(binary_t&) override { return fail("not JSON"); }  // no text has any
  bool start_array(std::size_t) override {
    return fail(std::string("a list is no value; it ") + kSettingsKinds);
  }
  bool end_array() override { return true; }

  bool start_object(std::size_t) override {
    if (++depth_ <= 1) return true;
    if (depth_ > 2) return fail("a section in a section; put it beside the other one");
    assert(!entries_.empty());
    // What was taken for a name names a section.
    section_ = std::move(entries_.back().name);
    entries_.pop_back();
    return true;
  }
  bool end_object() override {
    if (--depth_ == 1) section_.clear();
    return true;
  }

  bool key(string_t& name) override {
    const bool is_known = std::any_of(entries_.begin(), entries_.end(),
                                      [&](const SettingsEntry& one) {
                                        return one.section == section_ && one.name == name;
                                      }) ||
                          (section_.empty() && std::any_of(entries_.begin(), entries_.end(),
                                                           [&](const SettingsEntry& one) {
                                                             return one.section == name;
                                                           }));
    if (is_known) return fail("\"" + name + "\" stands there twice; keep one of them");
    entries_.push_back({section_, name, false, line_});
    return true;
  }

  bool parse_error(std::size_t byte, const std::string&, const Json::exception& fault) override {
    constexpr int kNumberOverflow = 406;  // nlohmann's number for it
    if (fault.id == kNumberOverflow) return fail("a number is too large; it must be finite");
    // The parser may have read the end of the line by now.
    const std::string_view before =
        text_.substr(0, std::min(text_.size(), byte > 0 ? byte - 1 : 0));
    fail("not JSON; it must be one complete object {...}, with a comma between entries");
    problem_line_ = 1 + static_cast<int>(std::count(before.begin(), before.end(), '\n'));
    return false;
  }

 private:
  bool fail(std::string problem) {
    problem_ = std::move(problem);
    problem_line_ = line_;
    return false;
  }

  template <class Value>
  bool put(Value&& value) {
    if (depth_ == 0) return fail("no object; it must be one complete object {...}");
    entries_.back().value = std::forward<Value>(value);
    return true;
  }

  std::string_view text_;
  const int& line_;
  std::vector<SettingsEntry> entries_;
  std::string section_;
  int depth_ = 0;
  std::string problem_;
  int problem_line_ = 0;
};

std::string at_line(const std::filesystem::path& file, int line) {
  return file.string() + ":" + std::to_string(line) + ": ";
}

std::string value_text(const SettingsEntry& entry) {
  const auto as_json = [](const auto& value) { return Json(value); };
  const Json value = std::visit(as_json, entry.value);
  assert(!value.is_number_float() || std::isfinite(value.get<double>()));
  // Bytes that are no UTF-8, as of a file's name, could not be read again.
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string name_text(const std::string& name) {
  return Json(name).dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

Result<std::vector<SettingsEntry>> read_settings_file(const std::filesystem::path& file) {
  return no_throw(file.string(), [&]() -> Result<std::vector<SettingsEntry>> {
    const auto bytes = read_file_bytes(file);
    if (!bytes) return bytes.error();
    if (bytes.value().size() > kMostSettingsBytes) {
      return Error{ErrorKind::bad_input,
                   file.string() + " has " + std::to_string(bytes.value().size()) +
                       " bytes; settings have at most 1000000: is it another file?"};
    }
    const std::string_view text(reinterpret_cast<const char*>(bytes.value().data()),
                                bytes.value().size());
    int line = 1;
    SettingsTaker taker(text, line);
    if (!Json::sax_parse(LineCounter(text.data(), line),
                         LineCounter(text.data() + text.size(), line), &taker)) {
      return Error{ErrorKind::bad_input, at_line(file, taker.problem_line()) + taker.problem()};
    }
    return taker.take();
  });
}

std::string settings_text(std::span<const SettingsEntry> entries) {
  std::string text = "{";
  std::string section;
  bool is_first = true;
  const auto begin_line = [&](std::size_t indent) {
    text.append(is_first ? "\n" : ",\n").append(indent, ' ');
    is_first = false;
  };
  const auto end_section = [&] {
    if (!section.empty()) text.append("\n  }");
    is_first = false;
  };
  for (const SettingsEntry& entry : entries) {
    if (entry.section != section) {
      end_section();
      section = entry.section;
      if (!section.empty()) {
        begin_line(2);
        text.append(name_text(section)).append(": {");
        is_first = true;
      }
    }
    begin_line(section.empty() ? 2 : 4);
    text.append(name_text(entry.name)).append(": ").append(value_text(entry));
  }
  end_section();
  return text + "\n}\n";
}

Error settings_error(const std::filesystem::path& file, const SettingsEntry& entry,
                     const std::string& what) {
  return {ErrorKind::bad_input, at_line(file, entry.line) + what};
}

}  // namespace argil::io
