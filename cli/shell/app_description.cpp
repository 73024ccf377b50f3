// SPDX-License-Identifier: GPL-3.0-or-later
// The commands as CLI11 knows them, described once for completions and manual pages.
#include "shell/app_description.h"

#include <algorithm>
#include <cassert>
#include <cctype>
#include <sstream>
#include <utility>

namespace argil::cli {
namespace {

std::vector<std::string> parted(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

/// A value that is typed as it stands, "lod", where "FILE" or "X,Y,Z" is a name for many.
bool is_literal(const std::string& word) {
  return !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
    return std::islower(c) != 0 || std::isdigit(c) != 0 || c == '-' || c == '_';
  });
}

ValueKind kind_of_value(const std::string& value) {
  const auto names = parted(value, '|');
  const auto is_any_of = [&](std::initializer_list<const char*> known) {
    return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
      return std::find(known.begin(), known.end(), name) != known.end();
    });
  };
  // "TEXT" is what CLI11 calls a path.
  if (is_any_of({"FILE", "SCRIPT", "TEXT"}) || value.find('.') != std::string::npos) {
    return ValueKind::file;
  }
  if (is_any_of({"DIR", "FOLDER"})) return ValueKind::folder;
  if (is_any_of({"N", "NUMBER", "X,Y,Z"})) return ValueKind::number;
  return ValueKind::other;
}

std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  if (names.empty()) names.push_back(option.get_name(true));
  return names;
}

DescribedOption describe_option(const CLI::Option& option) {
  DescribedOption described;
  described.names = names_of(option);
  assert(!described.names.empty());
  described.is_required = option.get_required();
  const auto lines = parted(option.get_description(), '\n');
  if (!lines.empty()) described.help = lines.front();
  if (option.get_items_expected_max() == 0) return described;  // a flag
  described.value =
      option.get_option_text().empty() ? option.get_type_name() : option.get_option_text();
  described.kind = kind_of_value(described.value);
  for (const std::string& word : parted(described.value, '|')) {
    if (is_literal(word)) described.words.push_back({word, ""});
  }
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::size_t colon = lines[i].find(": ");
    if (colon == std::string::npos) continue;
    described.words.push_back({lines[i].substr(0, colon), lines[i].substr(colon + 2)});
    described.kind = ValueKind::other;  // one of these words, not any text
  }
  return described;
}

DescribedCommand describe_below(const CLI::App& app, const std::string& parent) {
  DescribedCommand described;
  described.name = app.get_name();
  described.path = parent.empty() ? app.get_name() : parent + " " + app.get_name();
  described.help = app.get_description();
  for (const CLI::Option* option : app.get_options()) {
    auto& kind = option->get_positional() ? described.operands : described.options;
    kind.push_back(describe_option(*option));
  }
  const auto all = [](const CLI::App*) { return true; };
  for (const CLI::App* command : app.get_subcommands(all)) {
    described.commands.push_back(describe_below(*command, described.path));
  }
  return described;
}

}  // namespace

DescribedCommand describe(const CLI::App& app) { return describe_below(app, ""); }

std::vector<const DescribedCommand*> all_of(const DescribedCommand& command) {
  std::vector<const DescribedCommand*> all{&command};
  for (const DescribedCommand& below : command.commands) {
    const auto more = all_of(below);
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

}  // namespace argil::cli
