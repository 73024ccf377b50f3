// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "shell/completion.h"

namespace argil::cli {
namespace {

const char* const kZshBegin = R"sh(#compdef argil
# Made by `argil completion zsh`: do not edit.

_argil_words_or_files() { _alternative "values:value:($*)" 'files:file:_files' }
)sh";

/// Works when zsh loads it from its path and when it is sourced.
const char* const kZshEnd = R"sh(
if [[ ${funcstack[1]} == _argil ]]; then
  _argil "$@"
else
  compdef _argil argil
fi
)sh";

/// Text inside single quotes, with `special` characters escaped for what reads it next.
std::string zsh_text(const std::string& text, const std::string& special) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\'') {
      // Ends the quotes, adds a quoted one, and begins them again.
      escaped += "'\\''";
      continue;
    }
    if (c == '\\' || special.find(c) != std::string::npos) escaped += '\\';
    escaped += c;
  }
  return escaped;
}

/// What _arguments does for a value: ":NAME:ACTION".
std::string zsh_value(const std::string& name, const DescribedOption& option) {
  std::string words;
  for (const auto& word : option.words) words += (words.empty() ? "" : " ") + word.word;
  std::string action;
  if (option.kind == ValueKind::file) {
    action = words.empty() ? "_files" : " _argil_words_or_files " + words;
  } else if (option.kind == ValueKind::folder) {
    action = "_files -/";
  } else if (!words.empty()) {
    action = "(" + words + ")";
  }
  return ":" + zsh_text(name, ":") + ":" + action;
}

/// '(-o --output)'{-o,--output=}'[help]:FILE:_files'; with "=" the value may also stand behind one.
std::string zsh_option(const DescribedOption& option) {
  std::string both;
  std::string either;
  for (const std::string& name : option.names) {
    both += (both.empty() ? "" : " ") + name;
    // Short options take no equals sign.
    const bool has_equals = !option.value.empty() && name.starts_with("--");
    either += (either.empty() ? "" : ",") + name + (has_equals ? "=" : "");
  }
  const std::string names =
      option.names.size() > 1 ? "'(" + both + ")'{" + either + "}'" : "'" + either;
  const std::string value = option.value.empty() ? "" : zsh_value(option.value, option);
  return names + "[" + zsh_text(option.help, "[]") + "]" + value + "'";
}

std::string function_name(const DescribedCommand& command) {
  std::string name = "_" + command.path;
  std::replace(name.begin(), name.end(), ' ', '_');
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

std::string zsh_options(const DescribedCommand& command) {
  std::string lines;
  for (const DescribedOption& option : command.options) {
    lines += " \\\n    " + zsh_option(option);
  }
  return lines;
}

/// A command that works: its options and operands.
std::string leaf_function(const DescribedCommand& command) {
  std::string text = "\n" + function_name(command) + "() {\n  _arguments" + zsh_options(command);
  for (const DescribedOption& operand : command.operands) {
    text += " \\\n    '" + std::string(operand.is_required ? "" : ":") +
            zsh_value(operand.names.front(), operand) + "'";
  }
  return text + "\n}\n";
}

/// A command that only has others below it: offers these, then leaves the line to the one named.
std::string branch_function(const DescribedCommand& command) {
  std::string names;
  std::string arms;
  for (const DescribedCommand& below : command.commands) {
    names += "    '" + below.name + ":" + zsh_text(below.help, "") + "'\n";
    arms += "    " + below.name + ") " + function_name(below) + " ;;\n";
  }
  return "\n" + function_name(command) +
         "() {\n  local curcontext=$curcontext state line\n  typeset -A opt_args\n"
         "  local -a commands=(\n" +
         names + "  )\n  _arguments -C" + zsh_options(command) +
         " \\\n    '1: :->command' \\\n    '*:: :->rest'\n"
         "  [[ $state == command ]] && _describe command commands\n"
         "  [[ $state == rest ]] || return 0\n  case ${line[1]} in\n" +
         arms + "  esac\n}\n";
}

}  // namespace

std::string zsh_completion(const DescribedCommand& program) {
  std::string script = kZshBegin;
  for (const DescribedCommand* command : all_of(program)) {
    script += command->commands.empty() ? leaf_function(*command) : branch_function(*command);
  }
  return script + kZshEnd;
}

}  // namespace argil::cli
