// SPDX-License-Identifier: GPL-3.0-or-later
// Files of several parts as commands read them and speak of them.
#include "assembly_input.h"

#include <algorithm>
#include <set>
#include <string_view>

#include "argil/core/no_throw.h"

#include "common/output.h"
#include "common/project.h"

namespace argil::cli {
namespace {

constexpr std::string_view kMindedInFiles = "/\\:*?\"<>|";

bool is_inside_character(char c) noexcept {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

std::string lower_case(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

}  // namespace

Result<io::ReadAssembly> open_assembly(const std::filesystem::path& file,
                                       const MeshFrameOptions& options) {
  auto read = io::read_assembly(file, options.frame());
  if (!read) return read;
  print_notes(io::frame_doubts(file, read.value().frame));
  for (std::string& note : read.value().notes) note.insert(0, "'" + file.string() + "': ");
  print_notes(read.value().notes);
  return read;
}

StandingParts standing_parts(const io::Assembly& assembly) {
  StandingParts parts;
  for (const io::PlacedPart& part : io::placed_parts(assembly)) {
    parts.names.push_back(part.name);
    parts.meshes.push_back(io::placed_mesh(assembly.objects[part.object].mesh, part.to_mm));
  }
  return parts;
}

Result<std::vector<mesh::PartGap>> gaps_between(const StandingParts& parts, double reach_mm,
                                                const Progress& progress) {
  if (parts.meshes.size() > mesh::kMostParts) {
    print_notes({"gaps between " + std::to_string(parts.meshes.size()) +
                 " parts were not looked for; of up to " + std::to_string(mesh::kMostParts) +
                 " they are"});
    return std::vector<mesh::PartGap>();
  }
  return no_throw("looking for gaps between parts", [&]() -> Result<std::vector<mesh::PartGap>> {
    return mesh::part_gaps(parts.meshes, reach_mm, Pace(progress, "gaps"));
  });
}

Json gaps_json(const std::vector<mesh::PartGap>& gaps, const std::vector<std::string>& names) {
  Json json = Json::array();
  for (const mesh::PartGap& gap : gaps) {
    json.push_back({{"parts", {names[gap.a], names[gap.b]}},
                    {"gap_mm", gap.gap_mm},
                    {"at_mm", to_json(gap.at_mm)},
                    {"within", gap.is_within}});
  }
  return json;
}

std::string gap_text(const mesh::PartGap& gap, const std::vector<std::string>& names) {
  const Vec3& at = gap.at_mm;
  const std::string both = "'" + names[gap.a] + "' and '" + names[gap.b] + "' ";
  const std::string how = gap.is_within ? "lie one in the other"
                          : gap.meet()  ? "touch or overlap"
                                        : "are " + number(gap.gap_mm) + " mm apart";
  return both + how + " at " + number(at.x) + ", " + number(at.y) + ", " + number(at.z) + " mm";
}

std::string parts_text(const std::vector<std::string>& names) {
  std::string text = grouped(static_cast<std::int64_t>(names.size())) +
                     (names.size() == 1 ? " part: " : " parts: ");
  for (std::size_t n = 0; n < std::min(names.size(), kMostPartsSaid); ++n) {
    text += (n > 0 ? ", '" : "'") + names[n] + "'";
  }
  return names.size() > kMostPartsSaid ? text + ", ..." : text;
}

std::vector<std::string> file_stems(const std::vector<std::string>& names) {
  constexpr std::size_t kLongest = 100;
  std::vector<std::string> stems;
  std::set<std::string> used;  // in lower case
  for (const std::string& name : names) {
    std::string stem = name.substr(0, kLongest);
    // Not within a character of UTF-8.
    while (name.size() > kLongest && !stem.empty() && is_inside_character(name[stem.size()])) {
      stem.pop_back();
    }
    for (char& c : stem) {
      if (kMindedInFiles.find(c) != std::string_view::npos) c = '_';
    }
    // Nothing that is hidden, an option, or goes up.
    if (stem.empty() || stem[0] == '.' || stem[0] == '-') stem.insert(0, "_");
    std::string distinct = stem;
    for (int n = 2; !used.insert(lower_case(distinct)).second; ++n) {
      distinct = stem + "-" + std::to_string(n);
    }
    stems.push_back(distinct);
  }
  return stems;
}

}  // namespace argil::cli
