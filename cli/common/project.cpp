// SPDX-License-Identifier: GPL-3.0-or-later
// Projects as commands open and replace them; what was recovered or put aside is told on stderr.
#include "common/project.h"

#include <cstdio>

#include "common/options.h"

namespace argil::cli {

void print_notes(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) std::fprintf(stderr, "argil: note: %s\n", note.c_str());
}

Result<io::OpenedProject> open_project(const std::filesystem::path& file,
                                       const Progress& progress) {
  if (auto input = check_input(file); !input) return input.error();
  auto opened = io::open_project(file, progress);
  if (opened) print_notes(opened.value().notes);
  return opened;
}

Result<void> replace_project(const std::filesystem::path& file, const Clay& clay) {
  const auto notes = io::replace_project(file, clay);
  if (!notes) return notes.error();
  print_notes(notes.value());
  return {};
}

}  // namespace argil::cli
