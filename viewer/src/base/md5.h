// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace argil::viewer {

/// The MD5 of some bytes as 32 hexadecimal digits, in lower case. For names of files that other
/// programs give in the same way, and nothing that has to be secret or proof against forgery.
/// Source  R. Rivest, RFC 1321 (1992).
std::string md5_of(std::string_view bytes);

}  // namespace argil::viewer
