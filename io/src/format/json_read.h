// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "argil/core/result.h"

namespace argil::io {

using Json = nlohmann::json;

/// What comes from outside nests no deeper: most of what can be done with a value (dump, copy,
/// compare) calls itself for each level, and so a file could overflow the stack.
inline constexpr std::size_t kDeepestJson = 64;

/// A text that is one JSON object, by which all files are read. `where` is the file and line as
/// errors should call it.
///
/// Errors  bad_input "WHERE: ...": not JSON (naming the byte, from 1), not an object, deeper than
///         kDeepestJson, the same key twice in an object, a number that double cannot hold.
/// Cost    linear; nlohmann's own means to watch what it reads searches a list again for each
///         object in it.
Result<Json> read_json_object(std::string_view text, const std::string& where);

/// A value as a message shows it, shortened.
std::string shown(const Json& value);

}  // namespace argil::io
