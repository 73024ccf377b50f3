// SPDX-License-Identifier: GPL-3.0-or-later
// Manual pages and completions say what `--help` says: no command, option or word is missing.
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/cli_files.h"
#include "cli/run_argil.h"
#include "support/clients.h"
#include "support/scratch.h"

namespace argil::test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

using Words = std::vector<std::string>;

std::vector<std::string> matches(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern, std::regex::ECMAScript | std::regex::multiline);
  std::vector<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), regex), end; at != end; ++at) {
    found.push_back((*at)[1]);
  }
  return found;
}

std::string help_of(Words path) {
  path.emplace_back("--help");
  const Ended run = run_argil(path);
  EXPECT_EQ(run.status, 0) << run.err;
  return run.out;
}

/// The commands that a help lists, after its line "Subcommands:".
Words commands_in(const std::string& help) {
  const std::size_t at = help.find("ubcommands:");
  return at == std::string::npos ? Words{} : matches(help.substr(at), "^  ([a-z]+) ");
}

/// Every "-o" and "--output" that begins a line of a help.
Words options_in(const std::string& help) {
  Words options;
  for (const std::string& line : matches(help, "^  (-[-a-z,]+)")) {
    for (const std::string& name : matches(line, "(-[-a-z]+)")) options.push_back(name);
  }
  return options;
}

struct Command {
  Words path;  ///< {} of the program, {"import"}, {"chart", "force"}
  std::string help;
};

/// The program and all of its commands, those below others after them.
std::vector<Command> all_commands() {
  std::vector<Command> all{{{}, help_of({})}};
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (const std::string& name : commands_in(all[i].help)) {
      Words path = all[i].path;
      path.push_back(name);
      const std::string help = help_of(path);
      all.push_back({path, help});
    }
  }
  return all;
}

std::string output_of(const Words& arguments) {
  const Ended run = run_argil(arguments);
  EXPECT_EQ(run.status, 0) << run.err;
  return run.out;
}

/// A page as it is read: no font changes, hyphens as they are.
std::string plain_page(const std::filesystem::path& file) {
  return std::regex_replace(std::regex_replace(text_of(file), std::regex(R"(\\f[BIR])"), ""),
                            std::regex(R"(\\-)"), "-");
}

std::string joined(const Words& path) {
  std::string text = "argil";
  for (const std::string& word : path) text += " " + word;
  return text;
}

// What the tests below walk is all of it.
TEST(CliDescribed, FindsTheCommandsThatHelpLists) {
  std::vector<Words> paths;
  for (const Command& command : all_commands()) paths.push_back(command.path);
  EXPECT_THAT(paths, AllOf(Contains(Words{"import"}), Contains(Words{"chart"}),
                           Contains(Words{"falcon", "home"}), Contains(Words{"man"})));
}

TEST(CliDescribed, ManualPagesHaveEveryCommandAndOption) {
  const ScratchFolder folder;
  output_of({"man", "-o", folder.path().string()});
  for (const auto& [path, help] : all_commands()) {
    const std::string page =
        plain_page(folder / ((path.empty() ? "argil" : "argil-" + path.front()) + ".1"));
    EXPECT_THAT(page, HasSubstr(joined(path)));
    for (const std::string& option : options_in(help)) {
      EXPECT_THAT(page, testing::ContainsRegex("(^|\n|, )" + option + "[ ,\n]")) << joined(path);
    }
  }
}

TEST(CliDescribed, CompletionsHaveEveryCommandAndOption) {
  const std::string bash = output_of({"completion", "bash"});
  const std::string zsh = output_of({"completion", "zsh"});
  for (const auto& [path, help] : all_commands()) {
    const std::string function =
        std::regex_replace(joined(path), std::regex("[ -]"), "_") + "() {\n";
    ASSERT_THAT(zsh, HasSubstr("\n_" + function));
    const std::size_t begin = zsh.find("\n_" + function);
    const std::string body = zsh.substr(begin, zsh.find("\n}\n", begin) - begin);
    const Words offered = matches(bash, "^    '" + joined(path) + "'\\) (.*)");
    ASSERT_EQ(offered.size(), 1U) << joined(path);
    for (const std::string& option : options_in(help)) {
      EXPECT_THAT(offered.front(), testing::ContainsRegex("[ ']" + option + "[ ']"));
      EXPECT_THAT(body, testing::ContainsRegex("['{,]" + option + "[],}=[]")) << joined(path);
    }
  }
}

TEST(CliDescribed, ManWritesAPageForEachCommand) {
  const ScratchFolder folder;
  output_of({"man", "-o", folder.path().string()});
  Words expected{"argil.1"};
  for (const std::string& name : commands_in(help_of({}))) {
    expected.push_back("argil-" + name + ".1");
  }
  EXPECT_THAT(folder.names(), testing::UnorderedElementsAreArray(expected));
  EXPECT_EQ(text_of(folder / "argil-lab.1"), output_of({"man", "lab"}));
}

TEST(CliDescribed, RefusesWhatItCannotDescribe) {
  const Ended page = run_argil({"man", "sculp"});
  EXPECT_EQ(page.status, 2);
  EXPECT_THAT(page.err, HasSubstr("COMMAND is 'sculp'; must be a command that"));
  const Ended shell = run_argil({"completion", "fish"});
  EXPECT_EQ(shell.status, 2);
  EXPECT_THAT(shell.err, HasSubstr("SHELL is 'fish'; must be bash or zsh"));
  const Ended folder = run_argil({"man", "-o", "/nowhere"});
  EXPECT_EQ(folder.status, 5);
  EXPECT_THAT(folder.err, HasSubstr("there is no folder '/nowhere'; create it first"));
}

TEST(CliDescribedClient, ManFormatsEveryPageWithoutAWarning) {
  ARGIL_CLIENT_OR_SKIP("man");
  const ScratchFolder folder;
  output_of({"man", "-o", folder.path().string()});
  for (const std::string& page : folder.names()) {
    const std::string shell = "LC_ALL=C.UTF-8 MANWIDTH=80 man --warnings -E UTF-8 -l '" +
                              (folder / page).string() + "' >/dev/null";
    const ProgramRun run = run_program({"bash", "-c", shell});
    EXPECT_EQ(run.status, 0) << page;
    EXPECT_EQ(run.output, "") << page;
  }
}

/// What bash offers after `line`, whose last word may be empty.
Words offered_by_bash(const std::string& script, const Words& line) {
  std::string words;
  for (const std::string& word : line) words += " '" + word + "'";
  // compopt only works while bash itself completes.
  const ProgramRun run = run_program(
      {"bash", "-c",
       "compopt() { :; }; source '" + script + "' && complete -p argil >/dev/null && COMP_WORDS=(" +
           words + ") COMP_CWORD=" + std::to_string(line.size() - 1) +
           " && _argil && printf '%s\\n' \"${COMPREPLY[@]}\""});
  EXPECT_EQ(run.status, 0) << run.output;
  return matches(run.output, "^(.+)$");
}

TEST(CliDescribedClient, BashCompletesCommandsOptionsAndValues) {
  ARGIL_CLIENT_OR_SKIP("bash");
  const ScratchFolder folder;
  const std::string script = (folder / "argil.bash").string();
  fill(script, output_of({"completion", "bash"}));
  const auto offered = [&](const Words& line) { return offered_by_bash(script, line); };
  EXPECT_THAT(offered({"argil", "im"}), ElementsAre("import"));
  EXPECT_THAT(offered({"argil", "--v"}), ElementsAre("--version"));
  EXPECT_THAT(offered({"argil", "import", "--vox"}), ElementsAre("--voxel-mm"));
  EXPECT_THAT(offered({"argil", "import", "--repair", ""}), ElementsAre("auto", "none"));
  EXPECT_THAT(offered({"argil", "import", "--repair", "=", "n"}), ElementsAre("none"));
  EXPECT_THAT(offered({"argil", "import", "--repair", "="}), ElementsAre("auto", "none"));
  EXPECT_THAT(offered({"argil", "import", "--voxel-mm", ""}), IsEmpty());
  EXPECT_THAT(offered({"argil", "lab", "wall-"}),
              UnorderedElementsAre("wall-rigid", "wall-linear", "wall-nonlinear"));
  EXPECT_THAT(offered({"argil", "falcon", "mon"}), ElementsAre("monitor"));
  EXPECT_THAT(offered({"argil", "falcon", "monitor", "--fo"}), ElementsAre("--force"));
  const std::string file = (folder / "argil.ba").string();
  EXPECT_THAT(offered({"argil", "import", file}), ElementsAre(script));
  EXPECT_THAT(offered({"argil", "import", "a.stl", "-o", file}), ElementsAre(script));
}

TEST(CliDescribedClient, ZshCompletesCommandsOptionsAndValues) {
  ARGIL_CLIENT_OR_SKIP("zsh");
  const ScratchFolder folder;
  fill(folder / "_argil", output_of({"completion", "zsh"}));
  EXPECT_EQ(run_program({"zsh", "-n", (folder / "_argil").string()}).output, "");
  // A shell in a terminal of zsh's own, since only its line editor completes. Each line is typed up
  // to the tab; what stands there after it goes to a file.
  fill(folder / "type.zsh", R"sh(
zmodload zsh/zpty
zpty shell TERM=xterm zsh -f -i
tell() { zpty -w shell "$1" }
tell "PS1= PS2= fpath=(${0:a:h} \$fpath); autoload -Uz compinit && compinit -u -D"
tell "keep() { print -r -- \$BUFFER >>${0:a:h}/typed; BUFFER=; zle accept-line }; zle -N keep"
tell "bindkey '^X' keep; setopt no_beep; KEYTIMEOUT=1"  # ^X begins other keys: no wait for them
integer count=0 n
for line in 'argil im' 'argil import --vox' 'argil import --repair n' 'argil falcon mon' \
    'argil falcon monitor --for' 'argil lab wall-ri' 'argil bridge --motion sl' 'argil import --repair=a'; do
  zpty -w -n shell "$line"$'\t\x18'
  ((++count))
  for ((n = 0; n < 1000; ++n)); do
    while zpty -r -t shell seen; do :; done
    [[ -f ${0:a:h}/typed && $(wc -l <${0:a:h}/typed) -ge $count ]] && break
    sleep 0.01
  done
done
zpty -d shell
)sh");
  const ProgramRun run = run_program({"zsh", (folder / "type.zsh").string()});
  EXPECT_EQ(run.status, 0) << run.output;
  EXPECT_THAT(
      matches(text_of(folder / "typed"), "^(.*[^ \n]) *$"),
      ElementsAre("argil import", "argil import --voxel-mm=", "argil import --repair none",
                  "argil falcon monitor", "argil falcon monitor --force=", "argil lab wall-rigid",
                  "argil bridge --motion slide", "argil import --repair=auto"));
}

}  // namespace
}  // namespace argil::test
