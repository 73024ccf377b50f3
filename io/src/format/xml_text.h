// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace argil::io {

/// The text of an attribute: the five entities of XML and those of numbers become what they stand
/// for; others stay as they are.
std::string xml_unescaped(std::string_view text);

/// The same text for an attribute or an element.
std::string xml_escaped(std::string_view text);

/// A name for people, files and JSON: control characters become blanks, what is no UTF-8 becomes
/// '?', blanks around it go, and it ends before a character that would make it longer than that.
std::string plain_name(std::string_view text, std::size_t most_bytes);

}  // namespace argil::io
