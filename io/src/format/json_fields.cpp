// SPDX-License-Identifier: GPL-3.0-or-later
// Reads keys of a JSON object with messages that say line, key and remedy; a misspelt key gets the
// nearest known one.
#include "format/json_fields.h"

#include <algorithm>
#include <vector>

namespace argil::io {
namespace {

/// Letters to insert, delete or change to get from `a` to `b`.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  // Levenshtein's table, a row at a time.
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, change});
    }
  }
  return row[b.size()];
}

std::string_view nearest(std::string_view word, NameList known) {
  constexpr std::size_t kLongest = 64;  // a key may be as long as the file
  word = word.substr(0, kLongest);
  return *std::min_element(known.begin(), known.end(), [&](auto a, auto b) {
    return edit_distance(word, a) < edit_distance(word, b);
  });
}

std::string quoted_list(Names known) {
  std::string text;
  for (const std::string_view name : known) {
    text += (text.empty() ? "'" : ", '") + std::string(name) + "'";
  }
  return text;
}

}  // namespace

std::string FileLine::name() const { return line == 0 ? file : file + ":" + std::to_string(line); }

Error FileLine::error(const std::string& what) const {
  return {ErrorKind::bad_input, name() + ": " + what};
}

Error FileLine::key_error(std::string_view key, const std::string& what) const {
  return error("key '" + std::string(key) + "' " + what);
}

Result<Json> parse_object(const FileLine& where, std::string_view line) {
  return read_json_object(line, where.name());
}

Result<void> Fields::only(NameList known) const {
  for (const auto& [key, value] : object_.items()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    return where_.key_error(
        prefix_ + key, "is not known; did you mean '" + std::string(nearest(key, known)) + "'?");
  }
  return {};
}

Error Fields::wrong(const char* key, const std::string& must) const {
  return where_.key_error(prefix_ + key, "is " + shown(object_.at(key)) + "; must be " + must);
}

Error Fields::missing(const char* key, const std::string& remedy) const {
  return where_.key_error(prefix_ + key, "is missing; " + remedy);
}

Result<void> Fields::number(const char* key, double& out) const {
  if (!has(key)) return {};
  if (!at(key).is_number()) return wrong(key, "a number");
  out = at(key).get<double>();
  return {};
}

Result<void> Fields::positive(const char* key, double& out) const {
  if (auto read = number(key, out); !read || !has(key)) return read;
  if (!(out > 0.0)) return wrong(key, "greater than 0");
  return {};
}

Result<void> Fields::flag(const char* key, bool& out) const {
  if (!has(key)) return {};
  if (!at(key).is_boolean()) return wrong(key, "true or false");
  out = at(key).get<bool>();
  return {};
}

Result<void> Fields::triple(const char* key, Vec3& out) const {
  if (!has(key)) return {};
  const Json& value = at(key);
  if (!value.is_array() || value.size() != 3) return wrong(key, "three numbers [x, y, z]");
  for (std::size_t a = 0; a < 3; ++a) {
    if (!value[a].is_number()) return wrong(key, "three numbers [x, y, z]");
    out[a] = value[a].get<double>();
  }
  return {};
}

Result<void> Fields::positive_triple(const char* key, Vec3& out) const {
  if (auto read = triple(key, out); !read) return read;
  if (out.x > 0.0 && out.y > 0.0 && out.z > 0.0) return {};
  return wrong(key, "three numbers greater than 0");
}

Result<std::string> Fields::hash(const char* key) const {
  constexpr std::string_view kDigits = "0123456789abcdef";
  if (!has(key)) return missing(key, "give the hash of the content");
  const Json& value = at(key);
  const bool fits =
      value.is_string() && value.get_ref<const std::string&>().size() == 16 &&
      value.get_ref<const std::string&>().find_first_not_of(kDigits) == std::string::npos;
  if (!fits) return wrong(key, "a hash of 16 hexadecimal digits");
  return value.get<std::string>();
}

Result<std::size_t> Fields::choice(const char* key, Names names) const {
  if (!has(key)) return missing(key, "give one of " + quoted_list(names));
  if (!at(key).is_string()) return wrong(key, "one of " + quoted_list(names));
  const auto& text = at(key).get_ref<const std::string&>();
  const auto found = std::find(names.begin(), names.end(), text);
  if (found == names.end()) return wrong(key, "one of " + quoted_list(names));
  return static_cast<std::size_t>(found - names.begin());
}

}  // namespace argil::io
