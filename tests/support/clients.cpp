// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/clients.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <sstream>

#include <sys/wait.h>
#include <unistd.h>

#include "support/built.h"
#include "support/scratch.h"

namespace argil::test {
namespace {

std::string shell_quoted(const std::string& word) {
  std::string quoted = "'";
  for (const char c : word) {
    if (c == '\'') {
      quoted += "'\\''";
    } else {
      quoted += c;
    }
  }
  return quoted + "'";
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

bool mentions(std::string line, const std::vector<std::string>& words) {
  std::transform(line.begin(), line.end(), line.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::any_of(words.begin(), words.end(),
                     [&](const std::string& w) { return line.find(w) != std::string::npos; });
}

/// The number after `label` and its colon; -1 when there is none.
double number_after(const std::string& text, const std::string& label) {
  const std::size_t at = text.find(label);
  if (at == std::string::npos) return -1.0;
  const std::size_t colon = text.find(':', at);
  return colon == std::string::npos ? -1.0 : std::strtod(text.c_str() + colon + 1, nullptr);
}

}  // namespace

bool has_program(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (::access((folder + "/" + name).c_str(), X_OK) == 0) return true;
  }
  return false;
}

ProgramRun run_program(const std::vector<std::string>& words) {
  std::string command;
  for (const std::string& word : words) command += shell_quoted(word) + " ";
  ProgramRun run;
  std::FILE* pipe = ::popen((command + "2>&1 </dev/null").c_str(), "r");
  if (pipe == nullptr) return run;
  std::array<char, 4096> block{};
  while (const std::size_t got = std::fread(block.data(), 1, block.size(), pipe)) {
    run.output.append(block.data(), got);
  }
  const int status = ::pclose(pipe);
  if (WIFEXITED(status)) run.status = WEXITSTATUS(status);
  return run;
}

std::vector<std::string> admesh_complaints(const std::filesystem::path& stl) {
  const ProgramRun run = run_program({"admesh", stl.string()});
  if (run.status != 0) return {"admesh ended with " + std::to_string(run.status), run.output};
  std::vector<std::string> complaints;
  for (const char* label :
       {"Facets with 1 disconnected edge", "Facets with 2 disconnected edges",
        "Facets with 3 disconnected edges", "Total disconnected facets", "Degenerate facets",
        "Edges fixed", "Facets removed", "Facets added", "Facets reversed", "Backwards edges"}) {
    const double count = number_after(run.output, label);
    if (count != 0.0) complaints.push_back(std::string(label) + ": " + std::to_string(count));
  }
  return complaints;
}

SlicerInfo slicer_info(const std::filesystem::path& mesh) {
  SlicerInfo info;
  const ProgramRun run = run_program({"prusa-slicer", "--loglevel", "2", "--info", mesh.string()});
  if (run.status != 0) info.complaints.push_back("ended with " + std::to_string(run.status));
  Vec3 low{1e30, 1e30, 1e30};
  Vec3 high = -low;
  int manifold = 0;
  for (const std::string& line : lines_of(run.output)) {
    const std::size_t equals = line.find('=');
    if (equals == std::string::npos) continue;
    const std::string key = trimmed(line.substr(0, equals));
    const std::string value = trimmed(line.substr(equals + 1));
    const std::size_t axis = key.empty() ? 0 : static_cast<std::size_t>(key.back() - 'x');
    if (key == "number_of_facets") {
      info.facets += std::stoll(value);
    } else if (key == "number_of_parts") {
      info.parts += std::stoi(value);
    } else if (key == "volume") {
      info.volume_mm3 += std::stod(value);
    } else if (key == "manifold") {
      ++info.objects;
      manifold += value == "yes" ? 1 : 0;
    } else if (key.rfind("min_", 0) == 0) {
      low[axis] = std::min(low[axis], std::stod(value));
    } else if (key.rfind("max_", 0) == 0) {
      high[axis] = std::max(high[axis], std::stod(value));
    } else if (key.rfind("size_", 0) != 0) {
      info.complaints.push_back(line);
    }
  }
  if (info.objects > 0) info.size_mm = high - low;
  if (info.objects == 0 || manifold != info.objects) {
    info.complaints.push_back("not manifold: " + run.output);
  }
  return info;
}

Vec3 slicer_size_mm(const std::filesystem::path& mesh) {
  const ScratchFolder folder;
  const std::filesystem::path stl = folder / "placed.stl";
  run_program({"prusa-slicer", "--export-stl", "-o", stl.string(), mesh.string()});
  return slicer_info(stl).size_mm;
}

std::vector<std::string> slicing_complaints(const std::filesystem::path& mesh) {
  const ScratchFolder folder;
  const std::filesystem::path gcode = folder / "piece.gcode";
  const ProgramRun run =
      run_program({"prusa-slicer", "--loglevel", "2", "--bed-shape", "0x0,500x0,500x500,0x500",
                   "--max-print-height", "500", "--center", "250,250", "--export-gcode", "-o",
                   gcode.string(), mesh.string()});
  std::vector<std::string> complaints;
  for (const std::string& line : lines_of(run.output)) {
    // Of its own medial axis of a layer, which it then turns and tries again; not of the mesh.
    if (mentions(line, {"non-planar voronoi"})) continue;
    // Of what stands on the bed without support, since 2.6; not of the mesh.
    if (mentions(line, {"print stability issues"})) continue;
    // The remedy that it adds to the warning before, and a sentence of its own only by its line.
    if (!complaints.empty() && line.starts_with("Make sure the object is printable.")) {
      complaints.back() += " " + line;
      continue;
    }
    if (mentions(line, {"repair", "error", "warning", "manifold", "open edge"})) {
      complaints.push_back(line);
    }
  }
  std::error_code missing;
  const auto bytes = std::filesystem::file_size(gcode, missing);
  if (run.status != 0 || missing || bytes == 0) {
    complaints.push_back("no G-code, status " + std::to_string(run.status) + ": " + run.output);
  }
  return complaints;
}

std::filesystem::path gltf_validator() {
  return std::filesystem::path(source_folder()) / "build/npm/node_modules/gltf-validator";
}

std::vector<std::string> gltf_complaints(const std::filesystem::path& glb) {
  const std::filesystem::path script =
      std::filesystem::path(source_folder()) / "tests/npm/gltf_validate.js";
  const ProgramRun run = run_program({"env", "NODE_PATH=" + gltf_validator().parent_path().string(),
                                      "node", script.string(), glb.string()});
  std::vector<std::string> complaints = lines_of(run.output);
  if (run.status != 0) complaints.push_back("ended with " + std::to_string(run.status));
  return complaints;
}

}  // namespace argil::test
