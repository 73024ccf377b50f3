// SPDX-License-Identifier: GPL-3.0-or-later
// How each program is asked to repair, and what it answered.
#include "arena/contestants.h"

#include <algorithm>
#include <array>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "argil/io/mesh_file.h"

#include "arena/blender.h"
#include "arena/child.h"
#include "support/built.h"

namespace argil::arena {
namespace {

/// The last line that says why, without the folder that the files of a run lie in.
std::string last_line(const std::string& text, const std::string& folder) {
  std::istringstream lines(text);
  std::string last;
  for (std::string line; std::getline(lines, line);) {
    // What a program noticed beside its work is no reason.
    if (line.find_first_not_of(' ') != std::string::npos && !line.starts_with("argil: note:")) {
      last = line;
    }
  }
  for (std::size_t at; (at = last.find(folder)) != std::string::npos;)
    last.erase(at, folder.size());
  return last;
}

Attempt attempt_of(const ChildEnd& end, const std::filesystem::path& result) {
  Attempt attempt;
  attempt.status = end.status;
  attempt.hung = end.is_late;
  attempt.crashed = end.signal != 0 && !end.is_late;
  attempt.wall_s = end.wall_s;
  attempt.cpu_s = end.cpu_s;
  if (end.status != 0) attempt.said = last_line(end.err, result.parent_path().string() + "/");
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(result, ignored)) return attempt;
  if (auto mesh = io::read_mesh(result)) attempt.mesh = std::move(mesh.value());
  return attempt;
}

/// Whether a key "at_mm" is anywhere in it.
bool has_place(const nlohmann::json& json) {
  if (json.is_object() && json.contains("at_mm")) return true;
  if (!json.is_structured()) return false;
  return std::any_of(json.begin(), json.end(), [](const auto& part) { return has_place(part); });
}

Attempt run_argil(const std::filesystem::path& folder, const std::filesystem::path& broken) {
  const std::filesystem::path result = folder / "argil.ply";
  const ChildEnd end = run_child(
      folder, {test::argil_program(), "repair", "--json", broken.string(), "-o", result.string()},
      kPatienceS);
  Attempt attempt = attempt_of(end, result);
  const auto json = nlohmann::json::parse(end.out, nullptr, false);
  attempt.names_a_place = has_place(json);
  return attempt;
}

/// The others read no PLY.
bool write_stl(const std::filesystem::path& from, const std::filesystem::path& stl) {
  const auto mesh = io::read_mesh(from);
  return mesh && io::write_mesh(stl, mesh.value());
}

Attempt run_admesh(const std::filesystem::path& folder, const std::filesystem::path& broken) {
  const std::filesystem::path stl = folder / "broken.stl";
  const std::filesystem::path result = folder / "admesh.stl";
  if (!write_stl(broken, stl)) return {};
  return attempt_of(run_child(folder, {"admesh", "-b", result.string(), stl.string()}, kPatienceS),
                    result);
}

Attempt run_prusaslicer(const std::filesystem::path& folder, const std::filesystem::path& broken) {
  const std::filesystem::path stl = folder / "broken.stl";
  const std::filesystem::path result = folder / "prusaslicer.stl";
  if (!write_stl(broken, stl)) return {};
  return attempt_of(
      run_child(folder,
                {"prusa-slicer", "--loglevel", "1", "--repair", "--dont-arrange",
                 "--no-ensure-on-bed", "--export-stl", "-o", result.string(), stl.string()},
                kPatienceS),
      result);
}

Attempt run_cgal(const std::filesystem::path& folder, const std::filesystem::path& broken) {
  constexpr int kMemoryMb = 6000;  // what a pipeline that has lost its way may take
  const std::filesystem::path result = folder / "cgal.ply";
  const std::string own = std::filesystem::read_symlink("/proc/self/exe").string();
  return attempt_of(run_child(folder, {own, kCgalCommand, broken.string(), result.string()},
                              kPatienceS, kMemoryMb),
                    result);
}

constexpr std::array kContestants{
    Contestant{"argil", "", run_argil}, Contestant{"admesh", "admesh", run_admesh},
    Contestant{"blender", "blender", run_blender},
    Contestant{"prusaslicer", "prusa-slicer", run_prusaslicer}, Contestant{"cgal", "", run_cgal}};

}  // namespace

std::span<const Contestant> contestants() { return kContestants; }

}  // namespace argil::arena
