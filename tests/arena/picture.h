// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "arena/table.h"

namespace argil::arena {

/// A gnuplot script that draws `name`.svg: a row for each kind, a column for each program, and in
/// each cell how much it made valid and kept, and how much of the rest it lost without a word.
std::string picture_script(const std::vector<Row>& rows, const std::string& name);

}  // namespace argil::arena
