// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings/reference_list.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "argil/core/no_throw.h"
#include "argil/core/pace.h"
#include "argil/io/image_file.h"
#include "argil/io/safe_file.h"

namespace argil::viewer {
namespace {

namespace fs = std::filesystem;

/// The first word of a line, which is cut off with the blank behind it.
std::string_view next_word(std::string_view& line) {
  const std::size_t end = std::min(line.find(' '), line.size());
  const std::string_view word = line.substr(0, end);
  line.remove_prefix(std::min(end + 1, line.size()));
  return word;
}

/// The next word as a number of that range; nothing else.
std::optional<double> next_number(std::string_view& line, double least, double most) {
  const std::string_view word = next_word(line);
  double number = 0.0;
  const auto read = std::from_chars(word.data(), word.data() + word.size(), number);
  const bool is_whole = read.ec == std::errc() && read.ptr == word.data() + word.size();
  if (!is_whole || !(number >= least && number <= most)) return std::nullopt;
  return number;
}

/// "VIEW RIGHT UP WIDTH OPACITY behind|over shown|hidden FILE"; nothing for another line.
std::optional<ReferenceImage> image_of(std::string_view line, const fs::path& folder) {
  constexpr double kMost = kMaxReachMm;
  ReferenceImage image;
  const auto view = view_named(next_word(line));
  const auto right = next_number(line, -kMost, kMost);
  const auto up = next_number(line, -kMost, kMost);
  const auto width = next_number(line, kLeastReferenceWidthMm, kMost);
  const auto opacity = next_number(line, 0.0, 1.0);
  const std::string_view place = next_word(line);
  const std::string_view seen = next_word(line);
  const bool is_sound = view && right && up && width && opacity &&
                        (place == "behind" || place == "over") &&
                        (seen == "shown" || seen == "hidden") && !line.empty();
  if (!is_sound) return std::nullopt;
  image.view = *view;
  image.right_mm = *right;
  image.up_mm = *up;
  image.width_mm = *width;
  image.opacity = *opacity;
  image.is_over = place == "over";
  image.is_visible = seen == "shown";
  image.file = folder / fs::path(std::string(line));  // an absolute name stands alone
  return image;
}

std::string shortest(double number) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), number).ptr;
  return {text.data(), end};
}

std::string line_of(const ReferenceImage& image, const fs::path& folder) {
  const fs::path near = image.file.lexically_relative(folder);
  const bool is_inside = !near.empty() && *near.begin() != "..";
  std::string view = title_of(image.view);
  view.front() = static_cast<char>(view.front() - 'A' + 'a');
  std::string line = view;
  for (const double number : {image.right_mm, image.up_mm, image.width_mm, image.opacity}) {
    line.append(" ").append(shortest(number));
  }
  line.append(image.is_over ? " over" : " behind");
  line.append(image.is_visible ? " shown " : " hidden ");
  return line.append((is_inside ? near : image.file).string()).append("\n");
}

/// The lines of a list; none where there is no such file.
Result<std::vector<std::string>> lines_in(const fs::path& file) {
  std::error_code error;
  std::vector<std::string> lines;
  if (fs::symlink_status(file, error).type() == fs::file_type::not_found) return lines;
  std::ifstream in(file);
  std::string line;
  while (std::getline(in, line)) lines.push_back(line);
  if (in.is_open() && !in.bad()) return lines;
  return Error{ErrorKind::disk, "cannot read '" + file.string() +
                                    "': it stays as it is, and reference images are not kept; "
                                    "make it readable, or take it away"};
}

}  // namespace

fs::path references_file(const fs::path& project) {
  fs::path file = project;
  return file.replace_extension(".references.txt");
}

ReferenceList read_references(const fs::path& project) {
  ReferenceList list;
  const fs::path file = references_file(project);
  auto lines = lines_in(file);
  if (!lines) {
    list.problems.push_back(lines.error());
    return list;
  }
  std::error_code error;
  const fs::path folder = fs::absolute(project, error).parent_path();
  int number = 0;
  for (std::string& line : lines.value()) {
    ++number;
    auto image = image_of(line, folder);
    if (!image) {
      list.problems.push_back(
          {ErrorKind::bad_input, file.string() + ":" + std::to_string(number) +
                                     " names no reference image; mend the line or take it out"});
      list.unread.push_back(std::move(line));
      continue;
    }
    list.images.push_back(*std::move(image));
  }
  return list;
}

Result<void> write_references(const fs::path& project, const std::vector<ReferenceImage>& images,
                              const std::vector<std::string>& unread) {
  const fs::path file = references_file(project);
  if (auto former = lines_in(file); !former) return former.error();
  std::error_code error;
  if (images.empty() && unread.empty()) {
    fs::remove(file, error);
    if (!error) return {};
    return Error{ErrorKind::disk, "cannot remove '" + file.string() + "': " + error.message()};
  }
  const fs::path folder = fs::absolute(project, error).parent_path();
  std::string lines;
  for (const ReferenceImage& image : images) lines += line_of(image, folder);
  for (const std::string& line : unread) lines.append(line).append("\n");
  return io::replace_text(file, lines);
}

Result<std::shared_ptr<const ReferencePixels>> read_pixels(const fs::path& file,
                                                           const Progress& progress) {
  if (file.string().find('\n') != std::string::npos) {
    return Error{ErrorKind::bad_input, "'" + file.string() +
                                           "' has a name of more than a line, which the list of "
                                           "references cannot keep; rename it"};
  }
  using Pixels = std::shared_ptr<const ReferencePixels>;
  return no_throw(file.string(), [&]() -> Result<Pixels> {
    auto read = io::read_image(file, kMostReferencePixels, progress);
    if (!read) return read.error();
    io::ClearImage& image = read.value();
    return with_smaller(image.width, image.height, std::move(image.rgba), Pace(progress, "read"));
  });
}

}  // namespace argil::viewer
