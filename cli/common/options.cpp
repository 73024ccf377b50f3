// SPDX-License-Identifier: GPL-3.0-or-later
// Options whose messages name option, value and what it must be. Numbers by from_chars, which knows
// no locale.
#include "common/options.h"

#include <algorithm>
#include <cassert>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>
#include <vector>

#include "common/output.h"

namespace argil::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& option, const std::string& text,
                         const std::string& must) {
  throw CLI::ValidationError(option + " is '" + text + "'; must be " + must);
}

std::optional<double> to_number(const std::string& text) {
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  // from_chars reads nan and inf as numbers.
  if (error != std::errc{} || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

bool is_in(const Range& range, double value) {
  return (range.above_least ? value > range.least : value >= range.least) && value <= range.most;
}

std::string description(const Range& range) {
  if (!range.above_least) {
    return "a number from " + number(range.least) + " to " + number(range.most);
  }
  return "a number greater than " + number(range.least) + ", at most " + number(range.most);
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return "one of " + text;
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace

double parse_number(const std::string& option, const std::string& text, const Range& range) {
  assert(range.least <= range.most);
  const auto value = to_number(text);
  if (!value || !is_in(range, *value)) refuse(option, text, description(range));
  return *value;
}

Vec3 parse_triple(const std::string& option, const std::string& text) {
  Vec3 triple;
  std::size_t axis = 0;
  std::size_t begin = 0;
  while (true) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const auto value = to_number(text.substr(begin, end - begin));
    if (!value || axis == 3) refuse(option, text, "three numbers X,Y,Z without spaces");
    triple[axis++] = *value;
    if (end == text.size()) break;
    begin = end + 1;
  }
  if (axis != 3) refuse(option, text, "three numbers X,Y,Z without spaces");
  if (!is_in_reach(triple)) {
    refuse(option, text,
           "three numbers from " + number(-kMaxReachMm) + " to " + number(kMaxReachMm));
  }
  return triple;
}

CLI::Option* add_number(CLI::App& app, const std::string& name, double& target, const Range& range,
                        const std::string& help) {
  const auto read = [name, &target, range](const std::string& text) {
    target = parse_number(name, text, range);
  };
  return app.add_option_function<std::string>(name, read, help)->type_name("NUMBER");
}

CLI::Option* add_integer(CLI::App& app, const std::string& name, int& target, int least, int most,
                         const std::string& help) {
  assert(least <= most);
  const auto read = [name, &target, least, most](const std::string& text) {
    int value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || stop != end || value < least || value > most) {
      refuse(name, text,
             "a whole number from " + std::to_string(least) + " to " + std::to_string(most));
    }
    target = value;
  };
  return app.add_option_function<std::string>(name, read, help)->type_name("N");
}

CLI::Option* add_triple(CLI::App& app, const std::string& name, Vec3& target,
                        const std::string& help) {
  const auto read = [name, &target](const std::string& text) { target = parse_triple(name, text); };
  return app.add_option_function<std::string>(name, read, help)->type_name("X,Y,Z");
}

CLI::Option* add_choice(CLI::App& app, const std::string& name, std::size_t& target,
                        std::initializer_list<const char*> names, const std::string& help) {
  const std::vector<std::string> known(names.begin(), names.end());
  assert(target < known.size());  // the default is one of them
  const auto read = [name, &target, known](const std::string& text) {
    const auto found = std::find(known.begin(), known.end(), text);
    if (found == known.end()) refuse(name, text, listed(known));
    target = static_cast<std::size_t>(found - known.begin());
  };
  // Help, manual pages and completions take the words from the type.
  std::string type;
  for (const std::string& each : known) type += (type.empty() ? "" : "|") + each;
  return app.add_option_function<std::string>(name, read, help)->type_name(type);
}

void check_ending(const std::string& option, const fs::path& file,
                  const std::vector<std::string>& endings) {
  const std::string ending = lower(file.extension().string());
  if (std::find(endings.begin(), endings.end(), ending) != endings.end()) return;
  refuse(option, file.string(), "a file name ending in " + listed(endings));
}

CLI::Option* add_file(CLI::App& app, const std::string& name, fs::path& target,
                      std::initializer_list<const char*> endings, const std::string& help) {
  const std::vector<std::string> known(endings.begin(), endings.end());
  assert(!known.empty() && known.front().starts_with('.'));
  const auto read = [name, &target, known](const std::string& text) {
    check_ending(name, text, known);
    target = text;
  };
  return app.add_option_function<std::string>(name, read, help)->type_name("FILE");
}

bool has_ending(const fs::path& file, const std::string& ending) {
  return lower(file.extension().string()) == ending;
}

Result<void> check_input(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status)) {
    return Error{ErrorKind::bad_input, "cannot read '" + file.string() +
                                           "': no such file; check the name and the folder"};
  }
  if (fs::is_directory(status)) {
    return Error{ErrorKind::bad_input,
                 "cannot read '" + file.string() + "': it is a folder; name a file in it"};
  }
  return {};
}

/// Before the work, so that minutes of it are not lost to a misspelt folder.
Result<void> check_output(const fs::path& file) {
  std::error_code error;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (fs::is_directory(folder, error)) return {};
  return Error{ErrorKind::disk, "cannot write '" + file.string() + "': there is no folder '" +
                                    folder.string() + "'; create it first"};
}

}  // namespace argil::cli
