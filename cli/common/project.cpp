// SPDX-License-Identifier: GPL-3.0-or-later
// Projects as commands open and replace them; what was recovered or put aside is told on stderr.
#include "common/project.h"

#include <cstdio>
#include <utility>

#include "common/options.h"
#include "common/output.h"

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

void add_piece_option(CLI::App& command, std::string& piece) {
  command.add_option("--piece", piece, "of a project with several pieces: the one that is meant");
}

Result<void> check_no_piece(const std::filesystem::path& mesh, const std::string& piece) {
  if (piece.empty()) return {};
  return Error{ErrorKind::bad_input,
               "'" + mesh.string() + "' is a mesh, which has no pieces; leave out --piece"};
}

Result<void> select_piece(const std::filesystem::path& file, const std::string& piece,
                          Sculpture& sculpture) {
  if (!piece.empty()) {
    auto selected = sculpture.apply(SelectPiece{piece});
    return selected ? selected : named(file.string(), selected.error());
  }
  if (sculpture.piece_count() == 1) return {};
  std::string names;
  for (std::size_t n = 0; n < sculpture.piece_count(); ++n) {
    names.append(n == 0 ? "'" : ", '").append(sculpture.look(n).name).append("'");
  }
  return Error{ErrorKind::bad_input, "'" + file.string() + "' has several pieces, " + names +
                                         "; name the one that is meant with --piece"};
}

Result<OpenedClay> open_clay(const std::filesystem::path& file, const std::string& piece,
                             const Progress& progress) {
  auto opened = open_project(file, progress);
  if (!opened) return opened.error();
  Sculpture& sculpture = opened.value().sculpture;
  if (auto selected = select_piece(file, piece, sculpture); !selected) return selected.error();
  return OpenedClay{std::move(sculpture).take_clay(), opened.value().recovered_steps};
}

namespace {

Result<void> replaced(const Result<std::vector<std::string>>& notes) {
  if (!notes) return notes.error();
  print_notes(notes.value());
  return {};
}

}  // namespace

Result<void> replace_project(const std::filesystem::path& file, const Clay& clay) {
  return replaced(io::replace_project(file, clay));
}

Result<void> replace_project(const std::filesystem::path& file, const Sculpture& sculpture) {
  return replaced(io::replace_project(file, sculpture));
}

}  // namespace argil::cli
