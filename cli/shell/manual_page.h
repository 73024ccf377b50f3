// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "shell/app_description.h"

namespace argil::cli {

/// "argil-import": what `man` calls the page of "argil import".
std::string page_name(const DescribedCommand& command);

/// The manual page of `command` in the macros of man(7): of `program` itself, or of one of its
/// commands with all that is below it.
std::string manual_page(const DescribedCommand& program, const DescribedCommand& command);

}  // namespace argil::cli
