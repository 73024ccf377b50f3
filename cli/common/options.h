// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "argil/core/result.h"
#include "argil/core/vec3.h"

namespace argil::cli {

// Options are read here rather than by CLI11, so that "nan", "1,2" or "3mm" are refused with a
// sentence that names option, value and remedy. All of them throw CLI::ValidationError.

/// A number range, both ends allowed unless `above_least`. Nothing lies beyond kMaxReachMm, and no
/// newton, second or newton per metre that somebody means is larger in its own unit.
struct Range {
  double least = -kMaxReachMm;
  double most = kMaxReachMm;
  bool above_least = false;
};
inline constexpr Range kPositive{0.0, kMaxReachMm, true};

CLI::Option* add_number(CLI::App& app, const std::string& name, double& target, const Range& range,
                        const std::string& help);
CLI::Option* add_integer(CLI::App& app, const std::string& name, int& target, int least, int most,
                         const std::string& help);
/// X,Y,Z
CLI::Option* add_triple(CLI::App& app, const std::string& name, Vec3& target,
                        const std::string& help);
/// One of `names`; `target` becomes the index.
CLI::Option* add_choice(CLI::App& app, const std::string& name, std::size_t& target,
                        std::initializer_list<const char*> names, const std::string& help);
/// A path whose ending must be one of `endings` (".vdb"), in any case.
CLI::Option* add_file(CLI::App& app, const std::string& name, std::filesystem::path& target,
                      std::initializer_list<const char*> endings, const std::string& help);

/// Throws unless a path given for `option` ends in one of `endings`, in any case.
void check_ending(const std::string& option, const std::filesystem::path& file,
                  const std::vector<std::string>& endings);

/// Whether a file name ends in ".vdb", in any case.
bool has_ending(const std::filesystem::path& file, const std::string& ending);

/// Three numbers within kMaxReachMm parted by commas, or a throw that names `option`.
Vec3 parse_triple(const std::string& option, const std::string& text);
/// One number in `range`, or a throw that names `option`.
double parse_number(const std::string& option, const std::string& text, const Range& range);

/// bad_input when `file` is not there or a folder: before any work is done.
Result<void> check_input(const std::filesystem::path& file);
/// disk when the folder that `file` goes to is not there: before any work is done.
Result<void> check_output(const std::filesystem::path& file);

}  // namespace argil::cli
