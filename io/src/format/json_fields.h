// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

#include "argil/core/result.h"
#include "argil/core/vec3.h"

#include "format/json_read.h"

namespace argil::io {

using Names = std::span<const std::string_view>;
using NameList = std::initializer_list<std::string_view>;

/// A line of a file, which messages point to.
struct FileLine {
  std::string file;
  int line = 0;  ///< counted from 1; 0: of no file, and messages name `file` alone

  std::string name() const;
  Error error(const std::string& what) const;
  Error key_error(std::string_view key, const std::string& what) const;
};

/// One line as a JSON object (json_read.h).
Result<Json> parse_object(const FileLine& where, std::string_view line);

/// One JSON object of a script and the keys it may have.
class Fields {
 public:
  Fields(const FileLine& where, const Json& object, std::string prefix = {})
      : where_(where), object_(object), prefix_(std::move(prefix)) {}

  Result<void> only(NameList known) const;
  bool has(const char* key) const { return object_.contains(key); }
  const Json& at(const char* key) const { return object_.at(key); }

  Error wrong(const char* key, const std::string& must) const;
  Error missing(const char* key, const std::string& remedy) const;

  /// Leaves `out` alone when the key is absent.
  Result<void> number(const char* key, double& out) const;
  Result<void> positive(const char* key, double& out) const;
  Result<void> flag(const char* key, bool& out) const;
  /// Leaves `out` alone when the key is absent.
  Result<void> triple(const char* key, Vec3& out) const;
  /// The key must be there.
  Result<void> positive_triple(const char* key, Vec3& out) const;
  /// 16 hexadecimal digits; the key must be there.
  Result<std::string> hash(const char* key) const;
  /// One of `names`, as its index; the key must be there.
  Result<std::size_t> choice(const char* key, Names names) const;
  Result<std::size_t> choice(const char* key, NameList names) const {
    return choice(key, Names(names.begin(), names.size()));
  }

 private:
  const FileLine& where_;
  const Json& object_;
  std::string prefix_;
};

}  // namespace argil::io
