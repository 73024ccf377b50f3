// SPDX-License-Identifier: GPL-3.0-or-later
// Manual pages in roff with the macros of man(7).
#include "shell/manual_page.h"

#include <algorithm>
#include <cassert>
#include <cctype>

namespace argil::cli {
namespace {

/// Text as roff prints it: a hyphen that can be copied, no escape, no line that is a request.
std::string roff(const std::string& text) {
  std::string escaped;
  bool is_line_start = true;
  for (const char c : text) {
    // A line that begins with one of them is a request.
    if (is_line_start && (c == '.' || c == '\'')) escaped += "\\&";
    if (c == '\\') {
      escaped += "\\e";
    } else if (c == '-') {
      escaped += "\\-";
    } else {
      escaped += c;
    }
    is_line_start = c == '\n';
  }
  return escaped;
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }

/// "auto|none" with what is typed as it stands in bold, names of values in italics.
std::string styled_value(const DescribedOption& option) {
  std::string styled;
  std::size_t begin = 0;
  while (begin <= option.value.size()) {
    const std::size_t end = std::min(option.value.find('|', begin), option.value.size());
    const std::string word = option.value.substr(begin, end - begin);
    const bool is_literal = std::any_of(option.words.begin(), option.words.end(),
                                        [&](const auto& known) { return known.word == word; });
    styled += (begin == 0 ? "" : "|") + (is_literal ? bold(word) : italic(word));
    begin = end + 1;
  }
  return styled;
}

std::string option_term(const DescribedOption& option) {
  std::string term;
  for (const std::string& name : option.names) term += (term.empty() ? "" : ", ") + bold(name);
  return option.value.empty() ? term : term + " " + styled_value(option);
}

std::string item(const std::string& term, const std::string& text) {
  return ".TP\n" + term + "\n" + roff(text) + "\n";
}

std::string option_items(const std::vector<DescribedOption>& options) {
  std::string items;
  for (const DescribedOption& option : options) {
    items += item(option_term(option), option.help + (option.is_required ? " (required)" : ""));
  }
  return items;
}

std::string operand_items(const std::vector<DescribedOption>& operands) {
  std::string items;
  for (const DescribedOption& operand : operands) {
    items += item(italic(operand.names.front()), operand.help);
    std::string words;
    for (const auto& word : operand.words) words += item(bold(word.word), word.about);
    if (!words.empty()) items += ".RS\n" + words + ".RE\n";
  }
  return items;
}

/// argil sculpt [OPTION...] --strokes TEXT -o FILE [PROJECT]
std::string synopsis(const DescribedCommand& command) {
  std::string line = bold(command.path) + " [" + italic("OPTION") + "...]";
  if (!command.commands.empty()) return line + " " + italic("COMMAND") + " ...";
  for (const DescribedOption& option : command.options) {
    if (option.is_required) line += " " + bold(option.names.front()) + " " + styled_value(option);
  }
  for (const DescribedOption& operand : command.operands) {
    const std::string name = italic(operand.names.front());
    line += " " + (operand.is_required ? name : "[" + name + "]");
  }
  return line;
}

/// Synopses of the commands that do work: the command itself, or those below it.
std::string synopses(const DescribedCommand& command) {
  std::string text;
  for (const DescribedCommand* each : all_of(command)) {
    if (each->commands.empty()) text += (text.empty() ? "" : "\n.br\n") + synopsis(*each);
  }
  return text + "\n";
}

/// A section for each command below, since only commands of the program have pages of their own.
std::string sections_below(const DescribedCommand& command) {
  std::string text;
  for (const DescribedCommand& below : command.commands) {
    text += ".SH " + roff(below.path) + "\n" + roff(below.help) + "\n" +
            operand_items(below.operands) + option_items(below.options) + sections_below(below);
  }
  return text;
}

std::string command_items(const DescribedCommand& program) {
  std::string items;
  for (const DescribedCommand& command : program.commands) {
    items += item("\\fB" + roff(page_name(command)) + "\\fR(1)", command.help);
  }
  return items;
}

const char* const kSeeDocuments =
    "What options mean, what comes back and the exit status:\n.I command_line.md\n"
    "in Argil's documents, on Debian in\n.IR /usr/share/doc/argil/docs .\n";

}  // namespace

std::string page_name(const DescribedCommand& command) {
  assert(!command.path.empty());
  std::string name = command.path;
  std::replace(name.begin(), name.end(), ' ', '-');
  return name;
}

std::string manual_page(const DescribedCommand& program, const DescribedCommand& command) {
  const bool is_program = &command == &program;
  std::string title = page_name(command);
  std::transform(title.begin(), title.end(), title.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  std::string page = ".\\\" Made by `argil man`: do not edit.\n.TH " + roff(title) +
                     " 1 \"\" \"argil " ARGIL_VERSION "\" \"Argil\"\n.nh\n.ad l\n";
  page += ".SH NAME\n" + roff(page_name(command)) + " \\- " + roff(command.help) + "\n";
  page += ".SH SYNOPSIS\n" + (is_program ? synopsis(command) + "\n" : synopses(command));
  if (!command.operands.empty()) page += ".SH ARGUMENTS\n" + operand_items(command.operands);
  page += ".SH OPTIONS\n" + option_items(command.options);
  page += is_program ? ".SH COMMANDS\n" + command_items(program) : sections_below(command);
  page += ".SH SEE ALSO\n";
  if (!is_program) page += ".BR " + roff(program.name) + " (1)\n.PP\n";
  return page + kSeeDocuments;
}

}  // namespace argil::cli
