// SPDX-License-Identifier: GPL-3.0-or-later
#include "format/json_read.h"

#include <cassert>
#include <utility>
#include <vector>

namespace argil::io {
namespace {

/// Builds a value as the parser goes, which stops at the first thing that is wrong.
class JsonBuilder final : public nlohmann::json_sax<Json> {
 public:
  const std::string& problem() const noexcept { return problem_; }
  Json take() { return std::move(root_); }

  bool null() override { return put(nullptr); }
  bool boolean(bool value) override { return put(value); }
  bool number_integer(number_integer_t value) override { return put(value); }
  bool number_unsigned(number_unsigned_t value) override { return put(value); }
  bool number_float(number_float_t value, const string_t&) override { return put(value); }
  bool string(string_t& value) override { return put(std::move(value)); }
  bool binary(binary_t&) override { return fail("not JSON"); }  // no text has any
  bool start_object(std::size_t) override { return begin(Json::value_t::object); }
  bool start_array(std::size_t) override { return begin(Json::value_t::array); }
  bool end_object() override { return end(); }
  bool end_array() override { return end(); }

  bool key(string_t& name) override {
    // JSON allows a key twice, of which most readers silently take the last.
    const auto [member, is_new] = open_.back()->get_ref<Json::object_t&>().try_emplace(name);
    member_ = &member->second;
    return is_new || fail("key '" + name + "' appears twice; keep one of them");
  }

  bool parse_error(std::size_t byte, const std::string&, const Json::exception& fault) override {
    constexpr int kNumberOverflow = 406;  // nlohmann's number for it
    if (fault.id == kNumberOverflow) {
      return fail("a number is too large to represent; must be finite");
    }
    return fail("column " + std::to_string(byte) + ": not JSON; must be one complete object {...}");
  }

 private:
  bool fail(std::string problem) {
    problem_ = std::move(problem);
    return false;
  }

  /// Where the next value goes.
  Json& next_value() {
    if (open_.empty()) return root_;
    Json& in = *open_.back();
    assert(in.is_array() || member_ != nullptr);
    return in.is_array() ? in.get_ref<Json::array_t&>().emplace_back() : *member_;
  }

  template <class Value>
  bool put(Value&& value) {
    next_value() = std::forward<Value>(value);
    return true;
  }

  bool begin(Json::value_t kind) {
    if (open_.size() == kDeepestJson) {
      return fail("nests more than " + std::to_string(kDeepestJson) +
                  " deep, which nothing that is read here does");
    }
    Json& value = next_value();
    value = Json(kind);
    open_.push_back(&value);
    return true;
  }

  bool end() {
    assert(!open_.empty());
    open_.pop_back();
    return true;
  }

  Json root_;
  std::vector<Json*> open_;  ///< lists and objects around the next value; they stay where they are
                             ///< until they are closed
  Json* member_ = nullptr;   ///< of the innermost object, whose key was read last
  std::string problem_;
};

}  // namespace

Result<Json> read_json_object(std::string_view text, const std::string& where) {
  const auto bad = [&](const std::string& what) {
    return Error{ErrorKind::bad_input, where + ": " + what};
  };
  JsonBuilder builder;
  if (!Json::sax_parse(text, &builder)) return bad(builder.problem());
  Json value = builder.take();
  if (!value.is_object()) return bad("is " + shown(value) + "; must be a JSON object {...}");
  return value;
}

std::string shown(const Json& value) {
  constexpr std::size_t kLongest = 40;
  std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  if (text.size() > kLongest) text = text.substr(0, kLongest) + "...";
  return text;
}

}  // namespace argil::io
