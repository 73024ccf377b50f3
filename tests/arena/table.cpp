// SPDX-License-Identifier: GPL-3.0-or-later
#include "arena/table.h"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <sstream>
#include <utility>

namespace argil::arena {
namespace {

/// What is said about some rows together.
struct Summary {
  std::size_t runs = 0;
  std::size_t valid = 0;
  std::size_t kept = 0;
  std::size_t right = 0;
  std::size_t silent = 0;
  std::size_t crashed = 0;
  std::size_t hung = 0;
  double median_s = 0.0;
  double most_s = 0.0;
};

Summary summary_of(const std::vector<Row>& rows, const std::function<bool(const Row&)>& is_in) {
  Summary sum;
  std::vector<double> seconds;
  for (const Row& row : rows) {
    if (!is_in(row)) continue;
    ++sum.runs;
    sum.valid += row.judged.valid ? 1 : 0;
    sum.kept += row.judged.kept ? 1 : 0;
    sum.right += row.is_right() ? 1 : 0;
    sum.silent += row.is_silent() ? 1 : 0;
    sum.crashed += row.attempt.crashed ? 1 : 0;
    sum.hung += row.attempt.hung ? 1 : 0;
    seconds.push_back(row.attempt.cpu_s);
  }
  std::sort(seconds.begin(), seconds.end());
  if (!seconds.empty()) {
    sum.median_s = seconds[seconds.size() / 2];
    sum.most_s = seconds.back();
  }
  return sum;
}

template <class... Values>
std::string printed(const char* format, Values... values) {
  char line[256];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

double percent(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

std::string line_of(const std::string& kind, const std::string& contestant, const Summary& s) {
  return printed("%-20s %-12s %5zu %7.1f %7.1f %7.1f %7zu %6zu %5zu %8.2f %8.2f\n", kind.c_str(),
                 contestant.c_str(), s.runs, percent(s.valid, s.runs), percent(s.kept, s.runs),
                 percent(s.right, s.runs), s.silent, s.crashed, s.hung, s.median_s, s.most_s);
}

std::vector<std::string> values_of(const std::vector<Row>& rows,
                                   const std::function<std::string(const Row&)>& value) {
  std::vector<std::string> values;
  for (const Row& row : rows) {
    if (std::find(values.begin(), values.end(), value(row)) == values.end()) {
      values.push_back(value(row));
    }
  }
  return values;
}

/// The kinds in which another program gets more right.
std::string behind_text(const std::vector<Row>& rows, const std::vector<std::string>& kinds,
                        const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& kind : kinds) {
    const auto right = [&](const std::string& name) {
      return summary_of(rows, [&](const Row& r) { return r.kind == kind && r.contestant == name; })
          .right;
    };
    for (const std::string& name : names) {
      if (right(name) <= right("argil")) continue;
      text += "  behind in " + kind + ": argil " + std::to_string(right("argil")) + ", " + name +
              " " + std::to_string(right(name)) + "\n";
    }
  }
  return text;
}

std::string quoted(std::string text) {
  std::replace(text.begin(), text.end(), '"', '\'');
  std::replace(text.begin(), text.end(), '\n', ' ');
  return '"' + text + '"';
}

}  // namespace

std::string csv_head() {
  return "kind,model,strength,triangles,contestant,valid,kept,silent,status,names_a_place,crashed,"
         "hung,wall_s,cpu_s,added,lost,volume_off,bodies,why\n";
}

std::string csv_line(const Row& r) {
  return r.kind + "," + r.model + "," +
         printed("%d,%zu,%s,%d,%d,%d,%d,%d,%d,%d,%.3f,%.3f,%.6f,%.6f,%.6f,%u,", r.strength,
                 r.triangles, r.contestant.c_str(), r.judged.valid, r.judged.kept, r.is_silent(),
                 r.attempt.status, r.attempt.names_a_place, r.attempt.crashed, r.attempt.hung,
                 r.attempt.wall_s, r.attempt.cpu_s, r.judged.added, r.judged.lost,
                 r.judged.volume_off, r.judged.bodies) +
         quoted(r.judged.why + (r.attempt.said.empty() ? "" : " | " + r.attempt.said)) + "\n";
}

std::string csv_of(const std::vector<Row>& rows) {
  std::string text = csv_head();
  for (const Row& row : rows) text += csv_line(row);
  return text;
}

std::vector<Row> rows_of(const std::string& csv) {
  constexpr std::size_t kFields = 18;  // before the reason, which may have commas
  std::vector<Row> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> fields;
    std::istringstream in(line);
    for (std::string field; fields.size() < kFields && std::getline(in, field, ',');) {
      fields.push_back(field);
    }
    if (fields.size() < kFields || fields[0] == "kind" || fields[0][0] == '#') continue;
    Row row;
    row.kind = fields[0];
    row.model = fields[1];
    row.strength = std::stoi(fields[2]);
    row.triangles = std::stoul(fields[3]);
    row.contestant = fields[4];
    row.judged.valid = fields[5] == "1";
    row.judged.kept = fields[6] == "1";
    row.attempt.status = std::stoi(fields[8]);
    row.attempt.names_a_place = fields[9] == "1";
    row.attempt.crashed = fields[10] == "1";
    row.attempt.hung = fields[11] == "1";
    row.attempt.cpu_s = std::stod(fields[13]);
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string table_of(const std::vector<Row>& rows) {
  const auto kinds = values_of(rows, [](const Row& r) { return r.kind; });
  const auto names = values_of(rows, [](const Row& r) { return r.contestant; });
  std::string text =
      printed("%-20s %-12s %5s %7s %7s %7s %7s %6s %5s %8s %8s\n", "kind", "program", "runs",
              "valid%", "kept%", "both%", "silent", "crash", "hung", "median s", "most s");
  for (const std::string& kind : kinds) {
    for (const std::string& name : names) {
      text += line_of(kind, name, summary_of(rows, [&](const Row& r) {
                        return r.kind == kind && r.contestant == name;
                      }));
    }
  }
  for (const std::string& name : names) {
    text +=
        line_of("all", name, summary_of(rows, [&](const Row& r) { return r.contestant == name; }));
  }
  text += "seconds: CPU time of all threads\n";
  const Summary ours = summary_of(rows, [](const Row& r) { return r.contestant == "argil"; });
  if (ours.runs == 0) return text;
  text += printed(
      "argil: valid %.1f %% (asked 98), valid and kept %.1f %% (92), silent losses %zu "
      "(0), longest %.1f s (30), crashes and hangs %zu (0)\n",
      percent(ours.valid, ours.runs), percent(ours.right, ours.runs), ours.silent, ours.most_s,
      ours.crashed + ours.hung);
  return text + behind_text(rows, kinds, names);
}

}  // namespace argil::arena
