// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "arena/contestants.h"
#include "arena/judge.h"

namespace argil::arena {

/// One run of one program.
struct Row {
  std::string contestant;
  std::string kind;
  std::string model;
  int strength = 1;
  std::size_t triangles = 0;  ///< of the broken mesh
  Attempt attempt;            ///< without its mesh
  Judgement judged;

  bool is_right() const { return judged.valid && judged.kept; }
  /// Neither right nor said so: a loss is an exit status and a place.
  bool is_silent() const {
    return !is_right() && !attempt.crashed && !attempt.hung &&
           (attempt.status == 0 || !attempt.names_a_place);
  }
};

/// Names of the columns, and a run's line.
std::string csv_head();
std::string csv_line(const Row& row);
/// All of them.
std::string csv_of(const std::vector<Row>& rows);

/// The rows of such text, but for the seconds on the wall and why; lines that are none are passed
/// over.
std::vector<Row> rows_of(const std::string& csv);

/// A line for each kind and program, then the totals, then what the arena asks of argil and whether
/// that is so, with the kinds in which another program is ahead of it.
std::string table_of(const std::vector<Row>& rows);

}  // namespace argil::arena
