// SPDX-License-Identifier: GPL-3.0-or-later
// A path from a script's stroke or from lines of numbers.
#include "argil/io/path_file.h"

#include <algorithm>
#include <cassert>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "argil/io/stroke_script.h"

#include "file/file_bytes.h"
#include "file/file_error.h"

namespace argil::io {
namespace {

constexpr std::string_view kPathBlanks = ", \t\r";
/// Of UTF-8: what spreadsheets and some editors begin a text with.
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// A line that begins with a word, as tables do.
bool is_heading(std::string_view line) {
  const std::size_t first = line.find_first_not_of(kPathBlanks);
  const auto letter = static_cast<unsigned char>(line[first]);
  return letter == '"' || std::isalpha(letter) != 0;
}

/// Three numbers parted by commas or blanks, and nothing else.
std::optional<Vec3> point_of(std::string_view line) {
  Vec3 point;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    line.remove_prefix(std::min(line.find_first_not_of(kPathBlanks), line.size()));
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), point[axis]);
    if (error != std::errc{}) return std::nullopt;
    line.remove_prefix(static_cast<std::size_t>(end - line.data()));
    // "12mm" is no number.
    if (!line.empty() && kPathBlanks.find(line.front()) == std::string_view::npos) {
      return std::nullopt;
    }
  }
  const bool is_whole = line.find_first_not_of(kPathBlanks) == std::string_view::npos;
  return is_whole && is_in_reach(point) ? std::optional(point) : std::nullopt;
}

Result<std::vector<Vec3>> points_of_text(const std::filesystem::path& file) {
  auto bytes = read_file_bytes(file);
  if (!bytes) return bytes.error();
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): bytes as text
  std::string_view text(reinterpret_cast<const char*>(bytes.value().data()), bytes.value().size());
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  std::vector<Vec3> points;
  std::size_t number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, end - begin);
    begin = end + 1;
    ++number;
    const std::size_t first = line.find_first_not_of(kPathBlanks);
    if (first == std::string_view::npos || line[first] == '#') continue;
    const auto point = point_of(line);
    if (!point) {
      const char* const remedy =
          points.empty() && is_heading(line) ? "; remove the heading, or begin it with #" : "";
      return file_error(ErrorKind::bad_input, file,
                        " line " + std::to_string(number) +
                            " is not three numbers x y z in mm, from -1e6 to 1e6" + remedy);
    }
    points.push_back(*point);
  }
  if (!points.empty()) return points;
  return file_error(ErrorKind::bad_input, file,
                    " is empty; a path needs lines of x y z in mm, or a stroke");
}

Result<std::vector<Vec3>> points_of_script(const std::filesystem::path& file) {
  auto script = read_stroke_script(file);
  if (!script) return script.error();
  for (const ScriptStep& step : script.value().steps) {
    const auto* stroke = std::get_if<Stroke>(&step);
    if (stroke == nullptr) continue;
    std::vector<Vec3> points;
    for (const StrokeSample& sample : stroke->samples) points.push_back(sample.position_mm);
    assert(!points.empty());
    return points;
  }
  return file_error(ErrorKind::bad_input, file, " has no stroke, whose path could be followed");
}

/// Points at steps of one length along the path, its ends kept.
std::vector<Vec3> thinned(const std::vector<Vec3>& path) {
  assert(path.size() > kMostPathPoints);
  double whole = 0.0;
  for (std::size_t n = 1; n < path.size(); ++n) whole += length(path[n] - path[n - 1]);
  const double step = whole / static_cast<double>(kMostPathPoints - 1);
  std::vector<Vec3> kept{path.front()};
  double gone = 0.0;
  for (std::size_t n = 1; n < path.size() && kept.size() + 1 < kMostPathPoints; ++n) {
    const double side = length(path[n] - path[n - 1]);
    for (double next = static_cast<double>(kept.size()) * step;
         next <= gone + side && kept.size() + 1 < kMostPathPoints;
         next = static_cast<double>(kept.size()) * step) {
      kept.push_back(path[n - 1] + (next - gone) / side * (path[n] - path[n - 1]));
    }
    gone += side;
  }
  kept.push_back(path.back());
  return kept;
}

}  // namespace

Result<std::vector<Vec3>> read_path(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  auto points = ending == ".jsonl" ? points_of_script(file) : points_of_text(file);
  if (!points) return points;
  std::vector<Vec3>& path = points.value();
  return thinned_path(std::move(path));
}

std::vector<Vec3> thinned_path(std::vector<Vec3> path_mm) {
  path_mm.erase(std::unique(path_mm.begin(), path_mm.end()), path_mm.end());
  return path_mm.size() > kMostPathPoints ? thinned(path_mm) : std::move(path_mm);
}

}  // namespace argil::io
