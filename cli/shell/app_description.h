// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace argil::cli {

/// What a shell should offer for a value, besides the words that are known.
enum class ValueKind { number, file, folder, other };

/// An option, or an operand (an argument without a name).
struct DescribedOption {
  std::vector<std::string> names;  ///< "-o", "--output"; of an operand its one name, "PROJECT"
  std::string value;               ///< how the help writes its value, "X,Y,Z"; empty: a flag
  std::string help;                ///< its first line
  /// The words it takes, with what each means where the help says so.
  struct Word {
    std::string word;
    std::string about;
  };
  std::vector<Word> words;
  ValueKind kind = ValueKind::other;
  bool is_required = false;
};

/// A command as its `--help` describes it, so that manual pages and completions cannot say
/// otherwise.
struct DescribedCommand {
  std::string path;  ///< "argil", "argil import", "argil chart force"
  std::string name;  ///< the last word of it
  std::string help;
  std::vector<DescribedOption> options;
  std::vector<DescribedOption> operands;
  std::vector<DescribedCommand> commands;
};

/// The command of `app` and those below it, all in the order in which they were added.
///
/// Words of a value are read from how the help writes it: "auto|none" are two words, "NAME|FILE" is
/// a name or a file; further lines "WORD: what it is" of a help are the words of an operand.
DescribedCommand describe(const CLI::App& app);

/// `command` and all below it, itself first.
std::vector<const DescribedCommand*> all_of(const DescribedCommand& command);

}  // namespace argil::cli
