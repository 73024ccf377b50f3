// SPDX-License-Identifier: GPL-3.0-or-later
// The repair arena: broken meshes of 25 kinds, repaired by Argil and its peers, and judged.
// docs/testing.md says how to read it.
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "argil/io/mesh_file.h"

#include "arena/arena.h"
#include "arena/child.h"
#include "arena/contestants.h"
#include "arena/picture.h"
#include "arena/slice/slice.h"
#include "support/scratch.h"

namespace argil::arena {
namespace {

constexpr const char* kUsage =
    "usage: argil_arena [OPTIONS]\n"
    "       argil_arena slice [--out NAME] [--write DIR]\n"
    "  --kinds A,B         of the 25 kinds; all\n"
    "  --models A,B        of the sound solids; six in turn for each kind and strength\n"
    "  --strengths 1,2     1 to 4, some kinds 5; all\n"
    "  --contestants A,B   argil, admesh, blender, prusaslicer, cgal; all\n"
    "  --limit N           so many meshes, evenly from all\n"
    "  --most-triangles N  of a sound solid (12000)\n"
    "  --jobs N            runs at a time (2)\n"
    "  --keep-failed DIR   writes what argil failed at there\n"
    "  --write DIR         writes all meshes there, runs nothing\n"
    "  --rows A.csv,B.csv  makes the table and picture of these rows, runs nothing\n"
    "  --out NAME          writes NAME.csv, .txt, .gp and .svg, and each run at once to "
    "NAME.part.csv\n";

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  std::istringstream in(text);
  for (std::string word; std::getline(in, word, ',');) words.push_back(word);
  return words;
}

/// Whether the option is known.
bool set_option(ArenaOptions& options, std::string& out, const std::string& name,
                const std::string& value) {
  if (name == "--kinds") {
    options.kinds = words_of(value);
  } else if (name == "--models") {
    options.models = words_of(value);
  } else if (name == "--contestants") {
    options.contestants = words_of(value);
  } else if (name == "--strengths") {
    for (const std::string& word : words_of(value)) options.strengths.push_back(std::stoi(word));
  } else if (name == "--limit") {
    options.limit = std::stoul(value);
  } else if (name == "--most-triangles") {
    options.most_triangles = std::stoul(value);
  } else if (name == "--jobs") {
    options.jobs = std::stoi(value);
  } else if (name == "--keep-failed") {
    options.keep_failed = value;
    std::filesystem::create_directories(value);
  } else if (name == "--write") {
    options.write_to = value;
    std::filesystem::create_directories(value);
  } else if (name == "--rows") {
    options.rows = words_of(value);
  } else if (name == "--out") {
    out = value;
  } else {
    return false;
  }
  return true;
}

void tell(const std::string& out, const std::string& table, const std::string& csv) {
  std::cout << table;
  if (out.empty()) return;
  std::ofstream(out + ".csv") << csv;
  std::ofstream(out + ".txt") << table;
}

void draw(const std::filesystem::path& out, const std::vector<Row>& rows) {
  constexpr double kPatienceToDrawS = 60.0;
  const test::ScratchFolder scratch;
  const std::filesystem::path folder = std::filesystem::absolute(out).parent_path();
  const std::string name = out.filename().string();
  std::ofstream(out.string() + ".gp") << picture_script(rows, name);
  const ChildEnd end = run_child(
      scratch.path(), {"gnuplot", "-e", "cd '" + folder.string() + "'; load '" + name + ".gp'"},
      kPatienceToDrawS);
  if (end.status != 0) std::cerr << "no picture: gnuplot: " << end.err << '\n';
}

int run_slice(const ArenaOptions& options, const std::string& out) {
  const std::vector<PrintPiece> pieces = print_pieces();
  if (!options.write_to.empty()) {
    for (const PrintPiece& piece : pieces) {
      (void)io::write_mesh(options.write_to / (piece.name + ".stl"), piece.mesh);
    }
    return 0;
  }
  const std::vector<SliceRow> rows = compare_with_slicer(pieces);
  tell(out, slice_table(rows), slice_csv(rows));
  return 0;
}

int run(const std::vector<std::string>& words) {
  if (words.size() == 3 && words[0] == kCgalCommand) return run_cgal_repair(words[1], words[2]);
  const bool is_slice = !words.empty() && words[0] == "slice";
  ArenaOptions options;
  std::string out;
  for (std::size_t i = is_slice ? 1 : 0; i < words.size(); i += 2) {
    if (i + 1 < words.size() && set_option(options, out, words[i], words[i + 1])) continue;
    std::cerr << kUsage;
    return 2;
  }
  if (is_slice) return run_slice(options, out);
  if (!options.rows.empty()) {
    std::string csv;
    for (const std::string& file : options.rows) csv += test::content_of(file);
    const std::vector<Row> rows = rows_of(csv);
    std::cout << table_of(rows);
    if (!out.empty()) draw(out, rows);
    return 0;
  }
  const Say say = [](const std::string& line) { std::cerr << line << std::endl; };
  const std::vector<Broken> meshes = broken_meshes(options, say);
  say(std::to_string(meshes.size()) + " meshes");
  if (!options.write_to.empty()) {
    for (const Broken& broken : meshes) write_case(options.write_to, broken);
    return 0;
  }
  std::ofstream so_far;
  if (!out.empty()) so_far.open(out + ".part.csv");
  so_far << csv_head();
  const auto done = [&](const Row& row) { so_far << csv_line(row) << std::flush; };
  const std::vector<Row> rows = run_arena(meshes, options, say, done);
  tell(out, table_of(rows), csv_of(rows));
  if (!out.empty()) draw(out, rows);
  return 0;
}

}  // namespace
}  // namespace argil::arena

int main(int argc, char** argv) {
  try {
    return argil::arena::run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
