// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace argil::test {

/// Fields by the names of the header.
using CsvRow = std::map<std::string, std::string>;

/// A file of a chart: one line of comment, the header, rows.
struct CsvFile {
  std::string comment;
  std::vector<CsvRow> rows;
};

inline std::vector<std::string> csv_fields(const std::string& line) {
  std::vector<std::string> fields;
  std::string field;
  std::istringstream stream(line);
  while (std::getline(stream, field, ',')) fields.push_back(field);
  if (line.ends_with(',')) fields.emplace_back();
  return fields;
}

/// Expects that every row has as many fields as the header.
inline CsvFile read_csv(const std::filesystem::path& file) {
  std::ifstream stream(file);
  CsvFile read;
  std::string line;
  std::getline(stream, read.comment);
  std::getline(stream, line);
  const std::vector<std::string> names = csv_fields(line);
  while (std::getline(stream, line)) {
    const std::vector<std::string> fields = csv_fields(line);
    EXPECT_EQ(fields.size(), names.size()) << line;
    CsvRow row;
    for (std::size_t i = 0; i < std::min(names.size(), fields.size()); ++i) {
      row[names[i]] = fields[i];
    }
    read.rows.push_back(std::move(row));
  }
  return read;
}

/// A number; of ">= 60000" the number; -1 where the field is empty or not there.
inline double csv_value(const CsvRow& row, const std::string& column) {
  const auto found = row.find(column);
  EXPECT_NE(found, row.end()) << column;
  if (found == row.end() || found->second.empty()) return -1.0;
  const std::string& text = found->second;
  return std::strtod(text.c_str() + (text.starts_with(">= ") ? 3 : 0), nullptr);
}

}  // namespace argil::test
