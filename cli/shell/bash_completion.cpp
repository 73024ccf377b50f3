// SPDX-License-Identifier: GPL-3.0-or-later
// Names of commands, options and words hold nothing that a shell would read, so none is quoted.
#include <cassert>
#include <map>

#include "shell/completion.h"

namespace argil::cli {
namespace {

/// What the script is made around: `command` is how far the line names one of ours, `$words` and
/// `$kind` what may come next. A word after "=" belongs to the option before it.
const char* const kBashBegin = R"sh(# Made by `argil completion bash`: do not edit.

_argil() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}
  local command=argil word words='' kind=''
  if [[ $current == = ]]; then
    current=''
  elif [[ $previous == = ]]; then
    previous=${COMP_WORDS[COMP_CWORD - 2]}
  fi
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    case "$command $word" in
)sh";

const char* const kBashEnd = R"sh(  esac
  COMPREPLY=()
  if [[ -n $words ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
  fi
  case $kind in
    file)
      compopt -o filenames
      mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -f -- "$current")
      ;;
    folder)
      compopt -o filenames
      mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -d -- "$current")
      ;;
  esac
}

complete -F _argil argil
)sh";

/// An arm of a case: "    'one' | 'two') DO ;;".
std::string bash_arm(const std::vector<std::string>& patterns, const std::string& action) {
  std::string arm;
  for (const std::string& pattern : patterns) {
    arm += (arm.empty() ? "    '" : " | \\\n      '") + pattern + "'";
  }
  return arm + ") " + action + " ;;\n";
}

std::string joined_words(const DescribedOption& option) {
  std::string joined;
  for (const auto& word : option.words) joined += (joined.empty() ? "" : " ") + word.word;
  return joined;
}

std::string kind_word(ValueKind kind) {
  if (kind == ValueKind::file) return "file";
  return kind == ValueKind::folder ? "folder" : "";
}

/// Sets what may come next to the value of `option`.
std::string offer_value(const DescribedOption& option) {
  return "words='" + joined_words(option) + "' kind=" + kind_word(option.kind);
}

/// After an option that wants a value, that value; options with the same values share an arm.
std::string value_arms(const std::vector<const DescribedCommand*>& commands) {
  std::map<std::string, std::vector<std::string>> patterns;
  for (const DescribedCommand* command : commands) {
    for (const DescribedOption& option : command->options) {
      if (option.value.empty()) continue;
      // A map, so that the script is the same for every build.
      auto& same = patterns[offer_value(option)];
      for (const std::string& name : option.names) same.push_back(command->path + " " + name);
    }
  }
  std::string arms;
  for (const auto& [action, same] : patterns) arms += bash_arm(same, action);
  return arms;
}

std::string option_names(const DescribedCommand& command) {
  std::string names;
  for (const DescribedOption& option : command.options) {
    for (const std::string& name : option.names) names += (names.empty() ? "" : " ") + name;
  }
  return names;
}

/// Elsewhere options where a hyphen was typed; otherwise commands, or operands.
std::string command_arm(const DescribedCommand& command) {
  std::string words;
  ValueKind kind = ValueKind::other;
  for (const DescribedCommand& below : command.commands) words += " " + below.name;
  for (const DescribedOption& operand : command.operands) {
    words += " " + joined_words(operand);
    kind = operand.kind;
  }
  const std::string names = option_names(command);
  if (words.empty() && kind != ValueKind::file) {
    return bash_arm({command.path}, "words='" + names + "'");
  }
  return bash_arm({command.path}, "if [[ $current == -* ]]; then words='" + names +
                                      "'; else words='" + (words.empty() ? "" : words.substr(1)) +
                                      "' kind=" + kind_word(kind) + "; fi");
}

}  // namespace

std::string bash_completion(const DescribedCommand& program) {
  const auto commands = all_of(program);
  assert(commands.front() == &program && commands.size() > 1);
  std::vector<std::string> paths;
  std::string command_arms;
  for (const DescribedCommand* command : commands) {
    if (command != &program) paths.push_back(command->path);
    command_arms += command_arm(*command);
  }
  return kBashBegin + bash_arm(paths, "command=\"$command $word\"") + "    esac\n  done\n" +
         "  case \"$command $previous\" in\n" + value_arms(commands) + "    *)\n" +
         "    case $command in\n" + command_arms + "    esac\n    ;;\n" + kBashEnd;
}

}  // namespace argil::cli
